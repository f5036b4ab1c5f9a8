"""A rig that can be reckoned by hand: the lower lip is a box, the upper lip a plate above it, the teeth plates behind.

The box spans x in [-20, 20], y in [-10, 0], z in [0, 10]. The lip's plate lies at y = 1, the teeth's at z = -1. At
weight 1 ``press`` lowers the lip by 4, ``bite`` moves the upper teeth 4 outward, ``jump`` moves them 14 outward,
``lean`` lowers the left half of the lip by 4.
"""

from itertools import pairwise

import numpy as np

from emogen_core.face.rig import Gene, Rig

CORE = ("press", "bite", "jump", "lean")
ZONES = ("OuterLeft", "InnerLeft", "InnerRight", "OuterRight")
CENTRES = np.array([15.0, 5, -5, -15])


def plate(corner, along, across, columns=16):
    """A strip of quads from ``corner``; its triangles look along ``along x across``."""
    steps = np.linspace(0, 1, columns + 1)[:, None]
    points = np.concatenate([corner + steps * along, corner + steps * along + across])
    first = np.arange(columns)
    a, b, c, d = first, first + 1, first + columns + 2, first + columns + 1
    # Mirrored diagonals, so that the rig is symmetric.
    left = first < columns // 2
    cut = [np.where(left[:, None], np.stack(s, 1), np.stack(t, 1)) for s, t in (
        ((a, b, c), (a, b, d)), ((a, c, d), (b, c, d)),
    )]  # fmt: skip
    return points, np.concatenate(cut)


def box():
    x, y, z = np.array([40.0, 0, 0]), np.array([0, 10.0, 0]), np.array([0, 0, 10.0])
    low = np.array([-20.0, -10, 0])
    sides = [plate(low + y, x, z), plate(low, x, z), plate(low + z, x, y), plate(low, x, y)]
    # plate() looks along `along x across`: top and bottom would look down, front and back would look out of the face.
    turned = (True, False, False, True)
    points = [p for p, _ in sides]
    return points, [f[:, ::-1] if turn else f for (_, f), turn in zip(sides, turned, strict=True)]


def mirror_of(points):
    image = points * (-1, 1, 1)
    distance = ((points[:, None] - image[None]) ** 2).sum(2)
    # Points that coincide (edges of the box) belong to different strips: stay within the strip.
    strip = np.arange(len(points)) // 17
    distance += 1e6 * (strip[:, None] != strip[None])
    return distance.argmin(0)


def box_rig():
    points, faces = box()
    for corner, along, across, flip in (
        ((-16.0, 1, 2), (32.0, 0, 0), (0.0, 0, 6), True),
        ((-14.0, -6, -1), (28.0, 0, 0), (0.0, 4, 0), False),
        ((-14.0, -9, -1), (28.0, 0, 0), (0.0, 2, 0), False),
    ):
        made, triangles = plate(np.array(corner), np.array(along), np.array(across))
        points.append(made)
        faces.append(triangles)
        if flip and np.cross(along, across)[1] > 0:
            faces[-1] = triangles[:, ::-1]
    starts = np.cumsum([0, *(len(p) for p in points)])
    triangles = np.concatenate([f + s for f, s in zip(faces, starts, strict=False)]).astype(np.int32)
    rows = np.cumsum([0, *(len(f) for f in faces)])
    neutral = np.concatenate(points)
    spans = [(0, starts[4]), *pairwise(starts[4:])]
    lower, upper, top_teeth, bottom_teeth = (np.arange(a, b, dtype=np.int32) for a, b in spans)
    offsets = np.zeros((len(CORE) + 8, len(neutral), 3), np.float32)
    offsets[0, upper, 1] = -4
    offsets[1, top_teeth, 2] = 4
    offsets[2, top_teeth, 2] = 14
    offsets[3, upper, 1] = -4 * (neutral[upper, 0] > 0)
    share = np.clip(1 - np.abs(neutral[:, 0].clip(-15, 15)[None] - CENTRES[:, None]) / 10, 0, 1)
    offsets[4:8, upper, 1] = 5 * share[:, upper]
    offsets[4:8, lower, 1] = -5 * share[:, lower]
    offsets[8:12, lower, 2] = 8 * share[:, lower]
    return Rig(
        name="boxes",
        genes=tuple(Gene(name, (name,), (), "mouth") for name in CORE),
        core_shapes=CORE,
        combinations=(),
        collision_shapes=tuple(f"{kind}{zone}" for kind in ("lips", "teeth") for zone in ZONES),
        emotion_sets={},
        offsets=offsets,
        neutrals={"box": neutral.astype(np.float32)},
        triangles=triangles,
        parts={
            "skin": (0, int(rows[5])),
            "teeth_upper": (int(rows[5]), int(rows[6])),
            "teeth_lower": (int(rows[6]), int(rows[7])),
        },
        regions={"lip_lower": lower, "lip_upper": upper, "teeth_upper": top_teeth, "teeth_lower": bottom_teeth},
        mirror=mirror_of(neutral).astype(np.int32),
    )


def weights_of(rig, **values):
    weights = np.zeros((1, len(rig.shape_names)), np.float32)
    for name, value in values.items():
        weights[0, rig.shape_names.index(name)] = value
    return weights
