"""Drawing faces: arrays in, pictures out. Only `pyrender_backend` touches OpenGL."""
