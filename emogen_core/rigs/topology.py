"""What fitting needs to know of a mesh: its triangles and parts. The builder's geometry has it, and so has a rig."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import TYPE_CHECKING, Protocol

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from emogen_core.face.rig import Rig


class Topology(Protocol):
    """Triangles (T, 3) and the parts into which they are sorted; ``skin``, ``mouth`` and ``sockets`` come first."""

    @property
    def triangles(self) -> NDArray[np.int32]:
        """(T, 3) vertex indices, counter-clockwise from outside."""
        ...

    @property
    def parts(self) -> Mapping[str, tuple[int, int]]:
        """Part -> (first, last + 1) row of ``triangles``."""
        ...

    def part_vertices(self, *names: str) -> NDArray[np.intp]:
        """Return the sorted vertices of some parts."""
        ...


@dataclass(frozen=True, eq=False)
class RigTopology:
    """The `Topology` of a finished rig."""

    rig: Rig

    @property
    def triangles(self) -> NDArray[np.int32]:
        """(T, 3) vertex indices, counter-clockwise from outside."""
        return self.rig.triangles

    @property
    def parts(self) -> Mapping[str, tuple[int, int]]:
        """Part -> (first, last + 1) row of ``triangles``."""
        return self.rig.parts

    def part_vertices(self, *names: str) -> NDArray[np.intp]:
        """Return the sorted vertices of some parts; a part that the rig lacks has none."""
        return _part_vertices(self, names)


# A fit asks for the same parts a hundred times.
@lru_cache(maxsize=32)
def _part_vertices(topology: RigTopology, names: tuple[str, ...]) -> NDArray[np.intp]:
    rows = [topology.triangles[slice(*topology.parts[name])].ravel() for name in names if name in topology.parts]
    return np.unique(np.concatenate([np.zeros(0, np.int32), *rows])).astype(np.intp)
