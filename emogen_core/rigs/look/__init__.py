"""Paints and bakes the bundled head's look (`head.look`) from code and two CC0 masks. How: docs/look.md."""
