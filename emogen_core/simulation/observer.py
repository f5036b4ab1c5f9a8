"""How a simulated participant judges ten faces: the paper's consistent one, and people who are not.

The paper's participant never errs (EmoGen 2021, section IV-A). Ours adds what people do: noise on the judged distance,
lapses, a face in mind that drifts, and a liking for places on the left. All at 0 is the paper's.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from emogen_core.errors import InvalidInputError, expected
from emogen_core.search.params import POPULATION

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Observer:
    """How somebody judges.

    Attributes:
        noise: standard deviation of the error of a judged distance, in units of the metric.
        lapse: chance that the whole choice is made at random.
        drift: standard deviation of the step that every gene of the face in mind takes after each generation.
        left: how much nearer the first place seems than the last one, in units of the metric.
    """

    noise: float = 0.0
    lapse: float = 0.0
    drift: float = 0.0
    left: float = 0.0

    def __post_init__(self) -> None:
        """Refuse what is no noise, chance or bias."""
        for name in ("noise", "drift"):
            if not (np.isfinite(getattr(self, name)) and getattr(self, name) >= 0):
                raise InvalidInputError(f"{name}: {expected('0 or more', getattr(self, name))}")
        if not 0 <= self.lapse <= 1:
            raise InvalidInputError(f"lapse: {expected('a chance in [0, 1]', self.lapse)}")
        if not np.isfinite(self.left):
            raise InvalidInputError(f"left: {expected('a finite number', self.left)}")

    def ranked(
        self, distances: Floats, rng: np.random.Generator, places: NDArray[np.intp] | None = None
    ) -> NDArray[np.intp]:
        """Return the (R, 10) slots from 0 as this observer ranks them, the nearest first; the first of equals wins.

        Args:
            distances: (R, 10) true distances by slot.
            rng: numbers are drawn whatever the settings are, so that two observers see the same searches.
            places: (R, 10) where the slots are on the screen, from 0; drawn unless given.
        """
        error = rng.standard_normal(distances.shape)
        drawn = np.argsort(np.argsort(rng.random(distances.shape), axis=1), axis=1)
        places = drawn if places is None else places
        whims = rng.random(distances.shape)
        absent = rng.random(len(distances)) < self.lapse
        judged = distances + self.noise * error + self.left * places / (POPULATION - 1)
        return np.argsort(np.where(absent[:, None], whims, judged), axis=1, kind="stable")

    def drifted(self, target: Floats, active: tuple[int, ...], rng: np.random.Generator) -> Floats:
        """Return the (R, G) genomes in mind after one more generation; genes that are switched off stay.

        Args:
            target: (R, G) genomes in mind.
            active: indices of the genes that move.
            rng: numbers are drawn only where minds drift, so it must be a stream that nothing else draws from.
        """
        if not self.drift:
            return target
        step = np.zeros_like(target)
        step[:, list(active)] = self.drift * rng.standard_normal((len(target), len(active)))
        return np.clip(target + step, 0, 1)


FAITHFUL = Observer()
"""The paper's participant."""
