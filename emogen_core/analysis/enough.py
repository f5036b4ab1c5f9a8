"""Small data must not mislead: every result says whether there is enough behind it, and if not, what is lacking.

A result that lacks something still tells what can be told, such as counts and means; what cannot is None, never NaN.
"""

from __future__ import annotations

from dataclasses import dataclass

PEOPLE, FACES, PERMUTATIONS, VARIETY = "people", "faces", "distinguishable permutations", "faces that differ"
"""What can be lacking."""
FEWEST_PEOPLE = 5
"""No interval, no reliability and no distance to a leave-one-out mean with fewer people."""
ALPHA = 0.05
"""A test whose smallest possible p is above this cannot show anything, so it tells no p."""


@dataclass(frozen=True, slots=True)
class Lacking:
    """What there is too little of: `got` where `least` is needed."""

    what: str
    least: float
    got: float

    def __str__(self) -> str:
        """Return a sentence for a report."""
        what = "person" if (self.what, self.least) == (PEOPLE, 1) else self.what
        return f"needs at least {self.least:g} {what}, got {self.got:g}"


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


def too_few(got: float, least: float = FEWEST_PEOPLE, what: str = PEOPLE) -> Lacking | None:
    """Return what is lacking, or None where there is enough."""
    return Lacking(what, least, got) if got < least else None
