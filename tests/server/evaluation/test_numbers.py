"""Rows as people read them: one cell a column, the paper's number with the digits that it prints."""

from dataclasses import replace

from emogen_core.simulation.evaluation.table import Column, Row, Table
from server.evaluation.numbers import cells, compared, filled

TABLE = Table("t", "T", "", (Column("a", 1), Column("b", 0), Column("c")), ())


def test_every_column_has_a_cell_whatever_the_row_has():
    row = Row("r", (1.25, None), (0.2, None, 9592.0))
    assert cells(TABLE, row) == [("1.2", "0.2"), ("–", ""), ("–", "9,592")]
    assert filled((), TABLE) == (None, None, None)


def test_the_papers_digits_are_its_own():
    assert cells(TABLE, Row("r", (0.0, 0.0, 0.0), (0.1643, 0.0, 0.065))) == [
        ("0.0", "0.1643"),
        ("0", "0"),
        ("0.000", "0.065"),
    ]


def test_a_column_is_compared_where_any_row_has_a_number():
    rows = (Row("r", (1.0,)), Row("s", (1.0,), (None, 0.0)), Row("t", (1.0,), (None, None, None)))
    assert compared(replace(TABLE, rows=rows)) == [1]
    assert compared(TABLE) == []
