"""Draws from the posterior, as arrays and as the rows that a state keeps."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from emogen_core.search.params import Genome

    Floats = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Sample:
    """C draws of what somebody may have in mind and of how they judge.

    Attributes:
        genes: (C, A) targets in [0, 1), exactly 0 where a gene is off.
        log_tau: (C,) logarithm of the noise scale of an answer, in units of the utility.
        metric: (C,) index of the metric by which faces are judged.
    """

    genes: Floats
    log_tau: Floats
    metric: NDArray[np.intp]

    def at(self, which: NDArray[np.intp]) -> Sample:
        """Return some of the draws, in the order of (B,) indices."""
        return Sample(self.genes[which], self.log_tau[which], self.metric[which])

    def rows(self) -> tuple[Genome, ...]:
        """Return plain data: metric, log tau and genes of every draw."""
        table = np.column_stack([self.metric, self.log_tau, self.genes])
        return tuple(tuple(row) for row in table.tolist())


def from_rows(rows: Sequence[Sequence[float]]) -> Sample:
    """Return the draws that `Sample.rows` described."""
    table = np.array(rows, np.float64)
    return Sample(table[:, 2:], table[:, 1], table[:, 0].astype(np.intp))
