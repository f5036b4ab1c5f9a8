"""The export: every row, every column, one row in memory at a time."""

import csv
import io
import json

import pytest

from server.services.columns import TABLES
from server.services.export import guarded
from tests.conftest import BOTH, small_study
from tests.server.walker import Walker


@pytest.fixture
def recorded(client, house):
    study = house.studies.create(small_study())
    walker = Walker(client, study.links[0], PROLIFIC_PID="=1+1")
    final = walker.finish()
    assert final["step"] == "debrief"
    Walker(client, study.links[0]).finish(steps=4)
    return study


@pytest.fixture
def get(client, house, recorded):
    token = house.tokens.create("analysis", ["export"])

    def fetch(path="export", **params):
        address = f"/api/v1/studies/{recorded.id}/{path}"
        return client.get(address, params=params, headers={"Authorization": f"Bearer {token}"})

    return fetch


def rows(reply):
    assert reply.status_code == 200, reply.text
    return list(csv.DictReader(io.StringIO(reply.text)))


@BOTH
def test_counts_fit_together(get):
    tables = {table: rows(get(table=table, format="csv")) for table in TABLES}
    counts = {table: len(found) for table, found in tables.items()}
    # One whole participation: practice and two trials of three generations; one that stopped after two choices.
    assert (counts["participations"], counts["ratings"], counts["events"]) == (2, 4, 0)
    assert counts["generations"] == (1 + 2 * 3) + (1 + 2)
    assert counts["faces"] == counts["generations"] * 10
    assert counts["choices"] == sum(row["answered"] == "true" for row in tables["generations"])
    assert sum(row["elite"] == "true" for row in tables["faces"]) == counts["choices"]


def test_csv_and_json_lines_say_the_same(get):
    for table in TABLES:
        flat = rows(get(table=table, format="csv"))
        rich = [json.loads(line) for line in get(table=table, format="jsonl").text.splitlines()]
        assert len(flat) == len(rich)
        for one, other in zip(flat, rich, strict=True):
            assert set(one) == set(other)
            for name, value in other.items():
                if value is None:
                    assert one[name] == ""
                elif isinstance(value, float):
                    assert float(one[name]) == value


def test_faces_carry_genes_and_weights_exactly(get, house):
    import numpy as np

    from emogen_core.correctives.pipeline import face_weights

    rig = house.journal.rig
    for line in get(table="faces", format="jsonl").text.splitlines():
        row = json.loads(line)
        genes = np.array([[row[f"gene_{name}"] for name in rig.gene_names]])
        weights = [row[f"weight_{name}"] for name in rig.shape_names]
        assert face_weights(rig, row["identity"], genes).weights[0].tolist() == weights


def test_header_and_dictionary_agree(get, recorded):
    told = get("dictionary").json()
    assert told["study"] == recorded.id
    for table in TABLES:
        header = get(table=table, format="csv").text.splitlines()[0].split(",")
        assert header == [column["name"] for column in told["tables"][table]]


def test_an_empty_study_exports_headers(client, house):
    study = house.studies.create(small_study())
    assert next(house.exports.stream(study.id, "ratings", "csv")).startswith("study_id,")
    assert list(house.exports.stream(study.id, "ratings", "jsonl")) == []


def test_formulas_are_guarded(get):
    recruiter = [row["recruiter"] for row in rows(get(table="participations", format="csv"))]
    assert recruiter[0] == '{"PROLIFIC_PID": "=1+1"}'
    for text in ("=1+1", "+1", "-1", "@x", "\t=1", "\r=1"):
        assert guarded(text) == f"'{text}"
    assert guarded("a=1") == "a=1"


def test_wrong_names(get, client, house):
    assert get(table="secrets").json()["error"]["expected"].startswith("one of participations")
    assert get(table="faces", format="xlsx").status_code == 422
    token = house.tokens.create("analysis", ["export"])
    missing = client.get("/api/v1/studies/none/export", headers={"Authorization": f"Bearer {token}"})
    assert (missing.status_code, missing.json()["error"]["code"]) == (404, "not_found")


def test_rows_come_one_by_one(house, recorded):
    import tracemalloc

    lines = house.exports.stream(recorded.id, "faces", "csv")
    header = next(lines)
    assert header.count("\n") == 1
    tracemalloc.start()
    for line in lines:
        assert line.count("\n") <= 1
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert peak < 5_000_000
