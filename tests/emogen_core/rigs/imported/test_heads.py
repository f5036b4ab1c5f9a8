"""Heads of identity modes: linear, bounded, and centred between the eyes."""

import numpy as np
import pytest

from emogen_core.errors import InvalidInputError
from emogen_core.rigs.imported.heads import PLAUSIBLE, mixed_head, parse_head, random_weights

NEUTRAL = np.arange(12, dtype=np.float32).reshape(4, 3)
MODES = {"wide": np.ones((4, 3), np.float32), "long": np.eye(4, 3, dtype=np.float32)}
NO_EYES = np.zeros(0, np.intp)


def test_modes_add_up():
    head = mixed_head(NEUTRAL, MODES, {"wide": 0.5, "long": -2}, NO_EYES)
    assert head == pytest.approx(NEUTRAL + 0.5 * MODES["wide"] - 2 * MODES["long"])
    assert mixed_head(NEUTRAL, MODES, {}, NO_EYES) == pytest.approx(NEUTRAL)


def test_the_origin_stays_between_the_eyes():
    head = mixed_head(NEUTRAL, MODES, {"wide": 1, "long": 1}, np.array([0, 1]))
    assert head[:2].mean(0) == pytest.approx(NEUTRAL[:2].mean(0))


@pytest.mark.parametrize(
    ("weights", "why"),
    [({"tall": 1.0}, "expected modes among"), ({"wide": PLAUSIBLE + 0.1}, "wide: expected a number in"),
     ({"wide": float("nan")}, "wide: expected a number in")],
)  # fmt: skip
def test_implausible_heads_are_refused(weights, why):
    with pytest.raises(InvalidInputError, match=why):
        mixed_head(NEUTRAL, MODES, weights, NO_EYES)


def test_random_heads_are_plausible_and_repeat():
    modes = dict.fromkeys(map(str, range(500)))
    weights = random_weights(modes, np.random.default_rng(1))
    values = np.array([*weights.values()])
    assert np.abs(values).max() <= PLAUSIBLE
    assert values.std() == pytest.approx(0.88, abs=0.06)
    assert weights == random_weights(modes, np.random.default_rng(1))
    assert weights != random_weights(modes, np.random.default_rng(2))


def test_a_head_in_words():
    assert parse_head("anna=wide:1.5,long:-0.5") == ("anna", {"wide": 1.5, "long": -0.5})


@pytest.mark.parametrize("text", ["anna", "=wide:1", "anna=wide", "anna=wide:x", "anna=", "anna=wide:1:2"])
def test_other_words_are_refused(text):
    with pytest.raises(InvalidInputError, match="head: expected NAME=MODE:WEIGHT"):
        parse_head(text)
