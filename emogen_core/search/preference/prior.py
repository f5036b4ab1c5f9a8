"""What is believed before the first answer: some genes are at work, evenly strong; nothing of emotions.

How many of the A genes are on is beta-binomial(1, 3): any number may be, few are likelier; but not none, since
somebody who chooses has something in mind. A gene that is on is U(0, 1). The noise scale tau of an answer is
log-uniform, and either metric is as likely as the other.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from emogen_core.search.preference.sample import Sample
from emogen_core.search.preference.utility import METRICS

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

SPARSITY = 3
"""Second parameter of the beta distribution of the share of genes that are on; the first is 1."""
LOG_TAU = (float(np.log(0.01)), float(np.log(0.3)))


def birth_odds(genes: int) -> Floats:
    """Return (A + 1,) odds of one more gene that is on, given how many are and which one: p(n + 1) / p(n), 0 at A."""
    on = np.arange(genes + 1)
    return np.asarray(np.where(on < genes, (on + 1) / np.maximum(genes - on + SPARSITY - 1, 1), 0))


def drawn(uniform: Floats) -> Sample:
    """Return targets drawn from the prior, some of them empty.

    Args:
        uniform: (C, 3 + 2 A) numbers in [0, 1), independent.
    """
    genes = (uniform.shape[1] - 3) // 2
    share = 1 - (1 - uniform[:, :1]) ** (1 / SPARSITY)
    on = uniform[:, 3 : 3 + genes] < share
    low, high = LOG_TAU
    return Sample(
        np.where(on, uniform[:, 3 + genes :], 0),
        low + (high - low) * uniform[:, 1],
        (uniform[:, 2] * METRICS).astype(np.intp),
    )
