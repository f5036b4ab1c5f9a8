"""Who sees what in which order: balanced Latin squares (Williams 1949) and their alternatives."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from .config import StudyConfig


def latin_square(count: int) -> list[list[int]]:
    """Return rows in which every item stands once in every place and, over all rows, follows every other equally often.

    An even count needs `count` rows, an odd one the mirrored rows as well.
    """
    first = [0]
    for step in range(1, count):
        first.append((first[-1] + (step if step % 2 else -step)) % count)
    rows = [[(item + shift) % count for item in first] for shift in range(count)]
    return rows if count % 2 == 0 else rows + [row[::-1] for row in rows]


def trial_order(config: StudyConfig, number: int, seed: int) -> list[str]:
    """Return the adjectives of the emotions in the order for the `number`-th participant, from 0.

    The heads take turns first, so that every head meets every row of the square.
    """
    words = [emotion.adjective for emotion in config.emotions]
    if config.counterbalancing == "fixed":
        return words
    if config.counterbalancing == "random":
        draws = np.random.Generator(np.random.PCG64(seed)).random(len(words))
        return [words[i] for i in np.argsort(draws, kind="stable")]
    rows = latin_square(len(words))
    return [words[i] for i in rows[number // len(config.heads) % len(rows)]]


def identity_for(config: StudyConfig, number: int) -> str:
    """Return the head that the `number`-th participant sees, from 0."""
    return config.heads[number % len(config.heads)]
