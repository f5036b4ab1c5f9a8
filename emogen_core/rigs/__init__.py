"""Bakes the bundled rig and its look from CC0 sources, and checks rigs."""
