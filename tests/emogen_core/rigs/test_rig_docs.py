"""docs/rig.md and docs/emotions.md tell what the bundled rig is: their tables are made from it."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from emogen_core.errors import InvalidInputError
from emogen_core.face.bundled import load_bundled_rig
from emogen_core.rigs.tables import TABLES, filled

DOCS = Path(__file__).parents[3] / "docs"
RIG = load_bundled_rig()


@pytest.mark.parametrize("page", ["rig.md", "emotions.md"])
def test_the_tables_are_those_of_the_rig(page):
    text = (DOCS / page).read_text()
    assert filled(text, RIG) == text


def test_every_table_is_in_a_page():
    pages = "".join((DOCS / page).read_text() for page in ("rig.md", "emotions.md"))
    assert all(f"<!-- {name} -->" in pages for name in (*TABLES, *(f"emotion {name}" for name in RIG.emotion_sets)))


def test_a_table_changes_with_the_rig():
    page = "before\n<!-- genes -->\nold\n<!-- end -->\nafter"
    made = filled(page, RIG)
    assert made.startswith("before\n<!-- genes -->\n| gene |")
    assert made.endswith("|\n<!-- end -->\nafter")
    assert filled(made, RIG) == made
    assert filled(made, replace(RIG, genes=RIG.genes[1:])) != made


def test_a_table_that_does_not_exist_is_named():
    with pytest.raises(InvalidInputError, match=r"table: expected .*genes.* got .*emotion bored"):
        filled("<!-- emotion bored -->\n<!-- end -->", RIG)
