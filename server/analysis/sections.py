"""The parts of the report, in its order."""

from __future__ import annotations

from typing import TYPE_CHECKING

from .apart import between, within
from .genes import differences, genes
from .groups import conditions
from .heads import heads
from .kinds import mixtures, neighbours, plane
from .means import means
from .others import converging, proxies
from .people import naming, searching
from .retest import retests

if TYPE_CHECKING:
    from collections.abc import Callable

    from .context import Context
    from .section import Section

SECTIONS: tuple[Callable[[Context], Section | None], ...] = (
    means, within, proxies, converging, between, conditions, genes, differences, plane, mixtures, neighbours, retests,
    naming, heads, searching,
)  # fmt: skip
"""Each makes a section, or none where a study has nothing of the kind."""


def sections(context: Context, done: Callable[[int, int], object] = lambda _done, _of: None) -> list[Section]:
    """Return the parts of the report that the data have something for.

    Args:
        context: the analysis.
        done: told after each how many are done, of how many.
    """
    made = []
    for at, make in enumerate(SECTIONS, 1):
        section = make(context)
        if section is not None:
            made.append(section)
        done(at, len(SECTIONS))
    return made
