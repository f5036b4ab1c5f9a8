"""Heads and their portraits."""
