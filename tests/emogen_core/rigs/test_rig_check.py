"""What `emogen rig check` reports."""

from __future__ import annotations

import json

import pytest

from emogen_core.errors import InvalidInputError
from emogen_core.face.bundled import load_bundled_rig
from emogen_core.rigs.check import GENES_A_FACE, check_rig, random_genes
from tests.rig_factory import small_rig


def test_the_correctives_of_the_bundled_head_help_and_hardly_ever_harm():
    report = check_rig(load_bundled_rig(), faces=120, seed=1)
    assert report["with_combinations"]["flips"] < report["without_combinations"]["flips"]
    assert report["with_combinations"]["stretched"] < report["without_combinations"]["stretched"]
    assert report["faces_worse"] <= 0.02 * report["faces"]
    assert report["with_combinations"]["flips"] < 3.2


def test_the_report_is_json_and_repeats_but_for_the_time():
    reports = [check_rig(small_rig(), faces=5, seed=3) for _ in range(2)]
    for report in reports:
        assert report.pop("milliseconds_a_face") > 0
    assert json.loads(json.dumps(reports[0])) == reports[1]


def test_random_faces_leave_inactive_genes_alone():
    rig = load_bundled_rig()
    genes = random_genes(rig, 50, 0)
    inactive = [bool(gene.flags & {"lateral", "disabled"}) for gene in rig.genes]
    assert not genes[:, inactive].any()
    assert ((genes > 0).sum(1) == GENES_A_FACE).all()


def test_no_faces_are_refused():
    with pytest.raises(InvalidInputError, match="at least 1"):
        check_rig(small_rig(), faces=0)
