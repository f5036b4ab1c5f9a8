"""The benchmark tells what it promises."""

import json

import pytest

from emogen_core.correctives.pipeline import face_weights
from emogen_core.errors import InvalidInputError
from emogen_core.rendering.bench import STEPS, bench_render


def corrected(rig, identity, genes):
    return face_weights(rig, identity, genes).weights


@pytest.mark.gl
def test_the_report_is_complete_and_can_be_printed():
    report = bench_render(corrected, faces=2, size=96, rounds=2, workers=1, identity="male")
    assert json.loads(json.dumps(report)) == report
    assert set(report["step_core_ms"]) == {*STEPS, "sum"}
    assert all(report["step_core_ms"][step] >= 0 for step in STEPS)
    assert report["step_core_ms"]["draw"] > 0
    assert report["step_core_ms"]["sum"] == pytest.approx(sum(report["step_core_ms"][s] for s in STEPS), abs=0.05)
    times = report["pool_ms"]
    assert 0 < times["min"] <= times["median"] <= times["p95"] <= times["max"]
    assert report["png_bytes"] > 1000
    assert report["identity"] == "male"
    assert set(report["load"]) == set(report["yardstick_ms"]) == {"before", "after"}
    assert min(report["yardstick_ms"].values()) > 0


@pytest.mark.parametrize("argument", ["faces", "size", "rounds", "workers"])
def test_nothing_to_measure_is_refused(argument):
    with pytest.raises(InvalidInputError, match="positive"):
        bench_render(corrected, **{argument: 0})


def test_an_unknown_head_is_refused():
    with pytest.raises(InvalidInputError, match="nobody"):
        bench_render(corrected, identity="nobody")
