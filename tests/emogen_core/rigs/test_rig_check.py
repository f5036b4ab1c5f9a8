"""What `emogen rig check` reports."""

from __future__ import annotations

import json
from dataclasses import replace

import pytest

from emogen_core.errors import InvalidInputError
from emogen_core.face.bundled import load_bundled_rig
from emogen_core.rigs.check import BARS, MEASURES, Bar, Sample, check_rig, head_report, verdicts
from emogen_core.rigs.check_table import check_text, table
from emogen_core.rigs.combination_check import combination_report
from emogen_core.rigs.random_faces import GENES_A_FACE, random_genes
from tests.rig_factory import small_rig

RIG = load_bundled_rig()


def without_times(report):
    for head in report["identities"].values():
        assert head["collisions"].pop("milliseconds")["wall"]["mean"] > 0
    report["bars"] = [bar for bar in report["bars"] if "milliseconds" not in bar["bar"]]
    return report


@pytest.fixture(scope="module")
def report():
    return check_rig(RIG, Sample(12, 3), ("male", "asian-female-young"))


def test_the_correctives_of_the_bundled_head_help_and_hardly_ever_harm():
    found = combination_report(RIG, "female", faces=120, seed=1)
    assert found["with"]["flips"] < found["without"]["flips"]
    assert found["with"]["stretched"] < found["without"]["stretched"]
    assert found["faces_worse"] <= 0.02 * 120
    assert found["with"]["flips"] < 3.2


def test_it_says_what_is_promised_for_every_head(report):
    assert report["counts"]["genes"] == len(RIG.genes)
    assert report["counts"]["shapes"] == len(RIG.shape_names)
    assert list(report["identities"]) == ["male", "asian-female-young"]
    for head in report["identities"].values():
        found = head["collisions"]
        assert set(found["collided"]) == {"lips", "teeth", "any"}
        for when in ("before", "after"):
            assert list(found[f"depth_{when}_mm"]) == ["mean", "median", "p90", "p99", "max"]
        assert found["depth_after_mm"]["max"] <= found["depth_before_mm"]["max"]
        assert found["over_half_mm_after"] <= found["over_half_mm_before"]
        assert found["untouched_identical"] is True
        assert found["neutral_collides"] is False
        assert found["milliseconds"]["processor"]["mean"] <= found["milliseconds"]["processor"]["p99"]
    assert [bar["bar"] for bar in report["bars"]] == [bar.name for bar in BARS]


def test_processes_of_their_own_find_the_same(report):
    told = []
    again = check_rig(RIG, Sample(12, 3), ("male", "asian-female-young"), workers=2, progress=told.append)
    assert told == ["male", "asian-female-young"]
    assert without_times(json.loads(json.dumps(again))) == without_times(json.loads(json.dumps(report)))


def test_the_text_names_every_head_and_bar(report):
    text = check_text(report)
    assert text.count("`male`") == text.count("`asian-female-young`") == len(MEASURES)
    assert all(bar.name in text for bar in BARS)


def test_a_bar_is_judged_by_its_worst_head_or_by_all_together():
    heads = {name: head_report(RIG, name, Sample(3, 0)) for name in ("female", "male")}
    heads["male"]["collisions"]["over_half_mm_after"] = 0.02
    heads["female"]["combinations"]["with"]["flips"] = 99.0
    heads["male"]["collisions"]["untouched_identical"] = False
    found = {bar["bar"]: bar for bar in verdicts(heads)}
    for name, worst in (
        ("share over 0.5 mm afterwards", "male"),
        ("flipped triangles fell by", "all heads"),
        ("faces without collision bit-identical", "male"),
    ):
        assert (found[name]["identity"], found[name]["met"]) == (worst, False)
    assert "MISSED" in check_text({**check_rig(RIG, Sample(1, 0), ("male",)), "bars": list(found.values())})


@pytest.mark.parametrize(("rule", "good", "bad"), [("at most", 1.0, 1.1), ("at least", 1.0, 0.9), ("is", True, False)])
def test_rules(rule, good, bad):
    bar = Bar("thing", ("a",), rule, 1.0)
    assert bar.met(good)
    assert not bar.met(bad)
    assert bar.worse(bad) > bar.worse(good)


def test_a_rig_without_lips_and_teeth_is_checked_for_the_rest():
    heads = check_rig(small_rig(), Sample(5, 3), ("female",))
    assert set(heads["identities"]["female"]) == {"combinations"}
    assert check_text(heads)


def test_columns_line_up():
    assert table(("a", "long"), [("1234", "b")]) == "| a    | long |\n| ---- | ---- |\n| 1234 | b    |"


def test_random_faces_leave_inactive_genes_alone():
    genes = random_genes(RIG, 50, 0)
    inactive = [bool(gene.flags & {"lateral", "disabled"}) for gene in RIG.genes]
    assert not genes[:, inactive].any()
    assert ((genes > 0).sum(1) == GENES_A_FACE).all()
    few = replace(small_rig(), genes=small_rig().genes[:2])
    assert ((random_genes(few, 3, 0) > 0).sum(1) == 2).all()


def test_bad_samples_and_heads_are_refused():
    with pytest.raises(InvalidInputError, match="at least 1, got 0"):
        check_rig(small_rig(), Sample(0))
    with pytest.raises(InvalidInputError, match=r"female.*male.*nobody"):
        check_rig(small_rig(), Sample(1), ("nobody",))
