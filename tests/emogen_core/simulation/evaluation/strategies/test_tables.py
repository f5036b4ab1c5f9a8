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


def test_every_complexity_has_faces_of_both():
    for name in ("strategy-diversity", "strategy-active"):
        assert len(TOLD[name].rows) == 2 * 2 * len(COMPLEXITIES)
