"""Tables tell the numbers of the cells."""

import numpy as np

from emogen_core.simulation.complexity import COMPLEXITIES
from emogen_core.simulation.evaluation.strategies.tables import tables
from tests.emogen_core.simulation.evaluation.strategies.made import LAST, made_cell, made_cells

CELLS = [*made_cells(), *made_cells("elite")]
TOLD = {table.name: table for table in tables(CELLS)}


def test_every_row_has_a_number_for_every_column():
    for table in TOLD.values():
        for row in table.rows:
            assert len(row.ours) == len(table.columns), table.name
            assert all(isinstance(one, float) and np.isfinite(one) for one in row.ours)
        assert len({row.label for row in table.rows}) == len(table.rows)


def test_the_last_generation_is_that_of_the_curves():
    last, curves = TOLD["strategy-errors"], TOLD["strategy-generations"]
    names = [column.name for column in last.columns]
    rows = {row.label: row.ours for row in curves.rows}
    assert [column.name for column in curves.columns] == [str(at) for at in range(LAST + 1)]
    for cell, row in zip(CELLS, last.rows, strict=True):
        told = dict(zip(names, row.ours, strict=True))
        assert row.label == cell.label
        for who in ("emogen", "preference", "mean face", "no information"):
            assert rows[f"{cell.label}: {who}"][-1] == told[who]
        assert told["ratio"] == told["preference"] / told["emogen"]


def test_goals_are_counted():
    goals = len(TOLD["strategy-goals"].rows)
    assert TOLD["strategy-goals"].why == f"{goals} of {goals} goals are met."
    (table, *_) = tables([made_cell(ratio=0.5)])
    assert table.rows[0].ours == (0.5, 0.05, 0.0)
    assert table.why.startswith(f"{len(table.rows) - 1} of {len(table.rows)} goals")


def test_what_ends_early_stands_beside_the_same_people_who_go_on():
    changes = {"generations": 4.5, "early": 75.0, "estimated": 0.2, "expected": 0.11, "cosine": np.full(LAST + 1, 0.25)}
    cell = made_cell("stop-10", 12, **changes)
    (table,) = tables([cell])
    told = dict(zip([column.name for column in table.columns], table.rows[0].ours, strict=True))
    assert table.name == "strategy-stopping"
    assert table.rows[0].label == "noise .1, ends at .1, 12 genes"
    assert told["saving %"] == 100 * (1 - 5.5 / 11)
    names = ("generations", "early %", "elite", "estimate", "expected")
    assert [told[name] for name in names] == [4.5, 75, 0.25, 0.2, 0.11]
    beside = [told[f"{name} without"] for name in ("elite", "estimate", "expected")]
    assert beside == [cell.whole.cosine[-1], cell.whole.estimated, cell.whole.expected]


def test_a_table_of_its_own_leaves_the_others_as_they_are():
    both = {table.name: (table.columns, table.rows) for table in tables([*CELLS, made_cell("stop-10")])}
    assert len(both.pop("strategy-stopping")[1]) == 1
    assert both == {name: (table.columns, table.rows) for name, table in TOLD.items()}


def test_every_complexity_has_faces_of_both():
    for name in ("strategy-diversity", "strategy-active"):
        assert len(TOLD[name].rows) == 2 * 2 * len(COMPLEXITIES)
