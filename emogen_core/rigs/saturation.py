"""Sums that do not count aligned motion twice.

Where two vectors ``a`` and ``b`` agree (cosine ``c > 0``), their sum should be no longer than
``(|a|^p + |b|^p)^(1/p)``: it is shrunk by ``f = 1 - c (1 - that / (|a| + |b|))``. ``p`` is 2 or infinity (the larger
one wins).
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

Power = Literal["max", "two"]


def saturation(a: NDArray[np.float64], b: NDArray[np.float64], power: Power) -> NDArray[np.float64]:
    """Return (N,) the factor by which a sum of (N, d) vectors should shrink where they agree; 1 where they do not."""
    long_a, long_b = np.linalg.norm(a, axis=1), np.linalg.norm(b, axis=1)
    agreement = np.clip((a * b).sum(1) / np.maximum(long_a * long_b, 1e-9), 0, 1)
    target = np.maximum(long_a, long_b) if power == "max" else np.hypot(long_a, long_b)
    factor: NDArray[np.float64] = 1 - agreement * (1 - target / np.maximum(long_a + long_b, 1e-9))
    return factor


def saturated(a: NDArray[np.float64], b: NDArray[np.float64], power: Power) -> NDArray[np.float64]:
    """Return (N, d) the sum of two fields of vectors, saturated where they agree."""
    total: NDArray[np.float64] = saturation(a, b, power)[:, None] * (a + b)
    return total
