"""A small made-up head, and others of the same mesh."""

from functools import lru_cache

import numpy as np
from scipy.spatial.transform import Rotation

from emogen_core.transfer.blendshapes import Template, Training
from emogen_core.transfer.packing.made_up import face_bumps, made_up_face
from emogen_core.transfer.packing.pack import pack
from emogen_core.transfer.synthetic import synthetic_head

REFLECTED = np.array([-1.0, 1.0, 1.0])


@lru_cache(maxsize=1)
def head():
    face = made_up_face(face_bumps(), side=25)
    return Template(face.neutral.astype(float), face.offsets.astype(float), face.triangles)


@lru_cache(maxsize=1)
def packed():
    return pack(made_up_face(face_bumps(), side=25)).weights


@lru_cache(maxsize=1)
def truth():
    """Neutral, true offsets, and all packed expressions of another head."""
    known = head()
    neutral, true = synthetic_head(known.neutral, known.offsets, np.random.default_rng(4))
    return neutral, true, trained(neutral, true, packed())


def trained(neutral, true, weights):
    return Training(weights, neutral + np.tensordot(weights, true, 1))


def mirror():
    """The vertex across from each, of the made-up grid."""
    return np.arange(25 * 25).reshape(25, 25)[::-1].ravel()


def across():
    """The shape across from each."""
    offsets, image = head().offsets, head().offsets[:, mirror()] * REFLECTED
    return np.array([np.abs(offsets - one).max((1, 2)).argmin() for one in image])


def moved(points, scale=1.7):
    """Turned, scaled and moved away: (points, offsets) -> the same of another frame."""
    turn = Rotation.from_euler("xyz", [0.4, -1.1, 2.0]).as_matrix()
    return scale * points @ turn.T + [30, -500, 7], lambda offsets: scale * offsets @ turn.T
