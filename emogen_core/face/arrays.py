"""What rig and space files have in common: lengths as whole steps, and arrays that are what they are taken for."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from emogen_core.errors import RigFileError, expected

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

# Rounds the exact ties that halves and quarters of the source's decimals make, so the last bit of a product of
# another machine cannot decide.
_TIE_BREAK = 0.5001
_MOST_STEPS = 2**24


def steps(values: NDArray[Any], per_millimetre: int) -> NDArray[np.int32]:
    """Return lengths in millimetres as whole steps, of which so many make a millimetre.

    Raises:
        RigFileError: a length is not finite or too long to be read back exactly.
    """
    scaled = np.floor(values.astype(np.float64) * per_millimetre + _TIE_BREAK)
    if not (np.abs(scaled) < _MOST_STEPS).all():
        raise RigFileError(
            f"lengths: expected finite ones below {_MOST_STEPS / per_millimetre / 1000:.0f} m, got others"
        )
    return scaled.astype(np.int32)


def millimetres(whole: NDArray[Any], per_millimetre: int) -> NDArray[np.float32]:
    """Return steps as lengths in millimetres."""
    return (whole / per_millimetre).astype(np.float32)


def integers(arrays: Mapping[str, NDArray[Any]], name: str, axes: int, kind: type[np.integer[Any]]) -> NDArray[Any]:
    """Return an array that is stored as it is meant: another type or shape would be read as something else.

    Raises:
        RigFileError: it is of another type or has another number of axes.
        KeyError: it is missing.
    """
    found = arrays[name]
    if found.dtype != kind or found.ndim != axes:
        wanted = f"{name} of {np.dtype(kind)} with {axes} axes"
        raise RigFileError(f"arrays: {expected(wanted, f'{found.dtype} {found.shape}')}")
    return found
