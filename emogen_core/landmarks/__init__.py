"""Feature points to expressions: sparse motion becomes weights of the rig (docs/landmarks.md)."""
