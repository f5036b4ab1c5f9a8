"""Rows of a text file."""

import pytest

from emogen_core.errors import InvalidInputError
from emogen_core.landmarks.rows import read_rows


def test_rows_know_their_lines_and_their_fields():
    header, rows = read_rows("\ufeffName, dX\r\n8.3,1.5\r\n\r\n8.4,\r\n")
    assert header == ["Name", "dX"]
    assert [(row.line, row.fields) for row in rows] == [
        (2, {"name": "8.3", "dx": "1.5"}),
        (4, {"name": "8.4", "dx": ""}),
    ]
    assert rows[0].number("dx") == 1.5
    for column in ("dx", "dy"):
        with pytest.raises(InvalidInputError, match=f"line 4: expected a number for {column}, got ''"):
            rows[1].number(column)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("", "a line with the names of columns, got 'nothing'"),
        ("\n\n", "a line with the names of columns"),
        ("name,dx\n", "1 to 1000000 rows below the header, got 0"),
        ("name,dx,DX\n8.3,1,1\n", "line 1: expected every column once"),
        ("name,dx\n8.3,1,2\n", "line 2: expected 2 values, got 3"),
        ('name,dx\n"8.3,1\x00' + "x" * 200_000, "line 2: expected values separated by commas"),
    ],
)
def test_what_is_no_table_is_refused(text, said):
    with pytest.raises(InvalidInputError, match=said):
        read_rows(text)
