"""Who sees what in which order: balanced Latin squares (Williams 1949) and their alternatives."""

from __future__ import annotations

from typing import TYPE_CHECKING, TypeVar

import numpy as np

from ..config import Evolve

if TYPE_CHECKING:
    from collections.abc import Sequence

    from ..config import StudyConfig

Item = TypeVar("Item")


def latin_square(count: int) -> list[list[int]]:
    """Return rows in which every item stands once in every place and, over all rows, follows every other equally often.

    An even count needs `count` rows, an odd one the mirrored rows as well.
    """
    first = [0]
    for step in range(1, count):
        first.append((first[-1] + (step if step % 2 else -step)) % count)
    rows = [[(item + shift) % count for item in first] for shift in range(count)]
    return rows if count % 2 == 0 else rows + [row[::-1] for row in rows]


def ordered(items: Sequence[Item], way: str, row: int, seed: int) -> list[Item]:
    """Return items in the order of a person.

    Args:
        items: what is to be ordered.
        way: latin, random or fixed.
        row: the person's row of the square; larger ones begin again.
        seed: where a random order comes from.
    """
    if way == "fixed":
        return list(items)
    if way == "random":
        draws = np.random.Generator(np.random.PCG64(seed)).random(len(items))
        return [items[i] for i in np.argsort(draws, kind="stable")]
    rows = latin_square(len(items))
    return [items[i] for i in rows[row % len(rows)]]


def emotions_of(config: StudyConfig, block: Evolve) -> tuple[str, ...]:
    """Return the adjectives that a block asks for; a retest asks for those of the block that it repeats."""
    if block.emotions:
        return block.emotions
    repeated = [one for one in config.steps if isinstance(one, Evolve) and one.name == block.retest_of]
    return emotions_of(config, repeated[0]) if repeated else tuple(one.adjective for one in config.emotions)


def most_rows(config: StudyConfig) -> int:
    """Return how many rows people have to be spread over, for the block with the most emotions."""
    sizes = [len(emotions_of(config, block)) for block in config.steps if isinstance(block, Evolve)]
    return max((len(latin_square(size)) for size in sizes), default=1)
