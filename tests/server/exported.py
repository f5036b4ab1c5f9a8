"""What an export says, row by row, for tests that look at the data."""

import json


def lines(house, study, table):
    """The rows of a table."""
    return [json.loads(line) for line in text(house, study, table).splitlines()]


def text(house, study, table, form="jsonl"):
    """A table as a text."""
    return b"".join(house.exports.table(study, table, form).chunks).decode()
