"""Files of tables: the types of the dictionary whatever the rows look like, and what is none is one sentence."""

import json
from datetime import UTC, datetime

import pyarrow as pa
import pytest
from pyarrow import parquet

from emogen_client import Export, IncompleteError, UnreadableError
from emogen_client.parsing import parsed

COLUMNS = (
    {"name": "face", "type": "text"},
    {"name": "parents", "type": "json"},
    {"name": "slot", "type": "integer"},
    {"name": "gene_jawOpen", "type": "number"},
    {"name": "elite", "type": "boolean"},
    {"name": "made_at", "type": "time"},
)
ROWS = [
    {
        "face": "01", "parents": [1, 2], "slot": 3, "gene_jawOpen": 1, "elite": True,
        "made_at": "2026-03-01T10:00:00.250Z",
    },
    dict.fromkeys(("face", "parents", "slot", "gene_jawOpen", "elite", "made_at")),
]  # fmt: skip
HEADER = ",".join(column["name"] for column in COLUMNS)
CSV = f'{HEADER}\n01,"[1, 2]",3,1,true,2026-03-01T10:00:00.250Z\n,,,,,\n'
FOUND = [
    {
        "face": "01", "parents": "[1, 2]", "slot": 3, "gene_jawOpen": 1.0, "elite": True,
        "made_at": datetime(2026, 3, 1, 10, 0, 0, 250_000, UTC),
    },
    ROWS[1],
]  # fmt: skip


def lines(rows):
    return "".join(f"{json.dumps(row)}\n" for row in rows).encode()


def test_every_format_gives_the_same_rows_and_types():
    as_lines = parsed("faces.jsonl", lines(ROWS), COLUMNS)
    assert as_lines.to_pylist() == FOUND
    assert parsed("faces.csv", CSV.encode(), COLUMNS).equals(as_lines)
    sink = pa.BufferOutputStream()
    parquet.write_table(as_lines, sink)
    assert parsed("faces.parquet", sink.getvalue().to_pybytes(), ()).equals(as_lines)


def test_no_rows_have_the_types_as_well():
    empty = parsed("faces.jsonl", b"", COLUMNS)
    assert empty.num_rows == 0
    assert empty.schema == parsed("faces.csv", f"{HEADER}\n".encode(), COLUMNS).schema


@pytest.mark.parametrize(
    ("path", "data", "named"),
    [
        ("faces.jsonl", lines([{**ROWS[0], "slot": 1e300}]), "slot"),
        ("faces.jsonl", lines([{**ROWS[0], "gene_jawOpen": "abc"}]), "gene_jawOpen"),
        ("faces.jsonl", lines([{**ROWS[0], "made_at": "yesterday"}]), "made_at"),
        ("faces.jsonl", lines([{"face": "01"}]), "parents"),
        ("faces.jsonl", b"{", "faces.jsonl"),
        ("faces.jsonl", b"3\n", "faces.jsonl"),
        ("faces.csv", CSV.replace(",3,1,", ",3,abc,").encode(), "gene_jawOpen"),
        ("faces.csv", CSV.replace(",3,1,", ",1e300,1,").encode(), "slot"),
        ("faces.csv", CSV.replace(",true,", ",true,5,").encode(), "faces.csv"),
        ("faces.parquet", b"PAR1", "faces.parquet"),
    ],
)
def test_what_is_no_such_table_is_one_sentence_with_file_and_column(path, data, named):
    with pytest.raises(UnreadableError) as error:
        parsed(path, data, COLUMNS)
    told = str(error.value)
    assert path in told
    assert named in told
    assert "\n" not in told


@pytest.mark.parametrize("text", ["{", "[]", "{}", '{"files": [3]}', '{"files": [{"rows": 1}]}'])
def test_what_is_no_manifest_is_no_export(tmp_path, text):
    (tmp_path / "manifest.json").write_text(text)
    with pytest.raises(IncompleteError, match=r"expected an export with a manifest.json"):
        Export(tmp_path)


@pytest.mark.parametrize("path", ["../other.csv", "/etc/passwd", "heads/../../x", "C:/x", "..\\x", ""])
def test_a_manifest_that_names_a_file_outside_of_the_export_is_refused(tmp_path, path):
    (tmp_path / "manifest.json").write_text(json.dumps({"files": [{"path": path, "bytes": 0, "sha256": ""}]}))
    with pytest.raises(UnreadableError, match=r"manifest.json: .* is no file of an export"):
        Export(tmp_path)
