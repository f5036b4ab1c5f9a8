"""The benchmark tells what it promises."""

import json

import pytest

from emogen_core.errors import InvalidInputError
from emogen_core.rendering.bench import STEPS, bench_render


@pytest.mark.gl
def test_the_report_is_complete_and_can_be_printed():
    report = bench_render(faces=2, size=96, rounds=2, workers=1)
    assert json.loads(json.dumps(report)) == report
    assert set(report["step_core_ms"]) == {*STEPS, "sum"}
    assert report["step_core_ms"]["sum"] == pytest.approx(sum(report["step_core_ms"][s] for s in STEPS), abs=0.05)
    times = report["pool_ms"]
    assert 0 < times["min"] <= times["median"] <= times["max"]
    assert report["png_bytes"] > 1000


@pytest.mark.parametrize("argument", ["faces", "size", "rounds", "workers"])
def test_nothing_to_measure_is_refused(argument):
    with pytest.raises(InvalidInputError, match="positive"):
        bench_render(**{argument: 0})
