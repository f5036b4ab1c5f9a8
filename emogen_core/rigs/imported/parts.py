"""Parts of a foreign head under the names that the rig has for them, and its triangles sorted by these."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from emogen_core.rigs.foreign.parts import roles_of

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from emogen_core.rigs.foreign.model import HeadModel

    Triangles = NDArray[np.int32]

ORDER = (
    "skin", "mouth", "sockets", "tongue", "teeth_upper", "teeth_lower", "lashes", "eye_left", "eye_right", "other",
)  # fmt: skip
"""Flesh comes first: what mends and derives shapes counts on it."""
FLESH = ("skin", "mouth", "sockets")
_SOFT = re.compile(r"tongue|gum", re.IGNORECASE)
_SOCKETS = re.compile(r"eye.*socket|^sockets?$", re.IGNORECASE)


@dataclass(frozen=True, eq=False)
class Parts:
    """Part -> its (t, 3) triangles, every triangle of the model once; ``named`` are those of `FLESH` that have names.

    Where only the skin has one, what lies in mouth and eye sockets is still part of it.
    """

    triangles: Mapping[str, Triangles]
    named: frozenset[str]

    def of(self, *names: str) -> Triangles:
        """Return the (t, 3) triangles of some parts."""
        return np.concatenate([np.zeros((0, 3), np.int32), *(self.triangles.get(name, _NONE) for name in names)])

    def vertices(self, *names: str) -> NDArray[np.intp]:
        """Return the sorted vertices of some parts."""
        return np.unique(self.of(*names)).astype(np.intp)

    def with_flesh(self, flesh: Mapping[str, Triangles]) -> Parts:
        """Return them with other triangles in `FLESH`."""
        return Parts({**self.triangles, **flesh}, frozenset(flesh))

    def sorted(self) -> tuple[Triangles, dict[str, tuple[int, int]]]:
        """Return all triangles in the order of `ORDER`, and part -> (first, last + 1) row; flesh has a row range each.

        Other parts are named only if there are any.
        """
        rows, start = {}, 0
        for name in ORDER:
            count = len(self.triangles.get(name, _NONE))
            if count or name in FLESH:
                rows[name] = (start, start + count)
            start += count
        return self.of(*rows), rows


_NONE = np.zeros((0, 3), np.int32)


def sort_parts(model: HeadModel, upper_teeth: NDArray[np.integer]) -> Parts:
    """Return the parts of a model by the roles of its own.

    Args:
        model: the head in the rig's frame.
        upper_teeth: vertices of the upper row; all other teeth are of the lower.
    """
    roles = roles_of(model)
    found: dict[str, list[Triangles]] = {name: [] for name in ORDER}
    for role, names in roles.items():
        for name in names:
            rows = model.triangles[slice(*model.parts[name])]
            for part, chosen in _shares(model, role, name, rows, upper_teeth):
                found[part].append(chosen)
    triangles = {name: np.concatenate([_NONE, *rows]).astype(np.int32) for name, rows in found.items()}
    return Parts(triangles, frozenset(name for name in FLESH if len(triangles[name])))


def pieces(triangles: Triangles) -> NDArray[np.intp]:
    """Return (t,) the number of the connected piece to which each triangle belongs."""
    used, local = np.unique(triangles, return_inverse=True)
    local = local.reshape(-1, 3)
    ends = np.concatenate([local[:, 0], local[:, 0]]), np.concatenate([local[:, 1], local[:, 2]])
    graph = coo_array((np.ones(len(ends[0])), ends), shape=(len(used), len(used)))
    return np.asarray(connected_components(graph, directed=False)[1][local[:, 0]], np.intp)


def _shares(
    model: HeadModel, role: str, name: str, rows: Triangles, upper_teeth: NDArray[np.integer]
) -> list[tuple[str, Triangles]]:
    if role == "eyes":
        left = model.vertices[rows, 0].mean(1) > 0
        return [("eye_left", rows[left]), ("eye_right", rows[~left])]
    if role == "teeth":
        upper = np.isin(rows, upper_teeth).all(1)
        return [("teeth_upper", rows[upper]), ("teeth_lower", rows[~upper])]
    if role == "mouth":
        flesh = "sockets" if _SOCKETS.search(name) else "mouth"
        return [("tongue" if _SOFT.search(name) else flesh, rows)]
    return [(role, rows)]
