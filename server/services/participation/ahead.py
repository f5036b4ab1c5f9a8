"""What may be drawn while a participant looks: the faces that can come next."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..trials.evolve import last_generation

if TYPE_CHECKING:
    from collections.abc import Callable

    from ..faces.sketch import Sketch
    from ..trials.walk import Walk


def following(walk: Walk) -> Callable[[], list[Sketch]]:
    """Return what gives the faces to draw once those on the screen are drawn; it takes a while, so not at once."""
    step, position = walk.participation.step, walk.participation.position
    if step == "instructions":
        return _first(walk, 0)
    if step not in {"practice", "evolve"}:
        return list
    trial = walk.trial()
    if trial.generation < last_generation(walk.config, trial):
        return lambda: walk.evolution.ahead(trial)
    return _first(walk, position + 1)


def _first(walk: Walk, position: int) -> Callable[[], list[Sketch]]:
    upcoming = walk.trial_at(position)
    evolves = upcoming is not None and upcoming.kind == "evolve"
    return lambda: walk.evolution.first(upcoming) if upcoming and evolves else []
