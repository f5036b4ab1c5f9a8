"""Whether a recorded face is the one that was made again, and in which column it is not."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from ...faces.sketch import unpack_genes, unpack_weights

if TYPE_CHECKING:
    from collections.abc import Iterable

    from emogen_core.face.rig import Rig

    from ....store.runs_tables import Estimate, Face

    Column = tuple[str, str, str]
    """Which one, expected, got."""

ROUNDING = 1e-5
"""Within this, weights and depths in millimetres are the same: another processor's algebra rounds the last bits of the
collision stage otherwise. Genes, which all of the search follows from, are compared bit for bit."""
MADE = ("genes", "weights")
COLLISION = ("collided_lips", "collided_teeth", "depth_before", "depth_after")


def different(rig: Rig, made: Face | Estimate, got: Face | Estimate, columns: Iterable[str]) -> Column | None:
    """Return the first of some columns, and of those of the collision, in which two faces differ; None if in none.

    Args:
        rig: names the genes and shapes.
        made: the face that was made again.
        got: the recorded one.
        columns: to compare, in this order.
    """
    for what in (*columns, *_collision_columns(got)):
        expected, found = getattr(made, what), getattr(got, what)
        if not _alike(what, expected, found):
            return what, *_told_apart(rig, what, expected, found)
    return None


def _collision_columns(face: Face | Estimate) -> tuple[str, ...]:
    """Return the columns of the collision's result; none for a face that was stored before there were any."""
    return COLLISION if any(getattr(face, column) is not None for column in COLLISION) else ()


def _alike(what: str, expected: Any, got: Any) -> bool:
    """Return whether a value is the recorded one: what the solver of collisions gives, up to `ROUNDING`."""
    if what == "weights" and len(expected) == len(got):
        return bool(np.abs(unpack_weights(expected) - unpack_weights(got)).max(initial=0) <= ROUNDING)
    if what in {"depth_before", "depth_after"} and None not in {expected, got}:
        return abs(float(expected) - float(got)) <= ROUNDING
    return bool(expected == got)


def _told_apart(rig: Rig, what: str, expected: Any, got: Any) -> tuple[str, str]:
    """Return two different values in words; of a vector, its first entry that differs."""
    if not isinstance(got, bytes) or len(expected) != len(got):
        return str(expected), str(got)
    names, unpack = (rig.gene_names, unpack_genes) if what == "genes" else (rig.shape_names, unpack_weights)
    # The first that differs may only be rounded otherwise: the one that differs most is told.
    at = int(np.argmax(np.abs(unpack(expected) - unpack(got))))
    wanted, found = (f"{names[at]} = {unpack(data)[at]}" for data in (expected, got))
    return wanted, found
