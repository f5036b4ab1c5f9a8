"""Rig files: a `Rig` in a container, offsets quantised and sparse, and nothing believed when it is read back."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any, NoReturn

import numpy as np

from emogen_core.errors import RigFileError, expected
from emogen_core.face.arrays import integers, millimetres, steps
from emogen_core.face.container import read_as, write_container
from emogen_core.face.rig import FLAGS, REGIONS, Adjustment, Combination, EmotionSet, Gene, Rig

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping
    from pathlib import Path

    from numpy.typing import NDArray

KIND = "rig"
# Version 2 has a strength for every gene of an emotion set.
VERSION = 2
# Positions and offsets are stored in steps of 1/512 mm: far below what can be seen, and reaching 64 mm in 16 bits.
STEPS_PER_MILLIMETRE = 512
MAX_OFFSETS = 2**25


def save_rig(rig: Rig, path: Path) -> Rig:
    """Store a rig and return it as a reader will get it: rounded to the file's step and with its hash.

    Raises:
        RigFileError: the rig contradicts itself, or an offset is too large for the file.
    """
    rounded = _rounded(rig)
    check_rig_content(rounded)
    digest = write_container(path, KIND, VERSION, _document(rounded), _arrays(rounded))
    return replace(rounded, hash=digest)


def load_rig(path: Path) -> Rig:
    """Read a rig back.

    Raises:
        RigFileError: not a rig file of this version, damaged, or its content contradicts itself.
    """
    rig = read_as(path, KIND, VERSION, _rig)
    check_rig_content(rig)
    return rig


def check_rig_content(rig: Rig) -> None:
    """Raise `RigFileError` unless every part of a rig fits every other."""
    vertices = rig.offsets.shape[1] if rig.offsets.ndim == 3 else -1
    _need(rig.offsets.shape == (len(rig.shape_names), vertices, 3), "offsets (shapes, vertices, 3)", rig.offsets.shape)
    for name, mesh in rig.neutrals.items():
        _need(
            mesh.shape == (vertices, 3) and bool(np.isfinite(mesh).all()), f"neutral {name} ({vertices}, 3)", mesh.shape
        )
    _need(bool(rig.neutrals), "an identity", 0)
    _need(bool(np.isfinite(rig.offsets).all()), "finite offsets", "others")
    _need(rig.mirror.shape in {(0,), (vertices,)}, f"mirror ({vertices},)", rig.mirror.shape)
    for name, indices in {"triangles": rig.triangles, "mirror": rig.mirror, **rig.regions}.items():
        good = indices.size == 0 or (indices.min() >= 0 and indices.max() < vertices)
        _need(bool(good), f"{name} within {vertices} vertices", indices.shape)
    for name, adjustment in rig.adjustments.items():
        shape = (len(adjustment.shapes), vertices, 3)
        _need(adjustment.offsets.shape == shape and name in rig.neutrals, f"adjustment {name} {shape}", name)
        _need(bool((adjustment.shapes < len(rig.shape_names)).all()), "adjusted shapes that exist", name)
        # Twice would be added once by the one way of evaluating, and twice by the other.
        _need(len(np.unique(adjustment.shapes)) == len(adjustment.shapes), "adjusted shapes named once", name)
    _check_names(rig)
    _check_parts(rig)


def _check_names(rig: Rig) -> None:
    _unique("shapes", rig.shape_names)
    _unique("genes", rig.gene_names)
    for gene in rig.genes:
        _need(gene.flags <= FLAGS, f"flags among {sorted(FLAGS)}", sorted(gene.flags))
        _need(gene.region in REGIONS, f"a region among {REGIONS}", gene.region)
        _among(f"members of {gene.name}", gene.members, rig.core_shapes)
    _unique("members", [member for gene in rig.genes for member in gene.members])
    for combination in rig.combinations:
        _among(f"parents of {combination.name}", combination.parents, rig.gene_names)
    for emotion, kit in rig.emotion_sets.items():
        _among(f"genes of {emotion}", kit.genes, rig.gene_names)
        fits = len(kit.strengths) == len(kit.genes) and all(0 < value <= 1 for value in kit.strengths)
        _need(fits, f"{len(kit.genes)} strengths in (0, 1] of {emotion}", kit.strengths)


def _check_parts(rig: Rig) -> None:
    _need(rig.triangles.ndim == 2 and rig.triangles.shape[1] == 3, "triangles (T, 3)", rig.triangles.shape)
    end = 0
    for name, (first, last) in sorted(rig.parts.items(), key=lambda item: item[1]):
        _need(first == end and last >= first, f"part {name} from row {end}", (first, last))
        end = last
    _need(end == len(rig.triangles), f"parts up to row {len(rig.triangles)}", end)


def _need(condition: bool, what: str, got: object) -> None:
    if not condition:
        _refuse(what, got)


def _refuse(what: str, got: object) -> NoReturn:
    raise RigFileError(f"rig: {expected(what, got)}")


def _unique(what: str, names: Iterable[str]) -> None:
    listed = list(names)
    double = sorted({name for name in listed if listed.count(name) > 1})
    _need(not double, f"{what} named once", double)


def _among(what: str, names: tuple[str, ...], known: tuple[str, ...]) -> None:
    unknown = sorted(set(names) - set(known))
    _need(bool(names) and not unknown, f"{what} that exist", unknown)


def _rounded(rig: Rig) -> Rig:
    return replace(
        rig,
        offsets=_stored(rig.offsets),
        neutrals={name: _stored(mesh) for name, mesh in rig.neutrals.items()},
        adjustments={n: Adjustment(a.shapes, _stored(a.offsets)) for n, a in rig.adjustments.items()},
    )


def _stored(lengths: NDArray[np.float32]) -> NDArray[np.float32]:
    return millimetres(steps(lengths, STEPS_PER_MILLIMETRE), STEPS_PER_MILLIMETRE)


def _document(rig: Rig) -> dict[str, Any]:
    return {
        "name": rig.name,
        "vertices": rig.offsets.shape[1],
        "genes": [
            {
                "name": gene.name,
                "members": list(gene.members),
                "action_units": list(gene.action_units),
                "region": gene.region,
                "flags": sorted(gene.flags),
            }
            for gene in rig.genes
        ],
        "core_shapes": list(rig.core_shapes),
        "combinations": [{"name": c.name, "parents": list(c.parents), "family": c.family} for c in rig.combinations],
        "collision_shapes": list(rig.collision_shapes),
        "emotion_sets": [
            {
                "name": name,
                "genes": list(kit.genes),
                "strengths": list(kit.strengths),
                "action_units": list(kit.action_units),
                "source": kit.source,
            }
            for name, kit in rig.emotion_sets.items()
        ],
        "identities": list(rig.neutrals),
        "adjusted": list(rig.adjustments),
        "parts": [[name, int(first), int(last)] for name, (first, last) in rig.parts.items()],
    }


def _arrays(rig: Rig) -> dict[str, NDArray[Any]]:
    arrays: dict[str, NDArray[Any]] = {"triangles": rig.triangles, "mirror": rig.mirror.astype(np.int32)}
    arrays |= {f"region/{name}": indices for name, indices in rig.regions.items()}
    arrays |= {f"neutral/{name}": steps(mesh, STEPS_PER_MILLIMETRE) for name, mesh in rig.neutrals.items()}
    arrays |= _packed("offset", rig.offsets)
    for name, adjustment in rig.adjustments.items():
        arrays[f"adjusted/{name}/shapes"] = adjustment.shapes.astype(np.int32)
        arrays |= _packed(f"adjusted/{name}", adjustment.offsets)
    return arrays


def _packed(prefix: str, offsets: NDArray[np.float32]) -> dict[str, NDArray[Any]]:
    """Return the moved vertices only: how many a shape has, which, and (M, 3) steps in 16 bits."""
    moves = steps(offsets, STEPS_PER_MILLIMETRE)
    _need(bool((np.abs(moves) < 2**15).all()), "offsets below 64 mm", float(np.abs(offsets).max()))
    shape, vertex = np.nonzero(moves.any(2))
    return {
        f"{prefix}/count": np.bincount(shape, minlength=len(offsets)).astype(np.int32),
        f"{prefix}/vertex": vertex.astype(np.int32),
        f"{prefix}/step": moves[shape, vertex].astype(np.int16),
    }


def _unpacked(prefix: str, arrays: Mapping[str, NDArray[Any]], vertices: int) -> NDArray[np.float32]:
    count, vertex = (integers(arrays, f"{prefix}/{part}", 1, np.int32) for part in ("count", "vertex"))
    step = integers(arrays, f"{prefix}/step", 2, np.int16)
    _need(count.sum() == len(vertex) and bool((vertex >= 0).all()), f"{prefix}: {count.sum()} vertices", len(vertex))
    # A short file could ask for any amount of memory.
    _need(len(count) * vertices <= MAX_OFFSETS, f"at most {MAX_OFFSETS} offsets", len(count) * vertices)
    offsets = np.zeros((len(count), vertices, 3), np.float32)
    offsets[np.repeat(np.arange(len(count)), count), vertex] = millimetres(step, STEPS_PER_MILLIMETRE)
    return offsets


def _rig(document: dict[str, Any], arrays: dict[str, NDArray[Any]], digest: str) -> Rig:
    vertices = int(document["vertices"])
    _need(0 < vertices <= 2**20, "at most a million vertices", vertices)
    regions = {n.removeprefix("region/"): integers(arrays, n, 1, np.int32) for n in arrays if n.startswith("region/")}
    names = _strings(document["identities"])
    return Rig(
        name=str(document["name"]),
        genes=tuple(_gene(entry) for entry in document["genes"]),
        core_shapes=_strings(document["core_shapes"]),
        combinations=tuple(_combination(entry) for entry in document["combinations"]),
        collision_shapes=_strings(document["collision_shapes"]),
        emotion_sets={entry["name"]: _emotion(entry) for entry in document["emotion_sets"]},
        offsets=_unpacked("offset", arrays, vertices),
        neutrals={name: _neutral(arrays, name) for name in names},
        triangles=integers(arrays, "triangles", 2, np.int32),
        parts={name: (int(first), int(last)) for name, first, last in document["parts"]},
        regions=regions,
        mirror=integers(arrays, "mirror", 1, np.int32),
        adjustments={name: _adjustment(name, arrays, vertices) for name in _strings(document["adjusted"])},
        hash=digest,
    )


def _gene(entry: dict[str, Any]) -> Gene:
    members, units = _strings(entry["members"]), _strings(entry["action_units"])
    return Gene(str(entry["name"]), members, units, str(entry["region"]), frozenset(_strings(entry["flags"])))


def _combination(entry: dict[str, Any]) -> Combination:
    family = entry["family"]
    return Combination(str(entry["name"]), _strings(entry["parents"]), None if family is None else str(family))


def _emotion(entry: dict[str, Any]) -> EmotionSet:
    strengths = tuple(float(value) for value in entry["strengths"])
    return EmotionSet(_strings(entry["genes"]), strengths, _strings(entry["action_units"]), str(entry["source"]))


def _adjustment(name: str, arrays: Mapping[str, NDArray[Any]], vertices: int) -> Adjustment:
    shapes = integers(arrays, f"adjusted/{name}/shapes", 1, np.int32).astype(np.intp)
    _need(bool((shapes >= 0).all()), "adjusted shapes that exist", shapes.tolist())
    return Adjustment(shapes, _unpacked(f"adjusted/{name}", arrays, vertices))


def _neutral(arrays: Mapping[str, NDArray[Any]], name: str) -> NDArray[np.float32]:
    return millimetres(integers(arrays, f"neutral/{name}", 2, np.int32), STEPS_PER_MILLIMETRE)


def _strings(values: list[Any]) -> tuple[str, ...]:
    if not isinstance(values, list) or not all(isinstance(value, str) for value in values):
        _refuse("a list of names", values)
    return tuple(values)
