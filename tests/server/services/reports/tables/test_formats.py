"""Every writer writes the values it is given: numbers bit for bit, texts letter for letter, nothing as nothing."""

import csv
import io
import json
from datetime import UTC, datetime

import numpy as np
import pyarrow as pa
import pytest

from emogen_client.parsing import parsed
from server.services.reports.tables.formats import LONG_RUN, writer
from server.services.spreadsheet import guarded

MOMENT = datetime(2026, 3, 22, 14, 7, 31, 250000, tzinfo=UTC)
COLUMNS = {
    "text": pa.array(['say "so"', "a,b}\n{", "Ärger", "", None], pa.string()),
    "double": pa.array([0.1, -0.0, 1e-300, 12.0, None], pa.float64()),
    "whole": pa.array([2**53 + 1, -1, 0, 7, None], pa.int64()),
    "single": pa.array([0.1, 0.0, 1.0, 1e-30, None], pa.float32()),
    "truth": pa.array([True, False, True, False, None], pa.bool_()),
    "moment": pa.array([MOMENT] * 4 + [None], pa.timestamp("ms", "UTC")),
    "list": pa.array(["[1, 2]", '["a,"]', "{}", "3", None], pa.string()),
}


def batch_of(*names):
    fields = [pa.field(name, COLUMNS[name].type, metadata={"type": "json"} if name == "list" else {}) for name in names]
    return pa.record_batch([COLUMNS[name] for name in names], schema=pa.schema(fields))


def as_json(name, value):
    if name == "list":
        return None if value is None else json.loads(value)
    return value.isoformat(timespec="milliseconds") if isinstance(value, datetime) else value


@pytest.mark.parametrize("first", range(len(COLUMNS)))
def test_json_lines_say_every_value_wherever_its_column_stands(first):
    names = [*COLUMNS][first:] + [*COLUMNS][:first]
    batch = batch_of(*names)
    body = writer("jsonl", batch.schema).rows(batch.slice(1, 4)).decode()
    expected = [{name: as_json(name, row[name]) for name in names} for row in batch.to_pylist()[1:]]
    assert [json.loads(line) for line in body.splitlines()] == expected
    assert body.endswith("}\n")


@pytest.mark.parametrize("names", [["text"], ["double"], ["double", "single"], ["text", "whole"]])
def test_json_lines_need_no_company(names):
    batch = batch_of(*names)
    body = writer("jsonl", batch.schema).rows(batch).decode()
    assert [json.loads(line) for line in body.splitlines()] == batch.to_pylist()


RISKY = ["=1+1", "+1", "-1", "@x", "\t=1", "\r=1", "\n1", "\uff1d1", "\uff0b1", "\uff0d1", "\uff201", "'=1", "''+1"]
TOLD = [{"name": "cell", "type": "text"}, {"name": "row", "type": "integer"}]
HARMLESS = ["a=1", " =1", "'tis", "'", "", None, "\u202e=1"]


def as_csv(texts):
    batch = pa.record_batch([pa.array(texts), pa.array(range(len(texts)))], names=["cell", "row"])
    told = writer("csv", batch.schema)
    return told.begin() + told.rows(batch)


def test_what_is_guarded_in_a_table_is_what_the_guard_guards():
    read = csv.reader(io.StringIO(as_csv(RISKY + HARMLESS).decode(), newline=""))
    cells = [row[0] for row in read][1:]
    assert cells == [guarded(one) if one else "" for one in RISKY + HARMLESS]
    assert cells == [f"'{one}" for one in RISKY] + [one or "" for one in HARMLESS]


def test_whoever_reads_a_guarded_table_finds_the_text_as_it_was():
    table = parsed("cells.csv", as_csv(RISKY + HARMLESS), TOLD)
    assert table["cell"].to_pylist() == RISKY + HARMLESS


def test_numbers_read_back_bit_for_bit():
    random = np.random.default_rng(7)
    doubles = np.concatenate([random.random(2000), 10.0 ** random.uniform(-300, 300, 500), [0.0, -0.0, 1.0]])
    singles = doubles[:2000].astype(np.float32)
    batch = pa.record_batch([pa.array(doubles[:2000]), pa.array(singles)], names=["double", "single"])
    schema = batch.schema
    plain = csv.reader(io.StringIO(writer("csv", schema).rows(batch).decode()))
    rich = map(json.loads, writer("jsonl", schema).rows(batch).splitlines())
    for (one, two), row, double, single in zip(plain, rich, doubles, singles, strict=False):
        assert float(one).hex() == float(row["double"]).hex() == float(double).hex()
        assert float(two).hex() == float(row["single"]).hex() == float(single).hex()


@pytest.mark.parametrize("text", ["plain", "=1+1", 'with "quotes", and\nlines', "\x01", '"\x01"', ""])
def test_csv_says_every_number_of_a_long_run_and_nothing_where_there_is_none(text):
    random = np.random.default_rng(3)
    table = random.normal(size=(7, LONG_RUN)) * 10.0 ** random.integers(-12, 12, (7, LONG_RUN))
    table[random.random(table.shape) < 0.5] = 0
    table[0, :3] = (10.0, -200.0, 1e22)
    table[1, 4], table[6, -1], table[3, 0] = np.nan, np.nan, np.nan
    columns = {
        "text": pa.array([text] * 7, pa.string()),
        **{f"n{place}": pa.array(column, from_pandas=True) for place, column in enumerate(table.T)},
        "flag": pa.array([True, None] * 3 + [False]),
    }
    batch = pa.record_batch(columns)
    made = writer("csv", batch.schema)
    rows = list(csv.reader(io.StringIO((made.begin() + made.rows(batch) + made.end()).decode(), newline="")))
    assert rows[0] == [*columns]
    assert [row[0] for row in rows[1:]] == [guarded(text)] * 7
    assert [row[-1] for row in rows[1:]] == ["true", "", "true", "", "true", "", "false"]
    for row, numbers in zip(rows[1:], table, strict=True):
        assert [cell == "" for cell in row[1:-1]] == np.isnan(numbers).tolist()
        assert [float(cell or "nan") for cell in row[1:-1]] == pytest.approx(numbers, rel=0, abs=0, nan_ok=True)
