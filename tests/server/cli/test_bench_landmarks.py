"""The benchmark of feature points, and its table in the documentation."""

import json
import re
from pathlib import Path

import pytest
from typer.testing import CliRunner

from emogen_core.landmarks.solvers import METHODS
from server.cli import app
from server.cli.bench_landmarks import REGIONS, bench_landmarks, landmarks_text

DOC = (Path(__file__).parents[3] / "docs" / "landmarks.md").read_text()


@pytest.fixture(scope="module")
def report():
    return bench_landmarks(1, 1)


def test_all_sets_have_all_methods_and_the_paper_stands_beside(report):
    wanted = [(method, regions) for method in METHODS for regions in REGIONS]
    for rows in report["sets"].values():
        assert [(row["method"], row["regions"]) for row in rows] == wanted
        assert all(row["milliseconds"] > 0 for row in rows)
    assert [row["method"] for row in report["crossovers"]] == [name for name in METHODS if name.startswith("ga-")]
    assert report["published"]["fitness_by_regions"] == {"1": 0.96, "2": 0.972, "4": 0.981}


def test_the_documentation_has_the_table_of_the_command(report):
    """Not its figures, which take a minute, but all its rows and columns."""
    tables = landmarks_text(report).split("\n\n")
    for mark, table, columns in (("bench", tables[0], 3), ("crossovers", tables[1], 2)):
        told = re.search(rf"<!-- {mark} -->\n(.*?)\n\n", DOC, re.DOTALL).group(1).splitlines()
        printed = table.splitlines()
        assert told[:2] == printed[:2]
        assert [line.split("|")[1:columns] for line in told] == [line.split("|")[1:columns] for line in printed]


def test_the_command_finds_the_same_figures_again(report):
    done = CliRunner().invoke(app, ["bench", "landmarks", "--expressions", "1", "--seed", "1", "--json"])
    assert done.exit_code == 0, done.output
    for rows, again in zip(report["sets"].values(), json.loads(done.stdout)["sets"].values(), strict=True):
        for row, other in zip(rows, again, strict=True):
            assert {**row, "milliseconds": 0} == {**other, "milliseconds": 0}
