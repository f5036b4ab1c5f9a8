"""Slow, literal answers to compare with, and random shapes to ask about."""

from __future__ import annotations

from itertools import chain, combinations, product

import numpy as np

from emogen_core.transfer.packing.template import Template


def random_template(seed, pairs=3, singles=4, vertices=9):
    """Shapes that move random vertices of a random mirror-symmetric head by random amounts; pairs are (0, 1), ..."""
    rng = np.random.default_rng(seed)
    left = rng.uniform((5, -60, 0), (60, 60, 40), (vertices, 3))
    neutral = np.concatenate([left, left * [-1, 1, 1]])
    offsets = []
    for _ in range(pairs):
        # Mostly on one side, as what has a mirror image is.
        one = np.zeros_like(neutral)
        where = rng.choice(vertices, rng.integers(2, 5), replace=False)
        one[where] = rng.normal(size=(len(where), 3)) * rng.uniform(0.5, 4)
        if rng.random() < 0.5:
            one[vertices + where[0]] = one[where[0]] * rng.uniform(0.5, 1)
        # Not quite as strong, for what is equally important is in no order.
        offsets += [one, np.roll(one, vertices, axis=0) * [-0.93, 0.93, 0.93]]
    for _ in range(singles):
        one = np.zeros_like(neutral)
        where = rng.choice(vertices, rng.integers(1, 5), replace=False)
        one[where] = rng.normal(size=(len(where), 3)) * rng.uniform(0.5, 4)
        offsets.append((one + np.roll(one, vertices, axis=0) * [-1, 1, 1]) / 2)
    return Template(
        names=tuple(f"s{k}" for k in range(2 * pairs + singles)),
        neutral=neutral,
        offsets=np.array(offsets),
        triangles=rng.integers(0, 2 * vertices, (20, 3)),
    )


def subsets(items):
    items = list(items)
    return chain.from_iterable(combinations(items, count) for count in range(1, len(items) + 1))


def fits(active, pairs, chosen):
    """Whether eqs. 3b and 3d hold for a set of shapes; of a pair's common vertices the second shape has none."""
    counted = active.copy()
    for first, second in pairs:
        counted[second] &= ~counted[first]
    together = all((a in chosen) == (b in chosen) for a, b in pairs)
    return together and bool((counted[list(chosen)].sum(0) <= 1).all())


def algorithm_1(active, pairs, importance):
    """The paper's procedure, trying every set of shapes: shapes of each expression, and its objective."""
    left, shown, made = set(range(len(active))), [], []
    while left:
        values = importance(sorted(left), list(shown))
        best = max(
            (chosen for chosen in subsets(left) if fits(active, pairs, chosen)), key=lambda c: values[list(c)].sum()
        )
        made.append((set(best), float(values[list(best)].sum())))
        left -= set(best)
        shown += best
    return made


def chromatic_number(apart):
    """The least number of colours of a graph, by trying all of them."""
    edges = np.argwhere(np.triu(apart))
    for count in range(1, len(apart) + 1):
        for colours in product(range(count), repeat=len(apart)):
            if all(colours[a] != colours[b] for a, b in edges):
                return count
    return 0


def random_rows(seed, units=7, rows=9):
    """Rows in which a few of the units stand."""
    return np.random.default_rng(seed).random((rows, units)) < 0.33
