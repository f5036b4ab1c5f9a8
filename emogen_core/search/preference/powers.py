"""2^x from additions and multiplications alone, for arrays in single precision.

The exp of mathematics libraries differs in its last bits between processors, and in single precision that would now and
then decide a comparison, so that another machine would show other faces. Additions and multiplications are the same
everywhere (IEEE 754), and so is this: x is split into a whole number n and f in [-1/2, 1/2]; 2^f is a cubic fitted at
Chebyshev points, good to 8e-5, and n is added to the exponent.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

TERMS = tuple(np.float32(term) for term in (0.99992894, 0.69327624, 0.24260405, 0.05508868))
LIMIT = 100
"""Powers beyond it, up or down, count as this one."""
MANTISSA = 23


def power_of_two(x: NDArray[np.float32]) -> NDArray[np.float32]:
    """Return 2^x elementwise; x is used up."""
    np.maximum(x, -LIMIT, out=x)
    np.minimum(x, LIMIT, out=x)
    whole = np.rint(x)
    x -= whole
    power = TERMS[3] * x
    for term in TERMS[2:0:-1]:
        power += term
        power *= x
    power += TERMS[0]
    bits = whole.astype(np.int32)
    bits <<= MANTISSA
    bits += power.view(np.int32)
    return bits.view(np.float32)
