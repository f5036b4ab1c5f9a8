"""Identity modes of a face model: what its heads are mixed of, in a file of their own.

The first head of the rig plus weighted modes is another head. They stand beside the rig and not in it, as the bundled
space of heads does: what a weight of a shape means does not depend on who else could wear it.

Symbols: ``N`` vertices of the rig.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from emogen_core.errors import InvalidInputError, RigFileError, expected
from emogen_core.face.arrays import integers, millimetres, steps
from emogen_core.face.container import read_as, write_container

if TYPE_CHECKING:
    from collections.abc import Mapping
    from pathlib import Path

    from numpy.typing import NDArray

    from emogen_core.face.rig import Rig

KIND = "modes"
VERSION = 1
ENDING = ".modes"
"""Of the file, which lies beside the rig under the same name."""
PLAUSIBLE = 2.0
"""The largest weight of a mode, and minus the smallest: two standard deviations of the people it was made from."""
STEPS_PER_MILLIMETRE = 128
MAX_NUMBERS = 2**26
"""Coordinates of all modes together: 600 modes of a head of 37,000 vertices."""


@dataclass(frozen=True, eq=False)
class ModeSpace:
    """The heads that a face model's identity modes describe.

    Attributes:
        rig: hash of the rig whose first head they are added to.
        modes: name -> (N, 3) float32 millimetres, added at weight 1.
        hash: SHA-256 of the content, hexadecimal; empty for a space that was never stored.
    """

    rig: str
    modes: Mapping[str, NDArray[np.float32]]
    hash: str = ""

    def check(self, weights: Mapping[str, float]) -> None:
        """Raise `InvalidInputError` unless weights name modes of this space and are within `PLAUSIBLE`."""
        for name, weight in weights.items():
            if name not in self.modes:
                raise InvalidInputError(f"modes: {expected(f'names among {sorted(self.modes)}', name)}")
            if not abs(weight) <= PLAUSIBLE:
                raise InvalidInputError(f"{name}: {expected(f'a number in [{-PLAUSIBLE:g}, {PLAUSIBLE:g}]', weight)}")

    def check_rig(self, rig: Rig) -> None:
        """Raise `RigFileError` unless this space was made with a rig."""
        _need(self.rig == rig.hash, f"modes of the rig {rig.hash[:12]}", self.rig[:12])
        for name, offsets in self.modes.items():
            _need(offsets.shape == rig.offsets.shape[1:], f"mode {name} {rig.offsets.shape[1:]}", offsets.shape)


def save_modes(space: ModeSpace, path: Path) -> ModeSpace:
    """Store a space and return it as a reader will get it: rounded, and with its hash.

    Raises:
        RigFileError: it has no modes or too many, or one is too large for the file.
    """
    _check(space)
    arrays = {_place(at): _packed(offsets) for at, offsets in enumerate(space.modes.values())}
    digest = write_container(path, KIND, VERSION, {"rig": space.rig, "modes": list(space.modes)}, arrays)
    kept = {name: _unpacked(arrays[_place(at)]) for at, name in enumerate(space.modes)}
    return replace(space, modes=kept, hash=digest)


def load_modes(path: Path) -> ModeSpace:
    """Read a space back.

    Raises:
        RigFileError: not a file of modes of this version, damaged, or its content contradicts itself.
    """
    space = read_as(path, KIND, VERSION, _space)
    _check(space)
    return space


def _space(document: dict[str, Any], arrays: Mapping[str, NDArray[Any]], digest: str) -> ModeSpace:
    names = [str(name) for name in document["modes"]]
    _need(len(set(names)) == len(names) == len(arrays), "every mode once", len(arrays))
    packed = {name: integers(arrays, _place(at), 2, np.int16) for at, name in enumerate(names)}
    return ModeSpace(str(document["rig"]), {name: _unpacked(one) for name, one in packed.items()}, digest)


def _check(space: ModeSpace) -> None:
    shapes = {offsets.shape for offsets in space.modes.values()}
    _need(len(shapes) == 1 and {len(shape) for shape in shapes} == {2}, "modes of one mesh", sorted(shapes))
    count = sum(offsets.size for offsets in space.modes.values())
    _need(count <= MAX_NUMBERS, f"at most {MAX_NUMBERS} numbers", count)
    named = all(name and name.isprintable() and len(name) <= 80 for name in space.modes)
    _need(named, "names of 1 to 80 printable characters", sorted(space.modes))


def _packed(offsets: NDArray[np.float32]) -> NDArray[np.int16]:
    """Return (3, N) changes from vertex to vertex, for neighbours move alike."""
    moves = steps(offsets, STEPS_PER_MILLIMETRE)
    _need(bool((np.abs(moves) < 2**15).all()), "modes below 256 mm", float(np.abs(offsets).max(initial=0)))
    first, changes = moves[:1], moves[1:] - moves[:-1]
    # A change may leave 16 bits; adding it up in 16 bits comes back to the same place.
    return np.concatenate([first, changes]).astype(np.int16).T.copy()


def _unpacked(packed: NDArray[np.int16]) -> NDArray[np.float32]:
    _need(packed.shape[0] == 3, "modes of three coordinates", packed.shape)
    return millimetres(np.cumsum(packed.T, axis=0, dtype=np.int16), STEPS_PER_MILLIMETRE)


def _place(at: int) -> str:
    return f"mode/{at:04d}"


def _need(condition: bool, what: str, got: object) -> None:
    if not condition:
        raise RigFileError(f"modes: {expected(what, got)}")
