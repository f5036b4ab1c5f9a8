"""Space files: an `IdentitySpace` in a container, offsets quantised and sparse, and nothing believed when read back."""

from __future__ import annotations

from dataclasses import astuple, replace
from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from emogen_core.errors import RigFileError, expected
from emogen_core.face.arrays import integers, millimetres, steps
from emogen_core.face.container import read_as, write_container
from emogen_core.face.space import ANCESTRIES, MACROS, SHARE_TOLERANCE, IdentitySpace, Parameter, Target

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

KIND = "space"
VERSION = 1
BUNDLED_SPACE = Path(__file__).parent / "data" / "head.space"
# Targets are stored in steps of 1/64 mm; the base head, read once, in 1/1024.
STEPS_PER_MILLIMETRE = 64
BASE_STEPS = 1024
# No parameter goes farther: its target would be moved out of all proportion.
_FARTHEST = 1000
_INDICES = ("half", "twins", "eyes")


def save_space(space: IdentitySpace, path: Path) -> IdentitySpace:
    """Store a space and return it as a reader will get it: rounded, and with its hash.

    Raises:
        RigFileError: the space contradicts itself, or an offset is too large for the file.
    """
    stored = rounded(space)
    check_space(stored)
    document = {
        "topology": stored.topology,
        "parameters": [list(astuple(parameter)) for parameter in stored.parameters],
        "targets": list(stored.targets),
        "lid_correctives": [list(pair) for pair in stored.lid_correctives],
    }
    return replace(stored, hash=write_container(path, KIND, VERSION, document, _arrays(stored)))


def load_space(path: Path) -> IdentitySpace:
    """Read a space back.

    Raises:
        RigFileError: not a space file of this version, damaged, or its content contradicts itself.
    """
    space = read_as(path, KIND, VERSION, _space)
    check_space(space)
    return space


@lru_cache(maxsize=1)
def load_bundled_space() -> IdentitySpace:
    """Return the space of the bundled rig, read and verified once a process.

    Raises:
        RigFileError: the installed file is missing or damaged.
    """
    return load_space(BUNDLED_SPACE)


def rounded(space: IdentitySpace) -> IdentitySpace:
    """Return a space as its file would hold it."""
    return replace(
        space,
        base=_stored(space.base),
        eyeball=_stored(space.eyeball),
        low=_stored(space.low),
        targets={name: _rounded_target(target) for name, target in space.targets.items()},
    )


def check_space(space: IdentitySpace) -> None:
    """Raise `RigFileError` unless every part of a space fits every other."""
    rows, vertices = len(space.base), len(space.low)
    _need(len(space.half) == len(space.twins) <= rows - 4, "half and twins of one length below the base's", rows)
    _need(rows < 2**15, f"fewer than {2**15} rows", rows)
    _need(space.base.shape[1:] == space.eyeball.shape[1:] == (3,), "base and eyeball (.., 3)", space.base.shape)
    _need(space.eyes.shape == (2, len(space.eyeball)), f"two eyeballs of {len(space.eyeball)}", space.eyes.shape)
    for name in _INDICES:
        index = getattr(space, name)
        _need(bool(((index >= 0) & (index < vertices)).all()), f"{name} within {vertices} vertices", index.shape)
    for name in ("base", "eyeball", "low"):
        _need(bool(np.isfinite(getattr(space, name)).all()), f"finite {name}", "others")
    for name, target in space.targets.items():
        _need(target.offsets.shape == (len(target.rows), 3), f"target {name} (rows, 3)", target.offsets.shape)
        _need(bool(((target.rows >= 0) & (target.rows < rows)).all()), f"target {name} within {rows} rows", name)
        # A row that is named twice would be moved once.
        _need(bool((np.diff(target.rows) > 0).all()), f"target {name} with rising rows", name)
    _check_parameters(space)


def _check_parameters(space: IdentitySpace) -> None:
    names = [known.name for known in space.parameters]
    _need(len(set(names)) == len(names) and set(names) >= MACROS, f"{sorted(MACROS)} and details, each once", names)
    for known in space.parameters:
        fits = -_FARTHEST <= known.low <= known.default <= known.high <= _FARTHEST
        _need(fits, f"{known.name}: low <= default <= high, within {_FARTHEST}", known)
    total = sum(space.ranges[name].default for name in ANCESTRIES)
    _need(abs(total - 1) <= SHARE_TOLERANCE, "default shares that sum to 1", total)
    _check_targets(space)


def _check_targets(space: IdentitySpace) -> None:
    """Raise unless there is a target for either end of every parameter; of shares one has to stand alone."""
    alone: list[dict[str, float]] = [{other: float(other == name) for other in ANCESTRIES} for name in ANCESTRIES]
    rest = (known for known in space.parameters if known.name not in ANCESTRIES)
    extremes = [*alone, *({known.name: end} for known in rest for end in (known.low, known.high))]
    unknown = sorted({name for point in extremes for name in space.weights(point)} - set(space.targets))
    _need(not unknown, "a target for every parameter", unknown)


def _rounded_target(target: Target) -> Target:
    moves = steps(target.offsets, STEPS_PER_MILLIMETRE)
    moved = moves.any(1)
    return Target(target.rows[moved], millimetres(moves[moved], STEPS_PER_MILLIMETRE))


def _stored(lengths: NDArray[np.float32]) -> NDArray[np.float32]:
    return millimetres(steps(lengths, BASE_STEPS), BASE_STEPS)


def _arrays(space: IdentitySpace) -> dict[str, NDArray[Any]]:
    arrays: dict[str, NDArray[Any]] = {name: getattr(space, name) for name in _INDICES}
    arrays |= {name: steps(getattr(space, name), BASE_STEPS) for name in ("base", "eyeball", "low")}
    for name, target in space.targets.items():
        moves = steps(target.offsets, STEPS_PER_MILLIMETRE)
        _need(bool((np.abs(moves) < 2**15).all()), "offsets below 512 mm", float(np.abs(target.offsets).max(initial=0)))
        # One coordinate after the other, each as the change from row to row: neighbours move alike.
        arrays[f"target/{_file_name(name)}/rows"] = np.diff(target.rows, prepend=0).astype(np.int16)
        arrays[f"target/{_file_name(name)}/steps"] = np.diff(moves.astype(np.int16), axis=0, prepend=0).T.copy()
    return arrays


def _space(document: dict[str, Any], arrays: Mapping[str, NDArray[Any]], digest: str) -> IdentitySpace:
    return IdentitySpace(
        topology=str(document["topology"]),
        parameters=tuple(_parameter(entry) for entry in document["parameters"]),
        base=millimetres(integers(arrays, "base", 2, np.int32), BASE_STEPS),
        half=integers(arrays, "half", 1, np.int32),
        twins=integers(arrays, "twins", 1, np.int32),
        eyes=integers(arrays, "eyes", 2, np.int32),
        eyeball=millimetres(integers(arrays, "eyeball", 2, np.int32), BASE_STEPS),
        targets={str(name): _target(str(name), arrays) for name in document["targets"]},
        low=millimetres(integers(arrays, "low", 1, np.int32), BASE_STEPS),
        lid_correctives=tuple((str(name), str(method)) for name, method in document["lid_correctives"]),
        hash=digest,
    )


def _parameter(entry: list[Any]) -> Parameter:
    name, region, low, high, default, meaning = entry
    return Parameter(str(name), str(region), float(low), float(high), float(default), str(meaning))


def _target(name: str, arrays: Mapping[str, NDArray[Any]]) -> Target:
    place = f"target/{_file_name(name)}"
    rows, moves = integers(arrays, f"{place}/rows", 1, np.int16), integers(arrays, f"{place}/steps", 2, np.int64)
    offsets = np.cumsum(moves.T, axis=0, dtype=np.int16)
    return Target(np.cumsum(rows, dtype=np.int32), millimetres(offsets, STEPS_PER_MILLIMETRE))


def _file_name(target: str) -> str:
    return target.replace("+", ".plus").removesuffix("-") + (".minus" if target.endswith("-") else "")


def _need(condition: bool, what: str, got: object) -> None:
    if not condition:
        raise RigFileError(f"space: {expected(what, got)}")
