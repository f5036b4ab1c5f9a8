"""Statistics on recorded faces: arrays in, numbers out."""
