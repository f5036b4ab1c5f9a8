"""The face model: what a rig is, how weights become vertices, how a rig is stored."""
