"""Intraclass correlation of repeated measurements, with its interval.

``ICC(2,1)``, absolute agreement with repetitions at random, and ``ICC(3,1)``, consistency with repetitions fixed, both
of single measurements, from the mean squares of people MSR, repetitions MSC and error MSE in a two-way analysis of
variance (Shrout and Fleiss 1979, doi:10.1037/0033-2909.86.2.420; intervals as in McGraw and Wong 1996,
doi:10.1037/1082-989X.1.1.30)::

    ICC(2,1) = (MSR - MSE) / (MSR + (k - 1) MSE + k (MSC - MSE) / n)
    ICC(3,1) = (MSR - MSE) / (MSR + (k - 1) MSE)
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from scipy.special import fdtri

from emogen_core.analysis.enough import VARIETY, Result, too_few
from emogen_core.analysis.intervals import LEVEL
from emogen_core.errors import InvalidInputError, expected

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

_UPPER = (1 + LEVEL) / 2


@dataclass(frozen=True, slots=True)
class Coefficient:
    """A correlation with its 95 % interval; it can be below 0."""

    value: float
    low: float
    high: float


@dataclass(frozen=True, slots=True, kw_only=True)
class Icc(Result):
    """Both coefficients of one measurement.

    Attributes:
        people, repetitions: how many.
        agreement: ICC(2,1); None with too few people or none who differ.
        consistency: ICC(3,1), the same.
    """

    people: int
    repetitions: int
    agreement: Coefficient | None = None
    consistency: Coefficient | None = None


@dataclass(frozen=True, slots=True)
class _Squares:
    """Mean squares of an (n, k) table."""

    n: int
    k: int
    people: float
    repetitions: float
    error: float


def icc(values: NDArray[np.floating]) -> Icc:
    """Return the coefficients of (n, k) values, a row a person and a column a repetition.

    Raises:
        InvalidInputError: fewer than two repetitions, or values that are not finite.
    """
    table = np.asarray(values, np.float64)
    if table.ndim != 2 or table.shape[1] < 2 or not np.isfinite(table).all():
        raise InvalidInputError(f"values: {expected('(n, k) finite numbers with k of at least 2', table.shape)}")
    n, k = table.shape
    # Without two values that differ there is no variance to share out.
    lacks = too_few(n) or too_few(2 if np.ptp(table) > 1e-12 else 1, 2, VARIETY)
    if lacks:
        return Icc(people=n, repetitions=k, lacks=lacks)
    squares = _squares(table)
    return Icc(people=n, repetitions=k, agreement=_agreement(squares), consistency=_consistency(squares))


def icc_of_columns(first: NDArray[np.floating], second: NDArray[np.floating]) -> tuple[Icc, ...]:
    """Return the coefficients of every column of two (n, G) repetitions, such as every gene."""
    return tuple(icc(np.stack(pair, 1)) for pair in zip(np.transpose(first), np.transpose(second), strict=True))


def _squares(table: Floats) -> _Squares:
    n, k = table.shape
    middle = table.mean()
    people, repetitions = table.mean(1) - middle, table.mean(0) - middle
    rest = table - middle - people[:, None] - repetitions
    return _Squares(
        n, k, float(k * (people**2).sum() / (n - 1)), float(n * (repetitions**2).sum() / (k - 1)),
        float((rest**2).sum() / ((n - 1) * (k - 1))),
    )  # fmt: skip


def _consistency(one: _Squares) -> Coefficient:
    """Return ICC(3,1); where there is no error it is 1 and so are both ends."""
    if one.error < 1e-15:
        return Coefficient(1.0, 1.0, 1.0)
    f, df, error_df = one.people / one.error, one.n - 1, (one.n - 1) * (one.k - 1)
    low, high = f / fdtri(df, error_df, _UPPER), f * fdtri(error_df, df, _UPPER)
    value, least, most = ((x - 1) / (x + one.k - 1) for x in (f, low, high))
    return Coefficient(float(value), float(least), float(most))


def _agreement(one: _Squares) -> Coefficient:
    """Return ICC(2,1); its interval has Satterthwaite's degrees of freedom (McGraw and Wong 1996, table 7)."""
    n, k, msr, msc, mse = one.n, one.k, one.people, one.repetitions, one.error
    value = (msr - mse) / (msr + (k - 1) * mse + k * (msc - mse) / n)
    if mse < 1e-15 and msc < 1e-15:
        return Coefficient(1.0, 1.0, 1.0)
    a = k * value / (n * (1 - value))
    b = 1 + k * value * (n - 1) / (n * (1 - value))
    df = (a * msc + b * mse) ** 2 / ((a * msc) ** 2 / (k - 1) + (b * mse) ** 2 / ((n - 1) * (k - 1)))
    below, above = fdtri(n - 1, df, _UPPER), fdtri(df, n - 1, _UPPER)
    rest = k * msc + (k * n - k - n) * mse
    low = n * (msr - below * mse) / (below * rest + n * msr)
    high = n * (above * msr - mse) / (rest + n * above * msr)
    return Coefficient(float(value), float(low), float(high))
