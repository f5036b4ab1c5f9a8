"""One stream of random numbers a slot, so that every slot of every generation replays alone and bit for bit.

Only uniform doubles are drawn: numpy promises no fixed stream for its derived distributions, and the bits of a
PCG64 double are the least likely thing in it to change between versions. Integers and orders are made from them here.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

WHOLE_POPULATION = 0
"""Stands where a slot (1 to 10) would: draws that concern the population as a whole."""
PLACES = 11
"""Stands where a slot would: the order on screen."""
FIXED_OPTION = 12
"""Stands where a slot would: which of several fixed populations a trial begins with."""
BELIEFS = 13
"""Stands where a slot would: what is believed after the choice that made this generation."""
PROPOSALS = 14
"""Stands where a slot would: the candidates for all ten slots, where slots are picked together."""


def stream(seed: int, attempt: int, generation: int, slot: int) -> np.random.Generator:
    """Return the stream of one slot: `SeedSequence(entropy=seed, spawn_key=(attempt, generation, slot))`."""
    sequence = np.random.SeedSequence(entropy=seed, spawn_key=(attempt, generation, slot))
    return np.random.Generator(np.random.PCG64(sequence))


def integers(rng: np.random.Generator, below: int, count: int) -> NDArray[np.intp]:
    """Return `count` independent integers, uniform on 0 to `below - 1`."""
    return (rng.random(count) * below).astype(np.intp)


def order(rng: np.random.Generator, count: int) -> NDArray[np.intp]:
    """Return a uniformly random order of 0 to `count - 1`."""
    return np.argsort(rng.random(count), kind="stable")


def option_of(seed: int, attempt: int, count: int) -> int:
    """Return which of `count` fixed populations (from 0) a trial begins with, drawn anew for each attempt."""
    return int(integers(stream(seed, attempt, 0, FIXED_OPTION), count, 1)[0])


def place_order(seed: int, attempt: int, generation: int, count: int = 10) -> tuple[int, ...]:
    """Return the slots (from 1) in the order of their place on screen, shuffled anew every generation."""
    return tuple(int(i) + 1 for i in order(stream(seed, attempt, generation, PLACES), count))
