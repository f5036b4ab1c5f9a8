"""How many participants a study needs to find a difference of the mean faces of two groups.

The test is of the squared distance between the mean directions of two groups of ``n`` people, against how people vary
in their groups (Anderson 2001, doi:10.1111/j.1442-9993.2001.01070.pp.x, who shuffles people). With scatter ``s`` in
``p`` directions alike its statistic is F distributed with ``p`` and ``p (2n - 2)`` degrees of freedom and, where the
faces in mind are a cosine distance ``d`` apart of which a share ``k`` arrives, with noncentrality ``p n d k / s``: half
of ``n`` times the squared distance ``2 d k``, in units of the variance ``s / p`` of a direction. With one direction
this is the t test of two groups.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from emogen_core.errors import InvalidInputError, expected

if TYPE_CHECKING:
    from emogen_core.simulation.evaluation.dispersion import Dispersion

POWER, ALPHA = 0.8, 0.05
EFFECTS = (0.02, 0.05, 0.1)
"""Cosine distances between mean faces that a study is planned for."""
MOST = 10_000


def participants(
    dispersion: Dispersion, share: float, distance: float, power: float = POWER, alpha: float = ALPHA
) -> int | None:
    """Return the least number of participants a group, or None where 10,000 are not enough.

    Args:
        dispersion: of the results of people in a group.
        share: of a squared distance between faces in mind that arrives in results (`dispersion.kept`).
        distance: cosine distance between the mean faces in mind of the two groups.
        power: chance to find the difference.
        alpha: chance to find one where there is none.

    Raises:
        InvalidInputError: a distance, power or alpha that is none.
    """
    for name, value in (("distance", distance), ("power", power), ("alpha", alpha)):
        if not 0 < value < 1:
            raise InvalidInputError(f"{name}: {expected('a number between 0 and 1', value)}")

    def enough(people: int) -> bool:
        """Whether so many find the difference."""
        return power_of(dispersion, share, distance, people, alpha) >= power

    # From below: far beyond what is enough the distribution function fails.
    high = 2
    while not enough(high):
        if high >= MOST:
            return None
        high = min(2 * high, MOST)
    low = high // 2
    while high - low > 1:
        middle = (low + high) // 2
        low, high = (low, middle) if enough(middle) else (middle, high)
    return high


def power_of(dispersion: Dispersion, share: float, distance: float, people: int, alpha: float = ALPHA) -> float:
    """Return the chance to find a difference with so many people, at least two, in each of two groups."""
    # Takes longer to load than everything else here.
    from statsmodels.stats.power import ftest_power_f2  # noqa: PLC0415

    if not dispersion.scatter:
        return 1.0 if share else alpha
    above, below = dispersion.dimension, dispersion.dimension * (2 * people - 2)
    noncentrality = dispersion.dimension * people * distance * share / dispersion.scatter
    return float(ftest_power_f2(noncentrality / (above + below), above, below, alpha, ncc=0))
