"""What the paper does not have."""

import pytest

from emogen_core.simulation.evaluation.beyond import SETTINGS, TARGETS, _on_even, _on_settings
from emogen_core.simulation.evaluation.evaluate import evaluate
from emogen_core.simulation.evaluation.results import Spread
from emogen_core.simulation.evaluation.threshold import threshold
from tests.emogen_core.simulation.evaluation.laboratories import real_laboratory

RISING = ("never errs", "noise .05", "noise .1", "noise .2", "chooses at random")


def numbers(table):
    names = [column.name for column in table.columns]
    return {row.label: dict(zip(names, row.ours, strict=True)) for row in table.rows}


def test_settings_are_better_or_worse_by_more_than_chance_only():
    noisy = {label: Spread(0.37, 0.08, 0, 500) for label, _ in SETTINGS}
    noisy |= {"generations 20": Spread(0.33, 0.08, 0, 500), "generations 5": Spread(0.42, 0.08, 0, 500)}
    noisy["m = 4 mutations"] = Spread(0.365, 0.08, 0, 500)
    told = _on_settings(noisy)
    assert "better by more than chance are generations 20 (0.33); worse are generations 5 (0.42)." in told
    alike = _on_settings(dict.fromkeys(noisy, Spread(0.37, 0.08, 0, 500)))
    assert "better by more than chance are none; worse are none." in alike


def test_even_targets_are_named():
    assert _on_even([]) == ""
    assert "mean happy is so even" in _on_even(["mean happy"])


def test_the_noise_to_cite_is_that_of_the_command():
    laboratory = real_laboratory()
    (table,) = evaluate(laboratory, ["threshold"], 10)
    found = threshold(laboratory)
    told = numbers(table)
    assert told["never errs, to the face in mind"]["mean"] == found.faithful.error.mean
    assert told["noise .1, two results"]["95th percentile"] == found.noisy.apart.most
    assert told["no answer, to the face in mind"]["mean"] == found.no_answer
    assert str(found.faithful.error) in table.verdict


def test_people_who_err_end_further_away_on_the_bundled_rig():
    (table,) = evaluate(real_laboratory(), ["observers"], 100)
    told = numbers(table)
    for name in TARGETS:
        means = [
            told[label][name] for label in ("never errs", "noise .05", "noise .1", "noise .2", "chooses at random")
        ]
        assert means == sorted(means), name
    assert told["never errs"]["best is nearest %"] == pytest.approx(100)
    assert told["chooses at random"]["best is nearest %"] < 30
    assert told["no answer"]["sd of people"] is None


def test_collision_correctives_change_results_little_on_the_bundled_rig():
    (table,) = evaluate(real_laboratory(), ["collisions"], 60)
    for row in numbers(table).values():
        assert abs(row["mean with"] - row["mean without"]) < 0.01
    assert any(row["largest shift, mm"] > 0 for row in numbers(table).values())
