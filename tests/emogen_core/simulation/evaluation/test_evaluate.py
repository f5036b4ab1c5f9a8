"""The evaluation as a whole: complete, and the same for the same seed however it is shared out."""

import numpy as np
import pytest

from emogen_core.errors import InvalidInputError
from emogen_core.simulation.evaluation.evaluate import TABLES, evaluate
from emogen_core.simulation.evaluation.work import Processes
from tests.emogen_core.simulation.evaluation.laboratories import small_laboratory


def numbers(tables):
    return {(table.name, row.label): row.ours for table in tables for row in table.rows}


def test_every_table_is_made_on_any_rig():
    # A small rig has fewer genes than some settings ask for.
    made = evaluate(
        small_laboratory(generations=7), [name for name in TABLES if name not in {"activation", "settings"}], 12
    )
    for table in made:
        assert table.rows, table.name
        assert all(len(row.ours) == len(table.columns) for row in table.rows), table.name
        assert all(len(row.paper) <= len(table.columns) for row in table.rows), table.name
        assert table.verdict.endswith(".")
        assert table.agreement == "new" or table.doubt or table.why, f"{table.name} gives no reason where it differs"
        assert (table.agreement == "new") == (table.source == "")
        assert all(np.isfinite([one for one in row.ours if one is not None]).all() for row in table.rows)
        assert all(np.isfinite(one).all() for one in table.errors.values())


def test_the_same_seed_gives_the_same_numbers_alone_and_shared_out():
    names = ["noise", "pressure"]
    one = numbers(evaluate(small_laboratory(), names, 230))
    two = numbers(evaluate(small_laboratory(), names, 230, Processes(2)))
    only = numbers(evaluate(small_laboratory(), ["pressure", "pressure"], 230))
    other = numbers(evaluate(small_laboratory(seed=2), names, 230))
    assert one == two
    assert only == {key: value for key, value in one.items() if key[0] == "pressure"}
    assert other != one


def test_progress_counts_every_chunk_once():
    told = []
    evaluate(small_laboratory(), ["noise"], 230, progress=lambda done, of: told.append((done, of)))
    assert [done for done, _ in told] == list(range(1, len(told) + 1))
    assert {of for _, of in told} == {len(told)}


def test_an_unknown_table_is_refused():
    with pytest.raises(InvalidInputError, match="tables: expected some of"):
        evaluate(small_laboratory(), ["table 9"], 10)
