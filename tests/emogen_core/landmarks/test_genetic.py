"""The published algorithm, against the paper written down literally: whole faces, one step at a time."""

import math

import numpy as np
import pytest

from emogen_core.landmarks.fitness import mean_cosine
from emogen_core.landmarks.genetic import CROSSOVERS, evolve

POINTS, EXAMPLES = 9, 12


def faces(seed):
    rng = np.random.default_rng(seed)
    return rng.normal(size=(EXAMPLES, POINTS, 3)), rng.normal(size=(POINTS, 3))


def cosine(v_a, v_b):
    return sum(a * b for a, b in zip(v_a, v_b, strict=True)) / (math.hypot(*v_a) * math.hypot(*v_b))


def literal(examples, target, crossover, rng):
    """Zhu & Lee 2006, figure 4 and the text below it; the draws are taken as `evolve` takes them."""
    ranks, ts = rng.random((70, len(examples))), rng.random(70)

    def fitness(face):
        return sum(cosine(point, wanted) for point, wanted in zip(face, target, strict=True)) / len(target)

    def length(face):
        return sum(math.hypot(*point) for point in face)

    def adjusted(face):
        factor = length(target) / length(face)
        return [[factor * number for number in point] for point in face]

    population = [example.tolist() for example in examples]
    best = max(population, key=fitness)
    for rank, t in zip(ranks, ts, strict=True):
        picked = sorted(range(len(examples)), key=lambda i: rank[i])[:3]
        worst = min(picked, key=lambda i: fitness(population[i]))
        p1, p2 = (population[i] for i in picked if i != worst)
        child = []
        for a, b in zip(p1, p2, strict=True):
            point = []
            for x, y in zip(a, b, strict=True):
                if crossover == "midpoint":
                    point.append(0.5 * x + 0.5 * y)
                elif crossover == "line":
                    point.append(t * x + (1 - t) * y)
                else:
                    delta = 0.2 * (y - x)
                    point.append(t * (x - delta) + (1 - t) * (y + delta))
            child.append(point)
        population[worst] = adjusted(child)
        if fitness(population[worst]) > fitness(best):
            best = population[worst]
    return np.array(adjusted(best))


@pytest.mark.parametrize("crossover", CROSSOVERS)
@pytest.mark.parametrize("seed", range(4))
def test_it_is_the_paper_step_by_step(crossover, seed):
    examples, target = faces(seed)
    weights = evolve(examples, target, crossover, np.random.default_rng(seed))
    found = np.tensordot(weights, examples, 1)
    assert np.allclose(found, literal(examples, target, crossover, np.random.default_rng(seed)), atol=1e-9)


@pytest.mark.parametrize("crossover", CROSSOVERS)
def test_the_points_move_as_far_in_total_as_in_the_input(crossover):
    examples, target = faces(9)
    found = np.tensordot(evolve(examples, target, crossover, np.random.default_rng(1)), examples, 1)
    assert np.linalg.norm(found, axis=1).sum() == pytest.approx(np.linalg.norm(target, axis=1).sum())


@pytest.mark.parametrize("crossover", CROSSOVERS)
def test_no_answer_is_worse_than_the_best_of_the_bank(crossover):
    for seed in range(20):
        examples, target = faces(seed)
        found = np.tensordot(evolve(examples, target, crossover, np.random.default_rng(seed)), examples, 1)
        assert mean_cosine(found, target) >= mean_cosine(examples, target).max() - 1e-12


def test_a_member_of_the_bank_is_found_at_any_strength():
    examples, _ = faces(2)
    weights = evolve(examples, 0.3 * examples[5], "line", np.random.default_rng(0))
    assert weights == pytest.approx(0.3 * np.eye(EXAMPLES)[5])


def test_the_same_draws_give_the_same_face():
    examples, target = faces(3)
    one, again, other = (evolve(examples, target, "blx", np.random.default_rng(seed)) for seed in (5, 5, 6))
    assert one.tolist() == again.tolist()
    assert one.tolist() != other.tolist()


def test_examples_that_do_not_move_give_no_face():
    weights = evolve(np.zeros((4, 2, 3)), np.ones((2, 3)), "line", np.random.default_rng(0))
    assert np.isfinite(weights).all()
