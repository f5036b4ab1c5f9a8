"""Heads of a foreign model: its neutral, and those that its identity modes make of it.

A mode is a difference from the neutral at weight 1, one standard deviation of the people it was made from. Weights are
kept within two of them, where nearly all of these people lie; random heads are drawn from the normal distribution.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from emogen_core.errors import InvalidInputError, expected
from emogen_core.face.modes import PLAUSIBLE

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    Mesh = NDArray[np.float32]
    Modes = Mapping[str, NDArray[np.float32]]

FIRST = "neutral"
"""Name of the head that the neutral is."""


def mixed_head(neutral: Mesh, modes: Modes, weights: Mapping[str, float], eyes: NDArray[np.intp]) -> Mesh:
    """Return the (N, 3) head of some weights, its origin between the eyes as that of the neutral.

    Args:
        neutral: (N, 3) millimetres.
        modes: name -> (N, 3).
        weights: mode -> weight within `PLAUSIBLE`.
        eyes: vertices of both eyeballs; may be none.

    Raises:
        InvalidInputError: an unknown mode, or a weight that is none or not plausible.
    """
    moved = np.zeros(neutral.shape)
    for name, weight in weights.items():
        if name not in modes:
            raise InvalidInputError(f"head: {expected(f'modes among {sorted(modes)}', name)}")
        if not abs(weight) <= PLAUSIBLE:
            raise InvalidInputError(f"{name}: {expected(f'a number in [{-PLAUSIBLE:g}, {PLAUSIBLE:g}]', weight)}")
        moved += weight * modes[name]
    if len(eyes):
        moved -= moved[eyes].mean(0)
    return np.asarray(neutral + moved, np.float32)


def random_weights(modes: Modes, generator: np.random.Generator) -> dict[str, float]:
    """Return mode -> weight of a random plausible head."""
    drawn = np.clip(generator.standard_normal(len(modes)), -PLAUSIBLE, PLAUSIBLE)
    return {name: round(float(weight), 3) for name, weight in zip(modes, drawn, strict=True)}


def parse_head(text: str) -> tuple[str, dict[str, float]]:
    """Return name and weights of ``NAME=identity000:1.2,identity001:-0.5``.

    Raises:
        InvalidInputError: it is not written so.
    """
    name, _, listed = text.partition("=")
    try:
        entries = [entry.split(":") for entry in listed.split(",") if entry.strip()]
        weights = {mode.strip(): float(weight) for mode, weight in entries}
    except ValueError:
        name = ""
        weights = {}
    if not name.strip() or not weights:
        raise InvalidInputError(f"head: {expected('NAME=MODE:WEIGHT,..., as anna=identity000:1.2', text)}")
    return name.strip(), weights
