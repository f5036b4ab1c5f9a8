"""Whether emotions are the same on every head."""

from __future__ import annotations

from typing import TYPE_CHECKING

from emogen_core.analysis.enough import PERMUTATIONS
from emogen_core.analysis.independence import agreement, head_effect

from .section import Column, Section, Sheet
from .telling import counted, interval, p_is, reasons, span

if TYPE_CHECKING:
    from collections.abc import Sequence

    from emogen_core.analysis.independence import Agreement, HeadEffect

    from .context import Context


def heads(context: Context) -> Section | None:
    """Return whether emotions are the same on every head, or nothing with a single head."""
    if len(context.identities) < 2:
        return None
    together = agreement(context.faces, context.rng(7, 0))
    found = [
        (emotion, head_effect(context.faces.only(emotion), context.rng(7, 1 + at)))
        for at, emotion in enumerate(context.emotions)
    ]
    columns = (
        Column("emotion"), Column("people"), Column("same head", help="Distance of two people's faces on one head."),
        Column("other head", help="The same on two heads."), Column("excess"),
        Column("low", help="Lower end of the 95 % interval of the excess."),
        Column("high", help="Upper end of it: how large an influence of the head is still possible."),
    )  # fmt: skip
    whole = (
        Column("same", help="Distance of mean faces of one emotion on two heads."), Column("other"),
        Column("identified", 2), Column("tied", 2, "Share of mean faces to which several are equally near."),
        Column("p", 4), Column("permutations"),
    )  # fmt: skip
    lacks = [f"{emotion}: an influence of the head {one.lacks}." for emotion, one in found if one.lacks]
    lacks += [f"All emotions: agreement of heads {together.lacks}."] if together.lacks else []
    return Section(
        "heads", "Are emotions the same on every head?",
        _agreed(together),
        Sheet(
            "heads", columns,
            tuple(
                (name, one.people, one.same_head, one.other_head, one.excess, one.low, one.high) for name, one in found
            ),
        ),
        files=(
            Sheet("heads-agreement", whole,
                  ((together.same, together.other, together.identified, together.tied, together.p,
                    together.permutations),)),
        ),
        lacks=tuple(lacks),
        notes=("A difference that is not significant shows no independence: look at the upper end of the interval.",),
        methods=(_agreed(together), *_effects(found)),
    )  # fmt: skip


def _agreed(found: Agreement) -> str:
    if found.same is None or found.other is None or found.identified is None:
        return f"Whether mean faces of one emotion on different heads agree cannot be told: {reasons([found])}."
    told = (
        f"Mean faces of one emotion on two heads were {found.same:.3f} apart, of two emotions {found.other:.3f}; for"
        f" {100 * found.identified:.0f} % of them the nearest on another head was of the same emotion"
    )
    if found.tied:
        told += f", where for {100 * found.tied:.0f} % several are equally near and each counts its share"
    if found.lacks:
        few = found.lacks.what == PERMUTATIONS and not found.lacks.alike
        return f"{told} (no test: {'too few emotions and heads' if few else found.lacks.reason})."
    return f"{told} (permutation of emotions, {p_is(found.p or 0)})."


def _effects(found: Sequence[tuple[str, HeadEffect]]) -> tuple[str, ...]:
    """Return how much further apart faces are on two heads, and how much is still possible."""
    told, missing = [(emotion, one) for emotion, one in found if one.enough], [one for _, one in found if one.lacks]
    if not told:
        return (f"How much a head changes the faces of one emotion cannot be told: {reasons(missing)}.",)
    if len(told) == 1:
        ((emotion, one),) = told
        each = f"{one.excess:.3f} ({emotion}, n = {one.people}{interval(one.low, one.high)})"
    else:
        each = f"{span(one.excess for _, one in told)} (by emotion; below 0 is nearer)"
    most = max(told, key=lambda one: one[1].high or 0)
    return (
        f"Faces of different participants for one emotion were {each} further apart on two heads than on one; the"
        f" greatest upper end of the 95 % intervals was {most[1].high:.3f} ({most[0]})."
        + (f" It cannot be told of {counted(len(missing), 'emotion')}: {reasons(missing)}." if missing else ""),
    )
