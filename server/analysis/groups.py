"""Do conditions differ: mean faces, intensity, dispersion, and what people answered about their faces."""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from emogen_core.analysis.comparisons import controlled, means_differ, values_differ
from emogen_core.analysis.effects import effect
from emogen_core.analysis.enough import ALPHA
from emogen_core.analysis.groups import dispersions, intensities, ratings

from .section import Column, Section, Sheet
from .telling import NAMED, counted, interval, lacking, listed, p_is, p_range, reasons, span

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from emogen_core.analysis.comparisons import Comparison
    from emogen_core.analysis.effects import Effect
    from emogen_core.analysis.groups import Groups
    from emogen_core.analysis.recorded import Faces

    from .context import Context
    from .section import Value

    Values = Callable[[Sequence[Faces]], Groups]

MEAN_FACE = "mean face"
EACH = Column("emotion"), Column("head")
COLUMNS = (
    *EACH, Column("question"), Column("conditions"), Column("design"), Column("people"),
    Column("statistic", help="Cosine distance of the means of weights, or |t|; the greatest of all pairs."),
    Column("expected", help="The same where nothing differs: a distance of means is never 0."), Column("p", 4),
    Column("q", 4, "p adjusted for false discoveries over all emotions and heads of one question."),
    Column("permutations"), Column("g", 2, "Hedges' g of the first of two conditions above the second."),
    Column("low", 2, "Lower end of its 95 % interval."), Column("high", 2),
)  # fmt: skip


@dataclass(frozen=True, slots=True)
class Compared:
    """The faces of one emotion on one head, by condition: two at least; `head` is what people call it."""

    emotion: str
    identity: str
    head: str
    groups: Mapping[str, Faces]

    @property
    def label(self) -> str:
        """What it is called."""
        return f"{self.emotion}, {self.head}"

    @property
    def faces(self) -> list[Faces]:
        """The faces of each condition."""
        return list(self.groups.values())


@dataclass(frozen=True, slots=True)
class Tested:
    """One question asked of one emotion and head: the test, its adjusted p, and of two conditions how large it is."""

    where: Compared
    question: str
    test: Comparison
    q: float | None
    effect: Effect | None


def compared(context: Context) -> tuple[Compared, ...]:
    """Return every emotion and head that there are faces of in several conditions."""
    found = []
    for emotion in context.emotions:
        for identity in context.identities:
            parts = {name: context.faces.only(emotion, identity, name) for name in context.conditions}
            groups = {name: faces for name, faces in parts.items() if len(faces)}
            if len(groups) > 1:
                found.append(Compared(emotion, identity, context.head(identity), groups))
    return tuple(found)


def conditions(context: Context) -> Section | None:
    """Return the tests of conditions, or nothing where a study has none."""
    cells = compared(context)
    if not cells:
        return None
    asked = {MEAN_FACE: None, **_numbers(context)}
    found = {
        question: _tested(context, cells, question, at, values) for at, (question, values) in enumerate(asked.items())
    }
    every = [one for tests in found.values() for one in tests]
    return Section(
        "conditions", "Do conditions differ?",
        f"Permutation tests of people. q ≤ .05: {_significant(found)}. A p above .05 does not show that conditions are"
        " alike; a result on one head is one of that head. The test of mean faces sees dispersion, too, where groups"
        " differ much in size.",
        Sheet("conditions", COLUMNS, tuple(map(_row, every))),
        lacks=tuple(
            sentence for question, tests in found.items()
            for sentence in lacking(((one.where.label, one.test) for one in tests), f"a test of {question}")
        ),
        methods=(
            f"The conditions {listed(context.conditions)} were compared by permutation of participants, with the cosine"
            " distance of mean weights for mean faces and Welch's |t| (within participants, the paired one) for"
            " intensity, for dispersion (Anderson, 2006) and for ratings; p is (b + 1) / (m + 1) (Phipson & Smyth,"
            " 2010), or exact where all permutations were made; q is p adjusted for false discoveries over emotions and"
            " heads (Benjamini & Hochberg, 1995); g is Hedges' g of the first condition above the second.",
            *(_told(question, tests) for question, tests in found.items()),
        ),
    )  # fmt: skip


def _significant(found: Mapping[str, Sequence[Tested]]) -> str:
    """Return of every question how many tests are significant."""
    able = {question: [one.q for one in tests if one.q is not None] for question, tests in found.items()}
    told = [f"{question} {sum(q <= ALPHA for q in own)} of {len(own)}" for question, own in able.items() if own]
    return ", ".join(told) or "no test could be made"


def _numbers(context: Context) -> dict[str, Values]:
    """Return what is one number a person: how strong and how far from the mean a face is, and answers about it."""
    answered = [name for name, told in context.faces.ratings.items() if not np.isnan(told).all()]
    rated: dict[str, Values] = {f"rated {name}": partial(ratings, question=name) for name in sorted(answered)}
    return {"intensity": intensities, "dispersion": dispersions, **rated}


def _tested(context: Context, cells: Sequence[Compared], question: str, at: int, values: Values | None) -> list[Tested]:
    """Return a question asked of all emotions and heads, so that their p are adjusted together."""
    tests, effects = {}, {}
    for place, one in enumerate(cells):
        rng = context.rng(3, at, place)
        people = values(one.faces) if values else None
        tests[one.label] = values_differ(people, rng) if people else means_differ(one.faces, rng)
        effects[one.label] = effect(people) if people and len(one.groups) == 2 else None
    adjusted = controlled(tests)
    return [Tested(one, question, test, adjusted.get(one.label), effects[one.label])
            for one, test in zip(cells, tests.values(), strict=True)]  # fmt: skip


def _row(one: Tested) -> tuple[Value, ...]:
    test, size = one.test, one.effect
    return (
        one.where.emotion, one.where.identity, one.question, ", ".join(one.where.groups), test.design,
        ", ".join(map(str, test.sizes)), test.statistic, test.expected, test.p, one.q, test.permutations,
        *((size.g, size.low, size.high) if size else (None, None, None)),
    )  # fmt: skip


def _told(question: str, tests: Sequence[Tested]) -> str:
    """Return what came of a question."""
    able = [one for one in tests if one.q is not None]
    why = reasons(one.test for one in tests)
    if not able:
        return f"No test of {question} could be made: {why}."
    found = [one for one in able if (one.q or 0) <= ALPHA]
    sizes = span([size for one in able for size in one.test.sizes], 0)
    left = len(tests) - len(able)
    return (
        f"Of {counted(len(able), 'test')} of {question} (n = {sizes} a condition), {len(found) or 'none'} had q ≤ .05:"
        f" {'; '.join(_results(able, found))}." + (f" {left} more could not be made: {why}." if left else "")
    )


def _results(able: Sequence[Tested], found: Sequence[Tested]) -> list[str]:
    """Return every test where there are few, else the significant ones and what p the others have."""
    named = able if len(able) <= NAMED else found[:NAMED]
    rest = [one.test.p for one in able if one not in named]
    others = [f"{'the others' if named else 'all'} had {p_range(rest)} (conditions.csv)"] if rest else []
    return [*map(_one, named), *others]


def _one(one: Tested) -> str:
    test, size = one.test, one.effect
    means = f"distance of means {test.statistic:.3f}, {test.expected:.3f} expected"
    what = means if one.question == MEAN_FACE else f"|t| = {test.statistic:.2f}"
    large = f", g = {size.g:.2f}{interval(size.low, size.high, 2)}" if size and size.g is not None else ""
    return f"{one.where.label} ({what}, {p_is(test.p or 0)}, {p_is(one.q or 0, 'q')}{large})"
