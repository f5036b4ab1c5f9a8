"""People with themselves: what they name beside what they made, and how they search."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from emogen_core.analysis.enough import ALPHA, FEWEST_PEOPLE, Result, too_few
from emogen_core.analysis.intervals import people_mean
from emogen_core.analysis.matching import match
from emogen_core.analysis.process import process

from .section import Column, Section, Sheet
from .telling import counted, interval, p_is, span

if TYPE_CHECKING:
    from collections.abc import Sequence

    from emogen_core.analysis.intervals import Interval
    from emogen_core.analysis.matching import Match
    from emogen_core.analysis.recorded import Cell, Faces

    from .context import Context
    from .section import Value

MEASURES = {
    "speed": "Mean cosine distance of the best faces of two generations.",
    "velocity": "How much nearer to the finished face the search comes in a generation.",
    "stability": "Share of generations in which the best face stays the very same.",
    "range": "Greatest distance of two best faces of the trial.",
    "path": "Sum of the steps.",
    "peak": "Greatest intensity.",
    "peak_generation": "The first generation that has it.",
}


def naming(context: Context) -> Section | None:
    """Return whether likeness to the own face predicts what people name, or nothing where nobody named a face."""
    judgements, made = context.recording.judgements, context.recording.chosen.only(repetition=0)
    if not len(judgements.people):
        return None
    parts: list[tuple[str, Match]] = []
    for at, condition in enumerate(context.conditions):
        own = made.only(condition=condition)
        mine = judgements.take(np.isin(judgements.people, own.people))
        parts.append((condition, match(mine, own, context.rng(6, at))))
    columns = (
        Column("condition"), Column("people"), Column("judgements"),
        Column("odds ratio", 2, "Of being named so, for .1 more similarity to the own face."),
        Column("low", 2, "Lower end of its 95 % interval."), Column("high", 2),
        Column("typical", 2, "The same for similarity to the mean of the others' faces."),
        Column("p", 4, "Two-sided, own faces shuffled over people."), Column("permutations"),
        Column("shown own", help="Judgements of the very face that somebody made, which are left out."),
    )  # fmt: skip
    rows = tuple((name, *_match(one)) for name, one in parts)
    lacks = [f"{name or 'Everybody'}: a match {one.lacks}." for name, one in parts if one.lacks]
    lacks += [f"{name or 'Everybody'}: an odds ratio {one.odds_lack}." for name, one in parts if one.odds_lack]
    return Section(
        "match", "Do people name what is like their own face?",
        "Whether a face is the more often named as the emotion that it was made for, the more it is like the"
        " face that the"
        f" person made for it{_chosen(context)}. p is the test.",
        Sheet("match", columns, rows), lacks=tuple(lacks),
        methods=(
            "Whether likeness to one's own face predicts naming was tested by shuffling own faces over participants;"
            " odds ratios, for .1 more similarity, are from generalised estimating equations with corrected robust"
            " errors (Mancl & DeRouen, 2001).",
            *(_matched(name, one) for name, one in parts),
        ),
    )  # fmt: skip


def _chosen(context: Context) -> str:
    """Return what an own face is, where the report is of another result: people know the one they saw."""
    return "" if context.recording.result == "elite" else ", which is the one last chosen as best here"


def _match(one: Match) -> tuple[Value, ...]:
    own = (one.own.value, one.own.low, one.own.high) if one.own else (None, None, None)
    typical = one.typical.value if one.typical else None
    return one.people, one.judgements, *own, typical, one.p, one.permutations, one.shown_own


def _matched(condition: str, one: Match) -> str:
    """Return what came of one condition."""
    where = f"In the condition {condition}, likeness" if condition else "Likeness"
    if one.p is None:
        return f"{where} to the own face could not be tested: a match {one.lacks}."
    verb = "predicted" if one.p <= ALPHA else "did not significantly predict"
    odds = f"; OR = {one.own.value:.2f}{interval(one.own.low, one.own.high, 2)}" if one.own else ""
    lack = "" if one.own else f"; no odds ratio: it {one.odds_lack}"
    return (
        f"{where} to the own face {verb} naming ({counted(one.people, 'participant')},"
        f" {counted(one.judgements, 'judgement')}, {p_is(one.p)}{odds}{lack})."
    )


def searching(context: Context) -> Section:
    """Return how people search: means over people, and every trial in a file."""
    found = [
        (cell, name.replace("_", " "), people_mean(values, faces.people))
        for cell, faces in context.cells
        for name, values in _measured(context, faces).items()
    ]
    rows = tuple((*context.key(cell), name, told.count, told.mean, told.low, told.high) for cell, name, told in found)
    columns = (
        Column("measure"), Column("people"), Column("mean"),
        Column("low", help="Lower end of the 95 % interval (Student)."), Column("high", help="Upper end of it."),
    )  # fmt: skip
    return Section(
        "process", "How do people search?",
        " ".join(f"{name.replace('_', ' ').capitalize()}: {words}" for name, words in MEASURES.items()),
        Sheet("process", (*context.key_columns, *columns), rows), files=(_every_trial(context),),
        lacks=context.lacking(
            ((cell, Result(lacks=too_few(faces.person_count))) for cell, faces in context.cells), "an interval"
        ),
        methods=_ranges(found),
    )  # fmt: skip


def _ranges(found: Sequence[tuple[Cell, str, Interval]]) -> tuple[str, ...]:
    """Return the range of the cells' means of every measure."""
    means: dict[str, list[float]] = {}
    for _, name, told in found:
        if told.mean is not None and told.count >= FEWEST_PEOPLE:
            means.setdefault(name, []).append(told.mean)
    ranges = "; ".join(f"{name} {span(values, 2)}" for name, values in means.items())
    if not found:
        return ()
    if not ranges:
        return ("No mean of a measure of search is told: too few people.",)
    return (f"Means of the measures of search, by cell: {ranges} (process.csv).",)


def _measured(context: Context, faces: Faces) -> dict[str, np.ndarray]:
    found = [process(path) for path in context.ways(faces)]
    return {
        name: np.array([np.nan if value is None else value for value in (getattr(one, name) for one in found)], float)
        for name in MEASURES
    }


def _every_trial(context: Context) -> Sheet:
    recording = context.recording
    measured = [
        [None if np.isnan(one) else one for one in values.tolist()]
        for values in _measured(context, recording.faces).values()
    ]
    rows = zip(
        recording.trials, recording.faces.people.tolist(), recording.faces.emotions.tolist(), *measured, strict=True
    )
    names = ("trial", "participation", "emotion", *MEASURES)
    return Sheet("process-trials", tuple(map(Column, names)), tuple(rows))
