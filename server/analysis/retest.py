"""Whether people repeat themselves: test and retest."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from emogen_core.analysis.cells import lengths
from emogen_core.analysis.comparisons import controlled
from emogen_core.analysis.enough import ALPHA
from emogen_core.analysis.icc import icc
from emogen_core.analysis.reliability import reliability, retest

from .rows import NOISE, Span, spans_figure
from .section import Column, Section, Sheet
from .telling import bounded, cells, counted, each_or_all, interval, p_is, p_range, span, untold

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from emogen_core.analysis.icc import Icc
    from emogen_core.analysis.recorded import Cell, Faces
    from emogen_core.analysis.reliability import Reliability

    from .context import Context
    from .section import Value


class Again(NamedTuple):
    """The people of a cell who made its face twice."""

    cell: Cell
    found: Reliability
    intensity: Icc
    noises: tuple[float, float]


def retests(context: Context) -> Section | None:
    """Return how well people repeat themselves, or nothing where nobody made a face twice."""
    cells = [(cell, own) for cell, own in context.recording.faces.by_cell() if (own.repetitions == 1).any()]
    if not cells:
        return None
    found = [_again(context, at, cell, own) for at, (cell, own) in enumerate(cells)]
    columns = (
        Column("people"), Column("own", help="Cosine distance of the two faces of one person."),
        Column("low", help="Lower end of the 95 % interval (Student)."), Column("high"),
        Column("simulated", help="Of two searches of simulated people for one face in mind who never err."),
        Column("simulated with noise", help="Of such people whose judged distances have a standard deviation of .1."),
        Column("excess", help="How much further apart own faces are than simulated ones."),
        Column("others", help="Distance of the faces of two people."),
        Column("identified", 2, "Share of people whose second face is nearest to their first; by chance 1 / people."),
        Column("discriminability", 2, "Chance that the own second face is nearer than another person's; .5 by chance."),
        Column("p", 4, "Of a mean rank of the own face as low by chance."),
        Column("q", 4, "p adjusted for false discoveries over the cells."),
        Column("ICC(2,1)", 2, "Of the intensity, absolute agreement."),
    )  # fmt: skip
    spans = [
        Span(context.label(one.cell), one.found.own.mean, one.found.own.low, one.found.own.high, one.noises)
        for one in found
    ]
    told = [one for one in found if one.found.enough]
    q = controlled({one.cell: one.found for one in told})
    rows = tuple((*context.key(one.cell), *_row(one, q.get(one.cell))) for one in found)
    return Section(
        "retest", "Do people repeat themselves?",
        "An excess near 0 says that people repeat themselves as well as the search allows.",
        Sheet("retest", (*context.key_columns, *columns), rows),
        lacks=context.lacking(((one.cell, one.found) for one in found), "reliability"),
        figures=(spans_figure("retest", "Distance of the two faces of one person", spans, "cosine distance", NOISE),),
        methods=(
            "Test-retest reliability was measured by the distance of the two faces of each participant beside two"
            " simulated searches for one face, by identification (Finn et al., 2015), by discriminability (Bridgeford"
            " et al., 2021), and by the ICC(2,1) of intensity (McGraw & Wong, 1996).",
            *_told(context, told), *_adjusted(q), *untold([one.found for one in found], "reliability"),
        ),
    )  # fmt: skip


def _again(context: Context, at: int, cell: Cell, own: Faces) -> Again:
    noise, pairs = context.noise(cell), retest(own)
    found = reliability(pairs, context.rng(5, at), noise.faithful.apart)
    intensity = icc(np.stack([lengths(pairs.first), lengths(pairs.second)], 1))
    return Again(cell, found, intensity, (noise.faithful.apart.mean, noise.noisy.apart.mean))


def _row(one: Again, q: float | None) -> tuple[Value, ...]:
    found, agreed = one.found, one.intensity.agreement
    return (
        found.people, found.own.mean, found.own.low, found.own.high, *one.noises, found.excess, found.others,
        found.identified, found.discriminability, found.p, q, agreed.value if agreed else None,
    )  # fmt: skip


def _told(context: Context, found: Sequence[Again]) -> tuple[str, ...]:
    return each_or_all(found, lambda one: f"For {context.label(one.cell)}, {_one(one)}", _all)


def _adjusted(q: Mapping[Cell, float]) -> tuple[str, ...]:
    """Return how many cells are significant among several."""
    if len(q) < 2:
        return ()
    return (
        f"Adjusted for false discoveries over {counted(len(q), 'cell')} (Benjamini & Hochberg, 1995),"
        f" {sum(one <= ALPHA for one in q.values())} had q ≤ .05.",
    )


def _one(one: Again) -> str:
    told, agreed = one.found, one.intensity.agreement
    icc_ = f"ICC = {bounded(agreed.value)}{interval(agreed.low, agreed.high, 2)}" if agreed else "no ICC: all alike"
    return (
        f"the two faces of a participant were {told.own.mean:.3f} apart (n = {told.people}"
        f"{interval(told.own.low, told.own.high)}; simulated: {one.noises[0]:.3f}, with noise {one.noises[1]:.3f}) and"
        f" those of different participants {told.others:.3f}; {100 * (told.identified or 0):.0f} % were identified"
        f" ({100 / told.people:.0f} % by chance), discriminability was {bounded(told.discriminability or 0)}"
        f" ({p_is(told.p or 0)}), {icc_}."
    )


def _all(all_: Sequence[Again]) -> str:
    found = [one.found for one in all_]
    simulated, noisy = (span(values) for values in zip(*(one.noises for one in all_), strict=True))
    own, others = span(one.own.mean for one in found), span(one.others for one in found)
    identified = span((one.identified for one in found), 2)
    return (
        f"In {cells([one.people for one in found])}, the two faces of a participant were {own} apart (simulated:"
        f" {simulated}, with noise {noisy}) and those of different participants {others}; identified was a share of"
        f" {identified}, discriminability was {span((one.discriminability for one in found), 2)},"
        f" {p_range(one.p for one in found)} (retest.csv)."
    )
