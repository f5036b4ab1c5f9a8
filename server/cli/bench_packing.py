"""`emogen bench packing`: how many expressions a rig needs, and how long it takes to find them."""

from __future__ import annotations

import time
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from emogen_core.transfer.packing.made_up import face_bumps, made_up_face
from emogen_core.transfer.packing.of_rig import template_of
from emogen_core.transfer.packing.pack import Options, pack

if TYPE_CHECKING:
    from emogen_core.face.rig import Rig
    from emogen_core.transfer.packing.template import Template

SHARES = (0.25, 0.30, 0.33, 0.40)
"""Values of mu that the paper recommends."""
VARIANTS = {
    "poseable": Options(),
    "published": Options(poseable=False),
    "published, no symmetry": Options(poseable=False, symmetric=False),
}


def bench_packing(rig: Rig, rounds: int) -> dict[str, Any]:
    """Return the numbers of expressions of a rig, and the seconds of packing it and a face of ICT-FaceKit's size.

    Loading is not counted. The processor time is told beside the wall's, so that a busy machine can be seen.
    """
    return {
        "made_up_face": _measured(made_up_face(face_bumps()), rounds),
        "rig": {"name": rig.name, "hash": rig.hash, **_measured(template_of(rig), rounds)},
        "expressions": [_counted(template_of(rig), name, mu) for name in VARIANTS for mu in SHARES],
    }


def _measured(template: Template, rounds: int) -> dict[str, Any]:
    taken = []
    for _ in range(rounds):
        began = time.perf_counter(), time.process_time()
        found = pack(template)
        taken.append((time.perf_counter() - began[0], time.process_time() - began[1]))
    wall, processor = np.median(taken, axis=0).tolist()
    return {
        "shapes": len(template.names),
        "vertices": len(template.neutral),
        "expressions": found.needed,
        "minimum": found.minimum,
        "wall_s": round(wall, 3),
        "processor_s": round(processor, 3),
    }


def _counted(template: Template, variant: str, mu: float) -> dict[str, Any]:
    greedy = pack(template, replace(VARIANTS[variant], mu=mu))
    began = time.perf_counter()
    minimal = pack(template, replace(VARIANTS[variant], mu=mu, order="minimal"))
    taken = time.perf_counter() - began
    return {
        "variant": variant,
        "mu": mu,
        "greedy": greedy.needed,
        "minimal": minimal.needed,
        "minimum": minimal.minimum,
        "minimal_s": round(taken, 3),
    }
