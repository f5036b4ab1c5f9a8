"""How far people's faces are apart, beside what the search alone makes of one face in mind."""

from __future__ import annotations

from itertools import combinations
from typing import TYPE_CHECKING, NamedTuple

from emogen_core.analysis.distances import beside, distances_between, distances_within

from .rows import NOISE, Span, spans_figure
from .section import Column, Section, Sheet
from .telling import cells, counted, each_or_all, interval, lacking, span, untold

if TYPE_CHECKING:
    from collections.abc import Sequence

    from emogen_core.analysis.distances import Beside, Distances
    from emogen_core.analysis.recorded import Cell, Faces

    from .context import Context
    from .section import Value

LOW_HIGH = (
    Column("low", help="Lower end of the 95 % interval, by drawing people (BCa)."),
    Column("high", help="Upper end of it."),
)
NOISES = (
    Column("simulated", help="The same of simulated people who have one face in mind and never err."),
    Column("simulated with noise", help="Of such people whose judged distances have a standard deviation of .1."),
)


class Apart(NamedTuple):
    """The distances of a cell beside both simulations."""

    cell: Cell
    faithful: Beside
    noisy: Beside

    @property
    def distances(self) -> Distances:
        """The recorded ones."""
        return self.faithful.distances


def within(context: Context) -> Section:
    """Return the distances of every two people of a cell beside the simulated distance of two results for one face."""
    found = [_apart(context, at, cell, faces) for at, (cell, faces) in enumerate(context.cells)]
    columns = (
        Column("people"), Column("pairs"), Column("mean", help="Cosine distance of the faces of two people."),
        Column("sd"), *LOW_HIGH, *NOISES, Column("excess", help="How much further apart people are than simulated."),
        Column("above", help="Whether the whole interval is above the simulated mean."),
        Column("above with noise", help="Whether it is above the one with noise as well."),
    )  # fmt: skip
    spans = [
        Span(context.label(one.cell), one.distances.mean, one.distances.low, one.distances.high, _noises(one))
        for one in found
        if one.distances.mean is not None
    ]
    return Section(
        "within", "Do people mean different faces?",
        "Distances of different people's faces for one emotion, beside those of simulated people who all look for one"
        " face in mind. An excess over both shows that people mean different faces; one over people who never err alone"
        " may as well be that people err.",
        Sheet("within", (*context.key_columns, *columns), tuple(_row(context, one) for one in found)),
        lacks=context.lacking(((one.cell, one.faithful) for one in found), "an interval"), notes=context.mixed,
        figures=(spans_figure("within", "Distances within each emotion", spans, "cosine distance", NOISE),)
        if spans else (),
        methods=(
            "Distances are cosine distances of blendshape weights; intervals draw participants, not pairs"
            " (bias-corrected and accelerated bootstrap, 1,999 draws).",
            *_told(context, [one for one in found if one.faithful.enough]),
            *untold([one.faithful for one in found], "interval of distances"),
        ),
    )  # fmt: skip


def _apart(context: Context, at: int, cell: Cell, faces: Faces) -> Apart:
    distances, noise = distances_within(faces, context.rng(1, at)), context.noise(cell)
    return Apart(cell, beside(distances, noise.faithful.apart), beside(distances, noise.noisy.apart))


def _row(context: Context, one: Apart) -> tuple[Value, ...]:
    told = one.distances
    return (
        *context.key(one.cell), told.people, told.pairs, told.mean, told.sd, told.low, told.high, *_noises(one),
        one.faithful.excess, one.faithful.above, one.noisy.above,
    )  # fmt: skip


def _noises(one: Apart) -> tuple[float, float]:
    return one.faithful.noise, one.noisy.noise


def _told(context: Context, found: Sequence[Apart]) -> tuple[str, ...]:
    def each(one: Apart) -> str:
        told = one.distances
        return (
            f"For {context.label(one.cell)}, faces of different participants were {told.mean:.3f} apart"
            f" (n = {told.people}{interval(told.low, told.high)}); simulated: {one.faithful.noise:.3f}, with noise"
            f" {one.noisy.noise:.3f}."
        )

    def together(all_: Sequence[Apart]) -> str:
        return (
            f"In {cells([one.distances.people for one in all_])}, faces of different participants were"
            f" {span(one.distances.mean for one in all_)} apart (simulated:"
            f" {span(one.faithful.noise for one in all_)}, with noise {span(one.noisy.noise for one in all_)}); the"
            f" whole interval was above the simulated mean in {sum(one.faithful.above is True for one in all_)} and"
            f" above the one with noise in {sum(one.noisy.above is True for one in all_)} of them (within.csv)."
        )

    return each_or_all(found, each, together)


def between(context: Context) -> Section:
    """Return the distances of the people of every two cells of one head and condition."""
    pairs = [(one, other) for one, other in combinations(context.cells, 2) if one[0][1:] == other[0][1:]]
    found = [
        (one, other, distances_between(mine, theirs, context.rng(2, at)))
        for at, ((one, mine), (other, theirs)) in enumerate(pairs)
    ]
    columns = (Column("other emotion"), Column("people"), Column("pairs"), Column("mean"), Column("sd"), *LOW_HIGH)
    rows = tuple(
        (*context.key(cell), other.emotion, one.people, one.pairs, one.mean, one.sd, one.low, one.high)
        for cell, other, one in found
    )
    return Section(
        "between",
        "How far apart are emotions?",
        "Distances of one person's face for an emotion to another person's face for another emotion, on one head and in"
        " one condition. Hold them against the distances within both emotions.",
        Sheet("between", (*context.key_columns, *columns), rows),
        lacks=lacking(
            ((f"{context.label(cell)} and {other.emotion}", one) for cell, other, one in found), "an interval"
        ),
        methods=_emotions([one for _, _, one in found]),
    )


def _emotions(found: Sequence[Distances]) -> tuple[str, ...]:
    """Return how far apart emotions are, and of which pairs that is not told."""
    told = [one.mean for one in found if one.enough]
    apart = (
        f"On one head and in one condition, faces of different participants for different emotions were {span(told)}"
        f" apart (mean cosine distances of {counted(len(told), 'pair of cells')}; between.csv).",
    ) if told else ()  # fmt: skip
    return (*apart, *untold(found, "distance of two emotions", "pair of cells"))
