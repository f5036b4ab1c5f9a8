"""A head as simple as can be: a ball with a face's landmarks, for tests that need a rig but not the bundled one."""

import numpy as np

from emogen_core.face.rig import Gene, Rig

RINGS, SEGMENTS = 24, 32


def ball_rig():
    """A ball of 100 mm radius about (0, -10, -80), with a chin, one identity and one shape that stretches it."""
    polar, azimuth = np.meshgrid(
        np.linspace(0.02, np.pi - 0.02, RINGS), np.arange(SEGMENTS) / SEGMENTS * 2 * np.pi, indexing="ij"
    )
    points = 100 * np.stack(
        [np.sin(polar) * np.sin(azimuth), 1.1 * np.cos(polar), np.sin(polar) * np.cos(azimuth)], -1
    ).reshape(-1, 3) - (0, 10, 80)
    grid = np.arange(RINGS * SEGMENTS).reshape(RINGS, SEGMENTS)
    a, d = grid[:-1], grid[1:]
    b, c = np.roll(a, -1, 1), np.roll(d, -1, 1)
    triangles = np.concatenate([np.stack([a, d, c], -1).reshape(-1, 3), np.stack([a, c, b], -1).reshape(-1, 3)])
    offset = np.zeros((1, len(points), 3), np.float32)
    offset[0, :, 0] = 0.2 * points[:, 0]
    return Rig(
        name="ball",
        genes=(Gene("wide", ("wide",), (), "jaw"),),
        core_shapes=("wide",),
        combinations=(),
        collision_shapes=(),
        emotion_sets={},
        offsets=offset,
        neutrals={"ball": points.astype(np.float32)},
        triangles=triangles.astype(np.int32),
        parts={"skin": (0, len(triangles))},
        hash="ball",
    )
