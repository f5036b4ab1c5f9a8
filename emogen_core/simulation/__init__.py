"""Simulated participants: a target in mind, a metric to judge by, and how many faces to select."""
