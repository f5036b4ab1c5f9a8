"""Half a pair made whole: where a head has a movement of one side only, the other side is its mirror image."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from emogen_core.rigs.foreign.mirror import FLIP, mirrored
from emogen_core.rigs.foreign.model import counted
from emogen_core.rigs.foreign.names import ONE_SIDED, meaning

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from emogen_core.rigs.foreign.model import Findings, HeadModel

# A mirror image that lies farther off, millimetres, is that of something else.
_FAR = 2.0
# Below this, millimetres, a vertex rests.
_STILL = 0.01
_OTHER = {"L": "R", "R": "L"}


def with_halves(model: HeadModel, findings: Findings) -> HeadModel:
    """Return a model in which every movement of one side that ARKit knows has its other side.

    Args:
        model: in millimetres, its face looking along z.
        findings: is told what was mirrored. What has no mirror image is left as it is, and told by `find_pairs`.
    """
    halves = _halves(model)
    if not halves:
        return model
    jaw = next((offsets for name, offsets in model.expressions.items() if meaning(name).standard == "jawOpen"), None)
    mirror = mirrored(model.vertices, jaw)
    made = {}
    for name, (image, offsets) in halves.items():
        moved = np.abs(offsets).max(1) > _STILL
        if mirror.gap[moved[mirror.partner] | moved].max(initial=0) <= _FAR:
            made[name] = (image, np.asarray(offsets[mirror.partner] * FLIP, np.float32))
    if made:
        told = [f"{image} from {name}" for name, (image, _) in made.items()]
        findings.guessed.append(f"{len(made)} movements of one side were mirrored to the other: {counted(told)}.")
    return replace(model, expressions={**model.expressions, **dict(made.values())})


def _halves(model: HeadModel) -> dict[str, tuple[str, NDArray[np.float32]]]:
    """Return every half of a pair that lacks its other -> the other's name, and the half's (N, 3) offsets."""
    known = {meaning(name).standard for name in model.expressions}
    halves = {}
    for name, offsets in model.expressions.items():
        one = meaning(name)
        # Brows and cheeks of one whole shape have both sides.
        if one.side and one.stem in ONE_SIDED and one.stem not in known:
            image = f"{one.stem}_{_OTHER[one.side]}"
            if image not in known:
                halves[name] = (image, offsets)
    return halves
