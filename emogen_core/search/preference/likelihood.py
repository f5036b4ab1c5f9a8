"""How likely an answer is: the choice model of Plackett and Luce, the order of the other selected faces summed out.

With ``w_j = exp(u_j / tau)`` for the utilities of the ten faces, the elite ``e`` is named first, and then the others
of the selection ``S`` before any face of the rest:

    P(elite) = (1 - eps) w_e / sum_j w_j + eps / 10
    P(S before the rest) = (1 - eps) sum_{A subset of S} (-1)^|A| L / (L + w_A) + eps / C(9, |S|)

where L is the sum of w over the rest. The second is the chance that in a race of exponential times with rates w the
last of S comes before the first of the rest (inclusion and exclusion over its 2^|S| subsets), so no order of clicks is
assumed. ``eps`` is the chance of a lapse. R. D. Luce: Individual Choice Behavior. Wiley, 1959. R. L. Plackett: The
analysis of permutations. Applied Statistics 24 (2), 1975, 193-202. doi:10.2307/2346567

All answers are one array of faces by rank, whatever the number of selected faces: where an answer has fewer others, a
face that everybody would name at once fills the place and changes nothing, and where it has a smaller rest, one that
nobody would ever name.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import comb
from typing import TYPE_CHECKING

import numpy as np

from emogen_core.search.params import POPULATION

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from emogen_core.search.state import Choice

    Singles = NDArray[np.float32]

LAPSE = 0.03
MOST_SUMMED = 5
"""Others selected up to which the subsets are summed; beyond it, the race is integrated numerically."""
FILLER = 300.0
"""Powers of two that a face which fills a place is above, or below, all others."""
FASTEST = 2.0**25
"""Rate, in those of the rest, beyond which a face is certain to come first."""
FIRST_TIME, TIMES = 2.0**-11, 16
"""Of the race, in units of the mean wait for the rest; each twice the one before. Good to 2e-4 of a probability."""


@dataclass(frozen=True, eq=False)
class Block:
    """``g`` answers as ranks of faces: elite, ``s`` others, ``r`` of the rest.

    Attributes:
        rows: ((1 + s + r) g,) which shown face stands at rank and answer, the answers next to each other; one past the
            last where a filler does.
        lift: ((1 + s + r) g, 1) powers of two that fillers are above or below all faces, 0 for faces.
        real: (s, g, 1) 1 where an other is a face, 0 where a filler.
        lapse: (g, 1) chance of the same others by a lapse.
        shape: (1 + s + r, g).
    """

    rows: NDArray[np.intp]
    lift: Singles
    real: Singles
    lapse: Singles
    shape: tuple[int, int]


def arranged(choices: Sequence[Choice]) -> list[Block]:
    """Return the answers in one block or two; shown faces count from 0 through all answers, ten an answer."""
    ranks = [_ranks(choice, POPULATION * i) for i, choice in enumerate(choices)]
    few = [one for one in ranks if len(one[1]) <= MOST_SUMMED]
    many = [one for one in ranks if len(one[1]) > MOST_SUMMED]
    return [_block(some, POPULATION * len(choices)) for some in (few, many) if some]


def _ranks(choice: Choice, begin: int) -> tuple[int, list[int], list[int]]:
    """Return elite, others and rest; if nothing is left, the others tell nothing and count as the rest."""
    others = [begin + slot - 1 for slot in choice.others]
    rest = [begin + slot for slot in range(POPULATION) if slot + 1 not in choice.selected]
    elite = begin + choice.elite - 1
    return (elite, others, rest) if rest else (elite, [], others)


def _block(ranks: Sequence[tuple[int, list[int], list[int]]], none: int) -> Block:
    others, rest = max(len(named) for _, named, _ in ranks), max(len(left) for _, _, left in ranks)
    rows = np.full((1 + others + rest, len(ranks)), none)
    lift = np.zeros(rows.shape, np.float32)
    lift[1 : 1 + others], lift[1 + others :] = FILLER, -FILLER
    for column, (elite, named, left) in enumerate(ranks):
        places = np.concatenate([[0], 1 + np.arange(len(named)), 1 + others + np.arange(len(left))]).astype(np.intp)
        rows[places, column], lift[places, column] = [elite, *named, *left], 0
    real = (lift[1 : 1 + others, :, None] == 0).astype(np.float32)
    lapse = [LAPSE / comb(POPULATION - 1, len(one[1])) for one in ranks]
    return Block(rows.ravel(), lift.reshape(-1, 1), real, np.array(lapse, np.float32)[:, None], rows.shape)


def likelihood(blocks: Sequence[Block], weights: Singles) -> NDArray[np.float64]:
    """Return the (C,) probabilities of all answers together.

    Args:
        blocks: how the faces stand.
        weights: (F, C) weights w of the faces, as the blocks rank them.
    """
    together, begin = np.ones(weights.shape[1]), 0
    for block in blocks:
        end = begin + len(block.rows)
        chances = answers(block, weights[begin:end].reshape(*block.shape, -1))
        together *= np.multiply.reduce(chances, axis=0, dtype=np.float64)
        begin = end
    return together


def answers(block: Block, race: Singles) -> Singles:
    """Return the (g, C) probabilities of answers from the (1 + s + r, g, C) weights of their faces by rank."""
    count = len(block.real)
    others = race[1 : 1 + count]
    rest: Singles = np.add.reduce(race[1 + count :], axis=0)
    total = race[0] + rest
    total += np.add.reduce(others * block.real, axis=0)
    first: Singles = race[0] / total
    first *= 1 - LAPSE
    first += LAPSE / POPULATION
    before = _summed(others, rest) if count <= MOST_SUMMED else _integrated(others, rest)
    np.maximum(before, 0, out=before)
    before *= 1 - LAPSE
    before += block.lapse
    first *= before
    return first


def _summed(others: Singles, rest: Singles) -> Singles:
    """Return the (g, C) chances that all of (s, g, C) come before the rest, by inclusion and exclusion."""
    sums: Singles = np.empty((2 ** len(others), *rest.shape), rest.dtype)
    sums[0] = rest
    for i, weight in enumerate(others):
        np.add(sums[: 2**i], weight, out=sums[2**i : 2 ** (i + 1)])
    np.divide(rest, sums, out=sums)
    half = len(sums) // 2
    while half:  # subsets with a face count as those without it, less: signs by folding
        sums[:half] -= sums[half : 2 * half]
        half //= 2
    chance: Singles = sums[0]
    return chance


def _integrated(others: Singles, rest: Singles) -> Singles:
    """Return the same by the trapezoid rule on the logarithm of the time at which the first of the rest comes.

    Times double, so what is left of a face, ``exp(-rate time)``, is squared from one to the next.
    """
    left = np.exp(-FIRST_TIME * (np.minimum(others, rest * FASTEST) / rest).astype(np.float64))
    chance, time = np.zeros(rest.shape), FIRST_TIME
    for _ in range(TIMES):
        chance += np.multiply.reduce(1 - left, axis=0) * (time * np.exp(-time) * np.log(2))
        left *= left
        time *= 2
    return chance.astype(np.float32)
