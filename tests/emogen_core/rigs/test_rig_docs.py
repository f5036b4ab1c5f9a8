"""docs/rig.md tells what the bundled rig is."""

from __future__ import annotations

from pathlib import Path

import pytest

from emogen_core.face.bundled import load_bundled_rig

DOCS = (Path(__file__).parents[3] / "docs/rig.md").read_text()
RIG = load_bundled_rig()


def row(name: str) -> list[str]:
    line = next((line for line in DOCS.splitlines() if line.startswith(f"| `{name}` |")), "")
    return [cell.strip() for cell in line.split("|")[1:-1]]


@pytest.mark.parametrize("gene", RIG.genes, ids=lambda gene: gene.name)
def test_every_gene_has_its_row(gene):
    _, _, units, region, shapes, flags, *_ = row(gene.name)
    assert units == (", ".join(gene.action_units) or "-")
    assert region == gene.region
    assert int(shapes) == len(gene.members)
    assert flags == (", ".join(sorted(gene.flags)) or "-")


def test_every_corrective_and_part_has_its_row():
    assert all(row(c.name) == [f"`{c.name}`", c.family or "-"] for c in RIG.combinations)
    assert all(row(part) == [f"`{part}`", str(last - first)] for part, (first, last) in RIG.parts.items())


def test_the_emotion_sets_are_told_in_full():
    for name, kit in RIG.emotion_sets.items():
        genes = ", ".join(f"`{gene}`" for gene in kit.genes)
        assert f"| {name} | {' '.join(kit.action_units)} | {genes} |" in DOCS
