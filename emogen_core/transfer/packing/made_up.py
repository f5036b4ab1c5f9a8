"""A made-up face: bumps on a grid, with known mirror images. Quick to make at any size, for tests and benchmarks."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from emogen_core.transfer.packing.template import Template

_WIDTH, _HEIGHT, _DEPTH = 90.0, 110.0, 60.0  # millimetres from the middle to the edge, and from the edge to the nose

# Name, x and y of the middle, radius and push (x, y, z), millimetres; with x above 0 there is a mirror image.
_TABLE: tuple[tuple[str, float, float, float, tuple[float, float, float]], ...] = (
    ("browDown", 28, 32, 13, (-2, -6, 0)), ("browInnerUp", 12, 34, 11, (0, 7, 1)),
    ("browOuterUp", 42, 34, 12, (0, 6, 0)), ("cheekPuff", 48, -38, 19, (4, 0, 10)),
    ("cheekSquint", 36, -14, 13, (0, 7, 2)), ("eyeBlink", 31, 2, 8, (0, -9, 1)),
    ("eyeLookDown", 31, -2, 9, (0, -3, 0)), ("eyeLookIn", 29, 0, 9, (-3, 0, 0)), ("eyeLookOut", 33, 0, 9, (3, 0, 0)),
    ("eyeLookUp", 31, 3, 9, (0, 3, 0)), ("eyeSquint", 31, -5, 10, (0, 3, 0)), ("eyeWide", 31, 6, 8, (0, 4, 0)),
    ("mouthDimple", 30, -56, 12, (4, 1, -2)), ("mouthFrown", 26, -64, 13, (1, -6, 0)),
    ("mouthLowerDown", 11, -66, 11, (0, -7, 1)), ("mouthPress", 16, -57, 13, (0, 2, -2)),
    ("mouthSmile", 30, -50, 18, (7, 8, 2)), ("mouthStretch", 32, -66, 18, (7, -4, -2)),
    ("mouthUpperUp", 12, -48, 11, (0, 6, 1)), ("noseSneer", 13, -20, 12, (0, 6, 1)),
    ("jawForward", 0, -80, 34, (0, 0, 9)), ("jawLeft", 0, -78, 36, (10, 0, 0)), ("jawOpen", 0, -84, 38, (0, -32, -6)),
    ("jawRight", 0, -78, 36, (-10, 0, 0)), ("mouthClose", 0, -68, 22, (0, 26, 4)),
    ("mouthFunnel", 0, -57, 24, (0, 0, 11)), ("mouthLeft", 0, -57, 30, (10, 0, 0)),
    ("mouthPucker", 0, -56, 26, (0, 0, 12)), ("mouthRight", 0, -57, 30, (-10, 0, 0)),
    ("mouthRollLower", 0, -63, 13, (0, 3, -6)), ("mouthRollUpper", 0, -51, 13, (0, -3, -6)),
    ("mouthShrugLower", 0, -72, 17, (0, 6, 2)), ("mouthShrugUpper", 0, -48, 16, (0, 5, 2)),
)  # fmt: skip
_GAZE = "eyeLook"


@dataclass(frozen=True, slots=True)
class Bump:
    """A shape that pushes the surface around a point; it falls off as a bell.

    Attributes:
        name: of the shape.
        centre: x and y, millimetres.
        radius: millimetres; there it moves by 37 % of the most.
        push: offset in the middle, millimetres.
    """

    name: str
    centre: tuple[float, float]
    radius: float
    push: tuple[float, float, float]

    @property
    def reflected(self) -> Bump:
        """The mirror image, of the same name."""
        x, y = self.centre
        across, *rest = self.push
        return Bump(self.name, (-x, y), self.radius, (-across, rest[0], rest[1]))


def both(bump: Bump) -> tuple[Bump, Bump]:
    """Return a bump on the head's left and its mirror image, named apart by ``_L`` and ``_R``."""
    other = bump.reflected
    return (
        Bump(f"{bump.name}_L", bump.centre, bump.radius, bump.push),
        Bump(f"{bump.name}_R", other.centre, other.radius, other.push),
    )


def face_bumps() -> list[Bump]:
    """Return 53 bumps that are named and placed about as the shapes of ARKit are."""
    found: list[Bump] = []
    for name, x, y, radius, push in _TABLE:
        bump = Bump(name, (x, y), radius, push)
        found += both(bump) if x else [bump]
    return found


def made_up_face(bumps: list[Bump], side: int = 97) -> Template:
    """Return a template with a shape for each bump.

    Args:
        bumps: the shapes.
        side: of the grid; 97 make 9,409 vertices, as many as the face of ICT-FaceKit has.
    """
    x, y = np.meshgrid(np.linspace(-_WIDTH, _WIDTH, side), np.linspace(-_HEIGHT, _HEIGHT, side), indexing="ij")
    depth = _DEPTH * (1 - (x / _WIDTH) ** 2 / 2 - (y / _HEIGHT) ** 2 / 2)
    neutral = np.stack([x, y, depth], -1).reshape(-1, 3).astype(np.float32)
    near = [np.exp(-(((neutral[:, :2] - one.centre) / one.radius) ** 2).sum(1)) for one in bumps]
    offsets = [bell[:, None] * np.array(one.push) for bell, one in zip(near, bumps, strict=True)]
    corner = (np.arange(side - 1)[:, None] * side + np.arange(side - 1)).ravel()
    quads = corner[:, None] + np.array([0, side, side + 1, 1])
    return Template(
        names=tuple(bump.name for bump in bumps),
        neutral=neutral,
        offsets=np.array(offsets, np.float32),
        triangles=quads[:, [[0, 1, 2], [0, 2, 3]]].reshape(-1, 3).astype(np.int32),
        gaze=tuple(k for k, bump in enumerate(bumps) if bump.name.startswith(_GAZE)),
    )
