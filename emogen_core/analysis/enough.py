"""Small data must not mislead: every result says whether there is enough behind it, and if not, what is lacking.

A result that lacks something still tells what can be told, such as counts and means; what cannot is None, never NaN.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

PEOPLE, FACES, PERMUTATIONS = "people", "faces", "distinguishable permutations"
"""What can be lacking because there is too little data."""
VARIETY, VALUES, DISTANCES = "faces that differ", "values that differ", "distances that differ"
ALIKE = frozenset({VARIETY, VALUES, DISTANCES})
"""What can be lacking because data are the same, however many there are."""
FEWEST_PEOPLE = 5
"""No interval, no reliability and no distance to a leave-one-out mean with fewer people."""
ALPHA = 0.05
"""A test whose smallest possible p is above this cannot show anything, so it tells no p."""


@dataclass(frozen=True, slots=True)
class Lacking:
    """What there is too little of: `got` where `least` is needed; `alike` where that is since faces are the same."""

    what: str
    least: float
    got: float
    alike: bool = False

    @property
    def reason(self) -> str:
        """Why, in few words: too little data, or data that are the same."""
        if self.what in ALIKE:
            return f"{'all' if self.got <= 1 else 'too many'} {self.what.removesuffix(' that differ')} are the same"
        if self.alike:
            return "too many are the same"
        return f"too few {PEOPLE if self.what == PERMUTATIONS else self.what}"

    def __str__(self) -> str:
        """Return a sentence for a report."""
        if self.what in ALIKE and self.got <= 1:
            return f"needs {self.what}, but {self.reason}"
        what = "person" if (self.what, self.least) == (PEOPLE, 1) else self.what
        why = f", since {self.reason}" if self.alike else ""
        return f"needs at least {self.least:g} {what}, got {self.got:g}{why}"


@dataclass(frozen=True, slots=True, kw_only=True)
class Result:
    """What every result has.

    Attributes:
        lacks: what there is too little of; None where the result can be told in full.
    """

    lacks: Lacking | None = None

    @property
    def enough(self) -> bool:
        """Whether the result can be told in full."""
        return self.lacks is None


def untestable(least: float, best: float, varied: bool, what: str = VARIETY) -> Lacking | None:
    """Return why no outcome of a permutation test could show anything, or None where one could.

    Args:
        least: smallest p that any outcome could have.
        best: what it would be if everything that is shuffled differed.
        varied: whether anything of it differs.
        what: is shuffled.
    """
    if least <= ALPHA:
        return None
    if best > ALPHA:
        return Lacking(PERMUTATIONS, 1 / ALPHA, round(1 / best))
    if not varied:
        return Lacking(what, 2, 1)
    return Lacking(PERMUTATIONS, 1 / ALPHA, math.floor(1 / least), alike=True)


def too_few(got: float, least: float = FEWEST_PEOPLE, what: str = PEOPLE) -> Lacking | None:
    """Return what is lacking, or None where there is enough."""
    return Lacking(what, least, got) if got < least else None
