"""Rows of a text file with a header line, and the numbers in them; every complaint names the line."""

from __future__ import annotations

import csv
from dataclasses import dataclass

from emogen_core.errors import InvalidInputError, expected

MOST_ROWS = 1_000_000


@dataclass(frozen=True, slots=True)
class Row:
    """One line of a file: its number, and its fields by the names of the columns, in lower case."""

    line: int
    fields: dict[str, str]

    def number(self, column: str) -> float:
        """Return the number in a column.

        Raises:
            InvalidInputError: there is none.
        """
        text = self.fields.get(column, "")
        try:
            return float(text)
        except ValueError:
            raise InvalidInputError(f"line {self.line}: {expected(f'a number for {column}', text)}") from None


def read_rows(text: str) -> tuple[list[str], list[Row]]:
    """Return the names of the columns, as written, and the rows of a CSV file with commas.

    Raises:
        InvalidInputError: no header, no rows, a column twice, or a row with more fields than the header.
    """
    lines = csv.reader(text.removeprefix("\ufeff").splitlines())
    try:
        header = [name.strip() for name in next(lines, [])]
        rows = [Row(lines.line_num, _fields(header, row, lines.line_num)) for row in lines if any(row)]
    except csv.Error as error:
        raise InvalidInputError(
            f"line {lines.line_num}: {expected('values separated by commas', str(error))}"
        ) from None
    if not any(header):
        raise InvalidInputError(f"file: {expected('a line with the names of columns', 'nothing')}")
    names = [name.lower() for name in header]
    if len(set(names)) < len(names):
        raise InvalidInputError(f"line 1: {expected('every column once', header)}")
    if not rows or len(rows) > MOST_ROWS:
        raise InvalidInputError(f"file: {expected(f'1 to {MOST_ROWS} rows below the header', len(rows))}")
    return header, rows


def _fields(header: list[str], row: list[str], line: int) -> dict[str, str]:
    if len(row) > len(header):
        raise InvalidInputError(f"line {line}: {expected(f'{len(header)} values', len(row))}")
    return {name.lower(): value.strip() for name, value in zip(header, row, strict=False)}
