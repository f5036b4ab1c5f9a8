"""In which genes, and where on the face, do conditions differ."""

from __future__ import annotations

from itertools import combinations
from typing import TYPE_CHECKING, NamedTuple

from emogen_core.analysis.enough import ALPHA
from emogen_core.analysis.genes import gene_differences
from emogen_core.similarity.cosine import cosine_distance

from .faces import Two
from .groups import EACH, compared
from .section import Column, Section, Sheet
from .telling import NAMED, counted, lacking, listed, p_is, reasons

if TYPE_CHECKING:
    from collections.abc import Sequence

    from emogen_core.analysis.genes import GeneDifference, GeneDifferences

    from .context import Context
    from .groups import Compared
    from .section import Value

SHOWN = 24
"""Differences that are drawn at most."""


class Pair(NamedTuple):
    """Two conditions of one emotion and head."""

    where: Compared
    first: str
    second: str
    found: GeneDifferences

    @property
    def label(self) -> str:
        """What it is called."""
        return f"{self.where.label}, {self.first} and {self.second}"


def genes(context: Context) -> Section | None:
    """Return the genes that differ between every two conditions, or nothing where a study has none."""
    pairs = [(one, *two) for one in compared(context) for two in combinations(one.groups, 2)]
    if not pairs:
        return None
    found = [
        Pair(one, a, b, gene_differences(one.groups[a], one.groups[b], context.rng(4, at)))
        for at, (one, a, b) in enumerate(pairs)
    ]
    rows = [(gene.q, _row(context, pair, gene)) for pair in found for gene in pair.found.genes]
    columns = (
        *EACH, Column("condition"), Column("other condition"), Column("people"), Column("gene"),
        Column("difference", help="Of the means of the first condition from the second."),
        Column("g", 2, "Hedges' g; none with fewer than 5 people in a group or where nobody in one differs."),
        Column("low", 2, "Lower end of its 95 % interval."), Column("high", 2),
        Column("p", 4), Column("q", 4, "p adjusted for false discoveries over the genes that are tested."),
    )  # fmt: skip
    discovered = tuple(row for q, row in rows if q <= ALPHA)
    return Section(
        "genes", "In which genes do conditions differ?",
        f"{len(discovered)} of {counted(len(rows), 'test')} of a gene have q of at most .05; these are shown, all are"
        " in all-genes.csv. Genes at work in too few people to show anything are not tested.",
        Sheet("genes", columns, discovered), files=(Sheet("all-genes", columns, tuple(row for _, row in rows)),),
        lacks=lacking(((pair.label, pair.found) for pair in found), "a test of genes"),
        methods=(
            "Single genes were compared in the same way, with q over the genes of one comparison.",
            *_told(context, found),
        ),
    )  # fmt: skip


def _row(context: Context, pair: Pair, gene: GeneDifference) -> tuple[Value, ...]:
    size = gene.effect
    return (
        pair.where.emotion, pair.where.identity, pair.first, pair.second, ", ".join(map(str, pair.found.sizes)),
        context.rig.gene_names[gene.gene],
        size.difference, size.g, size.low, size.high, gene.p, gene.q,
    )  # fmt: skip


def _told(context: Context, found: Sequence[Pair]) -> list[str]:
    """Return of each comparison the genes that differ most, in one sentence those where none does."""
    able = [pair for pair in found if pair.found.genes]
    told = [_differ(context, pair) for pair in able if _significant(pair)]
    none = [pair for pair in able if not _significant(pair)]
    if none:
        tests = sum(len(pair.found.genes) for pair in none)
        least = min(gene.q for pair in none for gene in pair.found.genes)
        told.append(
            f"In {counted(len(none), 'comparison')} ({counted(tests, 'test')}) no gene had q ≤ .05"
            f" (smallest {p_is(least, 'q')})."
        )
    unable = [pair.found for pair in found if not pair.found.genes]
    if unable:
        told.append(f"In {counted(len(unable), 'comparison')} no gene could be tested: {reasons(unable)}.")
    return told


def _significant(pair: Pair) -> list[GeneDifference]:
    return sorted((gene for gene in pair.found.genes if gene.q <= ALPHA), key=lambda gene: gene.p)


def _differ(context: Context, pair: Pair) -> str:
    found = _significant(pair)
    names = [f"{context.rig.gene_names[gene.gene]} ({_large(gene)}{p_is(gene.q, 'q')})" for gene in found[:NAMED]]
    more = f" and {len(found) - NAMED} more (genes.csv)" if len(found) > NAMED else ""
    sizes = listed([str(size) for size in pair.found.sizes])
    return (
        f"{pair.label} (n = {sizes}): {len(found)} of {len(pair.found.genes)} genes differed, {', '.join(names)}{more}."
    )


def _large(gene: GeneDifference) -> str:
    return "" if gene.effect.g is None else f"g = {gene.effect.g:.2f}, "


def differences(context: Context) -> Section:
    """Return where two mean faces differ: of two conditions, or of two emotions where there are no conditions."""
    pairs = _pairs(context)
    rows = tuple((two.label, two.identity, *two.names, distance) for two, distance in pairs)
    greatest = sorted(range(len(pairs)), key=lambda at: -pairs[at][1])[:SHOWN]
    drawn = [pairs[at] for at in sorted(greatest)]
    studio = context.studio
    notes = (f"The {SHOWN} greatest of {len(pairs)} are drawn.",) if len(pairs) > SHOWN else ()
    return Section(
        "differences", "Where do mean faces differ?",
        "Two mean faces of one head, and how far apart their surfaces are. Where no test is significant, colour"
        " is noise.",
        Sheet(
            "differences",
            (Column("faces"), Column("head"), Column("first"), Column("second"), Column("cosine distance")), rows,
        ),
        notes=notes, gallery=studio.differences([two for two, _ in drawn]) if studio and drawn else None,
    )  # fmt: skip


def _pairs(context: Context) -> list[tuple[Two, float]]:
    """Return pairs of mean faces of one head that differ in condition, or else in emotion, and their distance."""
    several = len(context.conditions) > 1
    found = []
    for one, other in combinations(context.summaries, 2):
        same_emotion = one.cell.emotion == other.cell.emotion
        if one.cell.identity == other.cell.identity and same_emotion == several:
            names = (one.cell[2], other.cell[2]) if several else (one.cell.emotion, other.cell.emotion)
            label = f"{one.cell.emotion if several else ' and '.join(names)}, {context.head(one.cell.identity)}"
            two = Two(label, one.cell.identity, names, (one.weights, other.weights))
            found.append((two, float(cosine_distance(one.weights, other.weights))))
    return found
