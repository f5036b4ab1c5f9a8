"""A space of heads on a base mesh of forty vertices, whose targets are made up from their names."""

from __future__ import annotations

import zlib
from types import SimpleNamespace

import numpy as np
from scipy.sparse import csr_array

from emogen_core.rigs.base_mesh import BaseMesh
from emogen_core.rigs.eyeballs import eyeball
from emogen_core.rigs.identity_space import bake_space

SIDE, MIDDLE = 16, 8
COUNT = 2 * SIDE + MIDDLE
BALL = len(eyeball()[0])


def base():
    """Left vertices, their mirror images, and the middle; the first eight on a sphere."""
    rng = np.random.default_rng(1)
    left = rng.uniform(0.1, 1, (SIDE, 3))
    directions = rng.normal(size=(8, 3))
    left[:8] = (0.6, 0.3, 0.2) + 0.1495 * directions / np.linalg.norm(directions, axis=1)[:, None]
    middle = rng.uniform(-1, 1, (MIDDLE, 3)) * (0, 1, 1)
    return np.concatenate([left, left * (-1, 1, 1), middle])


MIRROR = np.concatenate([np.arange(SIDE) + SIDE, np.arange(SIDE), np.arange(2 * SIDE, COUNT)])


class MadeUpSource:
    """Every target moves all vertices, by numbers that its name decides, decimetres."""

    def target(self, path):
        return np.random.default_rng(zlib.crc32(path.encode())).normal(0, 0.05, (COUNT, 3))


def small_geometry():
    """The render mesh is the base mesh and two eyeballs, which it does not get from the base."""
    mesh = BaseMesh(base(), np.zeros((0, 2)), {"helper-l-eye": np.arange(8).reshape(2, 4)}, {}, MIRROR)
    drawn = csr_array(np.eye(COUNT + 2 * BALL, COUNT))
    balls = np.arange(BALL) + COUNT
    return SimpleNamespace(
        mesh=mesh,
        operator=drawn,
        positions=np.concatenate([base(), np.zeros((2 * BALL, 3))]),
        mirror=np.concatenate([MIRROR, balls + BALL, balls]).astype(np.int32),
        triangles=np.zeros((1, 3), np.int32),
        parts={"skin": (0, 1)},
        part_vertices=lambda part: balls if part == "eye_left" else balls + BALL,
    )


def small_space():
    """A space as the builder bakes it."""
    return bake_space(MadeUpSource(), small_geometry(), np.linspace(0, 1, COUNT + 2 * BALL))
