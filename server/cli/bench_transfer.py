"""`emogen bench transfer`: how near transferred shapes come to true ones, and how long it takes."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, Any

import numpy as np

from emogen_core.transfer.blendshapes import Template, Training, transfer
from emogen_core.transfer.packing.made_up import face_bumps, made_up_face
from emogen_core.transfer.packing.of_rig import template_of
from emogen_core.transfer.packing.pack import pack
from emogen_core.transfer.synthetic import errors, synthetic_head

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from emogen_core.face.rig import Rig

    Mesh = NDArray[np.float64]

EXPRESSIONS = (5, 10, 19)
UNTRAINED = ("copy", "deformation", "warp")
TRAINED = ("examples", "ridge", "fields")


def bench_transfer(rig: Rig, seeds: int, rounds: int) -> dict[str, Any]:
    """Return errors in mm on heads of known shapes, the rig's own heads, and seconds for a face of ICT-FaceKit's size.

    Args:
        rig: the face model; synthetic heads are made from its identities.
        seeds: synthetic heads.
        rounds: measurements of the time, of which the median is told; loading is not counted.
    """
    packed = template_of(rig)
    weights = pack(packed).weights
    template = Template(packed.neutral, packed.offsets, packed.triangles)
    return {
        "rig": {"name": rig.name, "hash": rig.hash},
        "shapes": len(packed.names),
        "vertices": len(packed.neutral),
        "seeds": seeds,
        "synthetic": _synthetic(rig, template, weights, seeds),
        "identities": _identities(rig),
        "time": _timed(rounds),
    }


def _synthetic(rig: Rig, template: Template, weights: Mesh, seeds: int) -> list[dict[str, Any]]:
    """Return the errors of each method and number of expressions, means over the heads (and the greatest of all)."""
    rows: dict[tuple[str, int], list[tuple[float, float]]] = {}
    for seed in range(1, seeds + 1):
        rng = np.random.default_rng(seed)
        source = rig.identities[rng.integers(len(rig.identities) > 1, len(rig.identities))]
        neutral, true = synthetic_head(rig.neutral(source).astype(float), template.offsets.astype(float), rng)
        meshes = neutral + np.tensordot(weights, true, 1)
        for method, count in _cases(len(weights)):
            found = transfer(template, neutral, Training(weights[:count], meshes[:count]), method)
            rows.setdefault((method, count), []).append(errors(found, true))
    shown = {count: int(weights[:count].any(0).sum()) for _, count in rows}
    return [
        {
            "method": method,
            "expressions": count,
            "shapes_shown": shown[count],
            "mean_mm": round(float(np.mean([mean for mean, _ in found])), 3),
            "max_mm": round(max(most for _, most in found), 2),
        }
        for (method, count), found in rows.items()
    ]


def _cases(every: int) -> list[tuple[str, int]]:
    counts = [*dict.fromkeys(min(count, every) for count in (*EXPRESSIONS, every))]
    return [(method, 0) for method in UNTRAINED] + [(method, count) for method in TRAINED for count in counts]


def _identities(rig: Rig) -> list[dict[str, Any]]:
    """Return how the first head's core shapes, on each other head, differ from those that it wears."""
    first, *others = rig.identities
    core = len(rig.core_shapes)
    template = Template(rig.neutral(first), rig.shape_offsets(first)[:core], rig.triangles)
    rows = []
    for head in others:
        true = rig.shape_offsets(head)[:core].astype(float)
        for method in UNTRAINED:
            mean, most = errors(transfer(template, rig.neutral(head), method=method), true)
            rows.append({"head": head, "method": method, "mean_mm": round(mean, 3), "max_mm": round(most, 2)})
    return rows


def _timed(rounds: int) -> list[dict[str, Any]]:
    """Return the seconds of a made-up face of 53 shapes and 9,409 vertices with all its packed expressions."""
    face = made_up_face(face_bumps())
    template, weights = Template(face.neutral, face.offsets, face.triangles), pack(face).weights
    rng = np.random.default_rng(1)
    neutral, true = synthetic_head(face.neutral.astype(float), face.offsets.astype(float), rng)
    training = Training(weights, neutral + np.tensordot(weights, true, 1))
    return [
        {"method": method, "expressions": len(weights) if method in TRAINED else 0, **_clocked(
            template, neutral, training, method, rounds)}
        for method in (*UNTRAINED, *TRAINED)
    ]  # fmt: skip


def _clocked(template: Template, neutral: Mesh, training: Training, method: str, rounds: int) -> dict[str, float]:
    taken = []
    for _ in range(rounds):
        began = time.perf_counter(), time.process_time()
        transfer(template, neutral, training, method)
        taken.append((time.perf_counter() - began[0], time.process_time() - began[1]))
    wall, processor = np.median(taken, axis=0).tolist()
    return {"wall_s": round(wall, 3), "processor_s": round(processor, 3)}
