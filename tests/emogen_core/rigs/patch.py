"""A flat square of skin, small enough to work out by hand what happens to it."""

from dataclasses import dataclass, field

import numpy as np

SIZE = 9


def _triangles():
    number = np.arange(SIZE * SIZE).reshape(SIZE, SIZE)
    a, b, c, d = (part.ravel() for part in (number[:-1, :-1], number[1:, :-1], number[1:, 1:], number[:-1, 1:]))
    return np.concatenate([np.stack([a, b, c], 1), np.stack([a, c, d], 1)]).astype(np.int32)


def points():
    x, y = np.divmod(np.arange(SIZE * SIZE, dtype=float), SIZE)
    return np.stack([x - SIZE // 2, y - SIZE // 2, 0 * x], 1)


@dataclass
class Patch:
    """Stands for a head mesh: all of it is skin."""

    triangles: np.ndarray = field(default_factory=_triangles)

    @property
    def parts(self):
        end = len(self.triangles)
        return {"skin": (0, end), "mouth": (end, end), "sockets": (end, end)}

    def part_vertices(self, *names):
        return np.unique(self.triangles) if "skin" in names else np.zeros(0, np.intp)
