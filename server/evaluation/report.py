"""The report as one page that fetches nothing."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass
from typing import TYPE_CHECKING

from ..reporting.page import template
from ..reporting.pictures import scale
from .comparisons import comparisons
from .courses import curves, distributions
from .maps import maps
from .numbers import cells, compared

if TYPE_CHECKING:
    from collections.abc import Sequence

    from emogen_core.simulation.evaluation.table import Agreement, Table

    from ..reporting.figures import Figure
    from .faces import Studio

CITED = "threshold"
"""The table whose sentence is to be cited, with its first note, which tells how many searches it is from."""

COUNTED: dict[Agreement, tuple[str, str]] = {
    "agrees": ("agrees with the paper", "agree with the paper"),
    "agrees in trend": ("agrees in trend", "agree in trend"),
    "does not agree": ("does not agree", "do not agree"),
    "new": ("is not in the paper", "are not in the paper"),
}


@dataclass(frozen=True, slots=True)
class Facts:
    """Where the numbers come from: what a paper has to cite.

    Attributes:
        command: what makes the same report again.
        version: of Emogen.
        rig: name of the face model.
        rig_hash: SHA-256 of the face model.
        identity: the head that wears it.
        searches: for every number, unless a note says otherwise.
        seed: of the random numbers.
    """

    command: str
    version: str
    rig: str
    rig_hash: str
    identity: str
    searches: int
    seed: int


def page(tables: Sequence[Table], facts: Facts, studio: Studio | None) -> str:
    """Return the report as HTML; without a studio it says that it has no faces."""
    return template("evaluation/report.html").render(
        sections=[
            {
                "table": table,
                "figures": _figures(table),
                "gallery": studio.gallery(table.heats) if studio and table.heats else None,
            }
            for table in tables
        ],
        facts=facts,
        counted=_counted(tables),
        cells=cells,
        compared=compared,
        cited=next((" ".join([table.verdict, *table.notes[:1]]) for table in tables if table.name == CITED), ""),
        scale=scale(),
    )


def _counted(tables: Sequence[Table]) -> str:
    """Return how many tables agree with the paper, as a sentence."""
    counts = Counter(table.agreement for table in tables)
    parts = [f"{counts[name]} {words[counts[name] > 1]}" for name, words in COUNTED.items() if counts[name]]
    return f"Of {len(tables)} {'table' if len(tables) == 1 else 'tables'}: {', '.join(parts)}."


def _figures(table: Table) -> list[Figure]:
    made = (
        (table.whiskers, comparisons),
        (table.errors, distributions),
        (table.curves, curves),
        (table.maps, maps),
    )
    return [make(table) for there, make in made if there]
