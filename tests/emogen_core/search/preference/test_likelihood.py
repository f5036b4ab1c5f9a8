"""The choice model against its definition: all orders, one after the other."""

from __future__ import annotations

from itertools import permutations
from math import comb

import numpy as np
import pytest

from emogen_core.search import Choice
from emogen_core.search.preference.likelihood import LAPSE, arranged, likelihood
from tests.emogen_core.search.preference.beliefs import choice

WEIGHTS = np.random.default_rng(3).lognormal(0, 1.5, (30, 2))


def named_in_any_order(weights: np.ndarray, others: list[int], left: float) -> float:
    """Chance of these faces before all others, by summing Luce's rule over the orders."""
    total = 0.0
    for order in permutations(others):
        chance, waiting = 1.0, left + weights[others].sum()
        for face in order:
            chance *= weights[face] / waiting
            waiting -= weights[face]
        total += chance
    return total


def answered(weights: np.ndarray, told: Choice) -> float:
    elite, others = told.elite - 1, [slot - 1 for slot in told.others]
    left = weights.sum() - weights[elite] - weights[others].sum()
    first = (1 - LAPSE) * weights[elite] / weights.sum() + LAPSE / 10
    if len(others) in {0, 9}:
        return first
    return first * ((1 - LAPSE) * named_in_any_order(weights, others, left) + LAPSE / comb(9, len(others)))


def of(choices: list[Choice], weights: np.ndarray) -> np.ndarray:
    blocks = arranged(choices)
    filled = np.concatenate([weights, np.ones((1, weights.shape[1]))]).astype(np.float32)
    ranked = np.concatenate([filled[b.rows] * 2.0 ** np.clip(b.lift, -100, 100) for b in blocks])
    return likelihood(blocks, ranked.astype(np.float32))


@pytest.mark.parametrize("selected", [1, 2, 3, 5, 6, 7, 8, 10])
def test_an_answer_is_as_likely_as_all_its_orders_together(selected: int) -> None:
    told = choice(selected)
    wanted = [answered(column, told) for column in WEIGHTS[:10].T]
    np.testing.assert_allclose(of([told], WEIGHTS[:10]), wanted, rtol=5e-3)


def test_answers_with_different_counts_multiply() -> None:
    told = [choice(8, 1), choice(2, 2), choice(4, 3)]
    apart = [of([one], WEIGHTS[10 * i :][:10]) for i, one in enumerate(told)]
    np.testing.assert_allclose(of(told, WEIGHTS), np.prod(apart, axis=0), rtol=1e-5)


def test_all_answers_with_as_many_faces_have_chance_one_together() -> None:
    some = [Choice((elite, other), elite) for elite in range(1, 11) for other in range(1, 11) if other != elite]
    total = sum(of([one], WEIGHTS[:10])[0] for one in some)
    assert total == pytest.approx(1, abs=1e-5)


def test_a_face_nobody_would_name_costs_a_lapse_and_no_more() -> None:
    weights = np.full((10, 1), 2.0**90)
    weights[0] = 2.0**-90
    assert of([Choice((1,), 1)], weights)[0] == pytest.approx(LAPSE / 10)
