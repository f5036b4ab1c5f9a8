"""The tables of the documents, made from the rig: what a page says of genes and emotion sets is what the file holds.

A page marks the place of a table with ``<!-- name -->`` and ``<!-- end -->``; `filled` puts the tables there:
``python -m emogen_core.rigs.tables docs/rig.md docs/emotions.md``.
"""

from __future__ import annotations

import re
import sys
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from emogen_core.errors import InvalidInputError, expected
from emogen_core.face.bundled import load_bundled_rig
from emogen_core.rigs.gene_table import RECIPES

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping, Sequence

    from emogen_core.face.rig import Rig

_PLACE = re.compile(r"<!-- (?P<name>[a-z ]+) -->\n.*?<!-- end -->", re.DOTALL)


def filled(page: str, rig: Rig) -> str:
    """Return a page with all its tables made anew.

    Raises:
        InvalidInputError: the page asks for a table that does not exist.
    """
    return _PLACE.sub(lambda place: f"<!-- {place['name']} -->\n{_named(place['name'], rig)}\n<!-- end -->", page)


def main(pages: Sequence[str]) -> None:
    """Make the tables of some pages anew from the bundled rig."""
    rig = load_bundled_rig()
    for page in map(Path, pages):
        page.write_text(filled(page.read_text("utf-8"), rig), "utf-8")


def part_table(rig: Rig) -> str:
    """Return how many triangles each part has."""
    return _table(("part", "triangles"), ((_code(name), last - first) for name, (first, last) in rig.parts.items()))


def gene_table(rig: Rig) -> str:
    """Return where every gene comes from, what it means and how far it moves a vertex of the first head."""
    recipes = {recipe.name: recipe for recipe in RECIPES}
    head = ("gene", "unit", "action units", "region", "shapes", "flags", "scale", "mm")
    rows = (
        (
            _code(gene.name),
            recipes[gene.name].unit or "made here",
            ", ".join(gene.action_units) or "-",
            gene.region,
            len(gene.members),
            ", ".join(sorted(gene.flags)) or "-",
            f"{recipes[gene.name].scale:g}",
            f"{_reach(rig, gene.members):.1f}",
        )
        for gene in rig.genes
    )
    return _table(head, rows)


def set_table(rig: Rig) -> str:
    """Return the action units and genes of all emotion sets."""
    rows = (
        (name, " ".join(kit.action_units), ", ".join(_code(gene) for gene in kit.genes))
        for name, kit in rig.emotion_sets.items()
    )
    return _table(("emotion", "action units", "genes"), rows)


def emotion_table(rig: Rig, emotion: str) -> str:
    """Return the genes of one emotion set with their action units and strengths."""
    kit = rig.emotion_sets[emotion]
    units = {gene.name: " ".join(gene.action_units) or "-" for gene in rig.genes}
    rows = zip((_code(gene) for gene in kit.genes), (units[gene] for gene in kit.genes), kit.strengths, strict=True)
    return _table(("gene", "action units", "strength"), rows)


def corrective_table(rig: Rig) -> str:
    """Return every combinational corrective with its family."""
    return _table(("corrective", "family"), ((_code(c.name), c.family or "-") for c in rig.combinations))


TABLES: Mapping[str, Callable[[Rig], str]] = {
    "parts": part_table,
    "genes": gene_table,
    "emotion sets": set_table,
    "correctives": corrective_table,
}


def _named(name: str, rig: Rig) -> str:
    emotion = name.removeprefix("emotion ")
    if emotion != name and emotion in rig.emotion_sets:
        return emotion_table(rig, emotion)
    if name not in TABLES:
        raise InvalidInputError(f"table: {expected(f'one of {sorted(TABLES)} or an emotion', name)}")
    return TABLES[name](rig)


def _table(head: Iterable[object], rows: Iterable[Iterable[object]]) -> str:
    titles = list(head)
    lines: list[Iterable[object]] = [titles, ["---"] * len(titles), *rows]
    return "\n".join(f"| {' | '.join(str(cell) for cell in line)} |" for line in lines)


def _code(name: str) -> str:
    return f"`{name}`"


def _reach(rig: Rig, members: tuple[str, ...]) -> float:
    """Return how far members together move the farthest vertex at weight 1, millimetres."""
    offsets = sum(rig.offsets[rig.core_shapes.index(member)] for member in members)
    return float(np.linalg.norm(offsets, axis=1).max())


if __name__ == "__main__":
    main(sys.argv[1:])
