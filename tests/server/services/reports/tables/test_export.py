"""The export: every row and every column, the same in every format."""

import csv
import io
import json
import re

import numpy as np
import pyarrow as pa
import pytest
from pyarrow import parquet

from server.services.reports.tables.columns import TABLES
from server.services.spreadsheet import guarded
from tests.conftest import BOTH, small_study
from tests.server.exported import lines, text
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


@pytest.fixture
def learned(client, house):
    """A study whose search weighs all answers."""
    study = house.studies.create(small_study(search={"strategy": "preference", "activation": (2, 3)}))
    Walker(client, study.links[0]).finish()
    Walker(client, study.links[0]).finish(steps=4)
    return study


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


@pytest.mark.parametrize("table", ["faces", "estimates"])
def test_faces_carry_genes_and_weights_exactly(house, learned, table):
    from emogen_core.correctives.pipeline import face_weights

    rig, found = house.journal.rig, lines(house, learned.id, table)
    assert found
    for row in found:
        genes = np.array([[row[f"gene_{name}"] for name in rig.gene_names]])
        weights = [row[f"weight_{name}"] for name in rig.shape_names]
        assert face_weights(rig, row["identity"], genes).weights[0].tolist() == weights


def test_header_and_dictionary_agree(get, recorded):
    told = get("dictionary").json()
    assert told["study"] == recorded.id
    for table in TABLES:
        header = get(table=table, format="csv").text.splitlines()[0].split(",")
        assert header == [column["name"] for column in told["tables"][table]["columns"]]


def test_an_empty_study_exports_headers(client, house):
    study = house.studies.create(small_study())
    assert text(house, study.id, "ratings", "csv").splitlines() == [",".join(c.name for c in TABLES["ratings"].columns)]
    assert lines(house, study.id, "ratings") == []


@BOTH
def test_every_finished_trial_of_a_search_that_weighs_all_answers_has_an_estimate(house, learned):
    trials = {row["trial"]: row for row in lines(house, learned.id, "trials") if row["final_face"]}
    rows = lines(house, learned.id, "estimates")
    assert [row["trial"] for row in rows] == list(trials)
    assert len(rows) == 3 + 1, "practice counts; who left had finished it alone"
    for row in rows:
        trial = trials[row["trial"]]
        assert (row["attempt"], row["generation"]) == (trial["attempts"], trial["generations"])
        assert row["identity"] == trial["identity"]


def test_formulas_are_guarded(get):
    recruiter = [row["recruiter"] for row in rows(get(table="participations", format="csv"))]
    assert recruiter[0] == '{"PROLIFIC_PID": "=1+1"}'
    for formula in ("=1+1", "+1", "-1", "@x", "\t=1", "\r=1"):
        assert guarded(formula) == f"'{formula}"
    assert guarded("a=1") == "a=1"


def test_wrong_names(get, client, house):
    assert get(table="secrets").json()["error"]["expected"].startswith("one of participations")
    assert get(table="faces", format="xlsx").status_code == 422
    token = house.tokens.create("analysis", ["export"])
    missing = client.get("/api/v1/studies/none/export", headers={"Authorization": f"Bearer {token}"})
    assert (missing.status_code, missing.json()["error"]["code"]) == (404, "not_found")


def value(column, kind):
    if pa.types.is_timestamp(kind):
        return column.isoformat(timespec="milliseconds")
    return column


@pytest.mark.parametrize("table", TABLES)
def test_parquet_says_the_same_as_json_lines(house, recorded, learned, table):
    recorded = learned if table == "estimates" else recorded
    data = b"".join(house.exports.table(recorded.id, table, "parquet").chunks)
    found = parquet.read_table(io.BytesIO(data))
    kinds = dict(zip(found.schema.names, found.schema.types, strict=True))
    rich = lines(house, recorded.id, table)
    assert found.num_rows == len(rich)
    nested = {column.name for column in TABLES[table].columns if column.type == "json"}
    for one, other in zip(found.to_pylist(), rich, strict=True):
        for name, told in other.items():
            got = one[name]
            if told is None:
                assert got is None
            elif name in nested:
                assert json.loads(got) == told
            else:
                assert (value(got, kinds[name]) if got is not None else None) == told
    weights = [kind for name, kind in kinds.items() if name.startswith("weight_")]
    assert set(weights) <= {pa.float32()}


@pytest.mark.parametrize("study", ["recorded", "learned"])
def test_every_value_is_one_that_the_dictionary_allows(house, request, study):
    recorded = request.getfixturevalue(study)
    for table in TABLES.values():
        rows = lines(house, recorded.id, table.name)
        for column in (one for one in table.columns if one.type != "json" and not one.family):
            for found in {row[column.name] for row in rows} - {None}:
                if column.type == "text" and column.allowed:
                    assert any(re.fullmatch(re.sub("[A-Z]+", ".+", one), found) for one in column.allowed), column.name
                if column.least is not None:
                    assert column.least <= found <= (found if column.most is None else column.most)


def test_the_key_tells_rows_apart(house, recorded, learned):
    for table in TABLES.values():
        rows = [*lines(house, recorded.id, table.name), *lines(house, learned.id, table.name)]
        keys = [tuple(row[name] for name in table.key) for row in rows]
        assert len(set(keys)) == len(keys)
