"""What is found, judged by its numbers: every finding can hold and can fail."""

import pytest

from emogen_core.simulation.evaluation.convergence import PLAIN, _on_activation, _on_noise, _why_noise
from emogen_core.simulation.evaluation.evaluate import evaluate
from emogen_core.simulation.evaluation.results import Spread, averaged
from tests.emogen_core.simulation.evaluation.laboratories import real_laboratory

PAPER = {"target 1": (0.43, 0.16), "target 3": (0.27, 0.10), "target 2": (0.24, 0.08), "mean happy": (0.22, 0.06)}


def spreads(means, sds=0.1):
    sds = [sds] * len(means) if isinstance(sds, float) else sds
    return [Spread(mean, sd, mean + sd, 500) for mean, sd in zip(means, sds, strict=True)]


def noise(**changed):
    last = {name: Spread(*PAPER[name], 0, 500) for name in PLAIN}
    last |= {name.replace("_", " "): Spread(mean, 0.06, 0, 500) for name, mean in changed.items()}
    return [one.holds for one in _on_noise(last, averaged([last["target 2"], last["mean happy"]]))]


@pytest.mark.parametrize(
    ("changed", "holds"),
    [
        ({}, [True, True, True]),
        ({"target_1": 0.26}, [False, True, True]),
        ({"target_2": 0.27}, [False, True, True]),
        ({"mean_happy": 0.30}, [True, False, True]),
        ({"target_2": 0.1, "mean_happy": 0.1}, [True, True, False]),
        ({"target_3": 0.4, "target_2": 0.35, "mean_happy": 0.35}, [True, True, False]),
    ],
)
def test_noise_falls_with_complexity_and_is_near_the_papers(changed, holds):
    assert noise(**changed) == holds


def test_a_target_that_needs_no_answer_is_named():
    last = {name: Spread(0.3, 0.1, 0, 500) for name in PLAIN}
    assert "mean happy lies nearer" in _why_noise(last, {**dict.fromkeys(PLAIN, 0.5), "mean happy": 0.1})
    assert "every target" in _why_noise(last, dict.fromkeys(PLAIN, 0.5))


FIRST, LAST = [0.75, 0.74, 0.70, 0.56, 0.53, 0.50], [0.36, 0.43, 0.44, 0.22, 0.23, 0.27]


@pytest.mark.parametrize(
    ("first", "last", "sds", "holds"),
    [
        (FIRST, LAST, [0.2, 0.16, 0.13] * 2, [True, True, True, True]),
        (FIRST[::-1], LAST, [0.2, 0.16, 0.13] * 2, [False, True, True, True]),
        (FIRST, [0.44, 0.43, 0.36, 0.22, 0.23, 0.27], [0.2, 0.16, 0.13] * 2, [True, False, True, True]),
        (FIRST, [0.36, 0.43, 0.44, 0.27, 0.23, 0.22], [0.2, 0.16, 0.13] * 2, [True, True, False, True]),
        (FIRST, LAST, [0.13, 0.16, 0.2] * 2, [True, True, True, False]),
        ([0.75, 0.74, 0.7, 0.5, 0.5, 0.5], LAST, [0.2, 0.16, 0.13] * 2, [False, True, True, True]),
    ],
)
def test_activation(first, last, sds, holds):
    found = _on_activation(spreads(first), spreads(last, sds))
    assert [one.holds for one in found] == holds


def test_the_search_on_the_bundled_rig_is_as_near_as_the_papers():
    (table,) = evaluate(real_laboratory(), ["noise"], 200)
    assert table.agreement == "agrees"
    (pressure,) = evaluate(real_laboratory(), ["pressure"], 200)
    assert pressure.agreement == "agrees"
