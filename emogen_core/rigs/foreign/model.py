"""A head model of somebody else as a value, and what was found out about it.

Symbols: ``N`` vertices, ``T`` triangles. Readers give lengths and axes as the file has them; `read.read_head` gives
those of `emogen_core.face.rig`: millimetres, x to the head's left, y up, z out of the face, origin between the eyes.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    Offsets = Mapping[str, NDArray[np.float32]]


@dataclass(frozen=True, eq=False)
class HeadModel:
    """A neutral mesh with what moves it.

    Attributes:
        name: of the file or folder.
        vertices: (N, 3) float32, the neutral.
        triangles: (T, 3) int32 vertex indices, counter-clockwise seen from outside. A polygon is a fan around its
            first corner.
        parts: part name -> (first, last + 1) row of ``triangles``; together they are all rows.
        expressions: name -> (N, 3) float32, shape minus neutral.
        identity_modes: name -> (N, 3) float32, added to the neutral for another head.
        uv: (T, 3, 2) float32 texture coordinates of every triangle's corners, origin at the lower left; (0, 3, 2) for
            a model without.
    """

    name: str
    vertices: NDArray[np.float32]
    triangles: NDArray[np.int32]
    parts: Mapping[str, tuple[int, int]]
    expressions: Offsets
    identity_modes: Offsets = field(default_factory=dict)
    uv: NDArray[np.float32] = field(default_factory=lambda: np.zeros((0, 3, 2), np.float32))

    def part_vertices(self, *names: str) -> NDArray[np.intp]:
        """Return the sorted vertices of some parts; none for no name."""
        rows = [self.triangles[slice(*self.parts[name])].ravel() for name in names]
        return np.unique(np.concatenate([np.zeros(0, np.int32), *rows])).astype(np.intp)


@dataclass
class Findings:
    """What an import tells its user, a sentence each; readers and guesses add to it.

    Attributes:
        found: what the files say.
        guessed: what was concluded and may be wrong.
        missing: what a study would want and the files lack.
    """

    found: list[str] = field(default_factory=list)
    guessed: list[str] = field(default_factory=list)
    missing: list[str] = field(default_factory=list)

    def to_document(self) -> dict[str, list[str]]:
        """Return the three lists as plain data."""
        return {"found": list(self.found), "guessed": list(self.guessed), "missing": list(self.missing)}


def counted(names: list[str] | tuple[str, ...], shown: int = 8) -> str:
    """Return names for a sentence, the first few of many."""
    more = f" and {len(names) - shown} more" if len(names) > shown else ""
    return ", ".join(names[:shown]) + more
