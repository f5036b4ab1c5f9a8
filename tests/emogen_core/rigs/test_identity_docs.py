"""docs/identities.md tells what the space of heads is."""

from __future__ import annotations

from pathlib import Path

import pytest

from emogen_core.face.space_file import load_bundled_space
from emogen_core.rigs import rest

DOCS = (Path(__file__).parents[3] / "docs/identities.md").read_text()
SPACE = load_bundled_space()


@pytest.mark.parametrize("known", SPACE.parameters, ids=lambda known: known.name)
def test_every_parameter_has_its_row(known):
    row = f"| `{known.name}` | {known.region} | {known.low:g} | {known.high:g} | {known.default:g} | {known.meaning} |"
    assert row in DOCS.splitlines()


def test_no_row_is_of_something_that_does_not_exist():
    rows = [line for line in DOCS.splitlines() if line.startswith("| `")]
    names = [row.split("`")[1] for row in rows if row.count("|") == 7]
    assert names == [known.name for known in SPACE.parameters]
    assert f"{len(SPACE.details)} details" in DOCS


def test_the_bands_of_the_rest_pose_are_told():
    for low, high in (rest.UPPER_COVER, rest.LOWER_COVER):
        assert f"| {low:.2f} to {high:.2f} |" in DOCS
    assert f"at least {rest.BROW_HEIGHT[0]} mm" in DOCS
    assert f"at least {rest.CORNER_HEIGHT[0]} mm" in DOCS
