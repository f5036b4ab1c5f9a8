"""Configurations of an export: each person's own, and what is wrong with one; columns as numbers."""

import math

import numpy as np
import pyarrow as pa
import pytest

from server.services.errors import InvalidError
from server.services.participation.recorded_export import RecordedExport, matrix
from tests.conftest import small_study

STUDY = small_study(
    conditions=[{"name": "plain", "changes": {}}, {"name": "longer", "changes": {"generations": 5}}], generations=3
)


class Given:
    """An export that has nothing but configurations; counts how often it is asked."""

    def __init__(self, *versions):
        self.versions = versions
        self.asked = 0

    def configurations(self):
        self.asked += 1
        return [{"config_hash": named, "config": config} for named, config in self.versions]


def recorded(study, named=None):
    return RecordedExport(Given((named or study.hash(), study.model_dump(mode="json"))))


def row(study, condition="plain", **changes):
    return {"participation": "p1", "config_hash": study.hash(), "condition": condition, **changes}


def test_everybody_has_the_study_of_their_condition_and_it_is_read_once():
    record = recorded(STUDY)
    assert record.grouped
    assert record.own(row(STUDY)) == STUDY.in_condition("plain")
    assert record.own(row(STUDY, "longer")).generations == 5
    assert record.own(row(STUDY, "longer")) is record.own(row(STUDY, "longer"))
    assert record.export.asked == 1


def test_without_conditions_the_column_does_not_matter():
    study = small_study()
    record = recorded(study)
    assert not record.grouped
    assert record.own(row(study, "female")) == study == record.own(row(study, None))


@pytest.mark.parametrize(
    ("record", "asked", "what", "got"),
    [
        (recorded(STUDY), row(STUDY, config_hash="0" * 64), "config_hash", "0" * 64),
        (recorded(STUDY, "0" * 64), row(STUDY, config_hash="0" * 64), "configuration", STUDY.hash()),
        (recorded(STUDY), row(STUDY, "alone"), "condition", "alone"),
    ],
)
def test_another_configuration_is_named_and_nobody_has_it(record, asked, what, got):
    wrong = record.wrong(asked)
    assert (wrong.what, wrong.got) == (what, got)
    with pytest.raises(InvalidError, match=f"p1: {what}: expected .*, got {got}") as error:
        record.own(asked)
    assert error.value.field == what


def test_what_is_no_configuration_is_told():
    with pytest.raises(InvalidError, match="configuration of the export is none"):
        RecordedExport(Given(("a", {"title": 3}))).own(row(small_study()))


def test_columns_are_a_matrix_in_the_order_of_names_and_gaps_are_nan():
    table = pa.table({"gene_b": pa.array([1, None], pa.float32()), "gene_a": [0.1, 0.2], "weight_a": [7.0, 8.0]})
    found = matrix(table, "gene_", ("a", "b", "none"))
    assert np.array_equal(found[:, 0], [0.1, 0.2])
    assert found[0, 1] == 1 and math.isnan(found[1, 1]) and np.isnan(found[:, 2]).all()
