"""Faces, answers and draws on a small space, for tests of what is believed after them."""

from __future__ import annotations

import numpy as np

from emogen_core.search import Choice
from emogen_core.search.preference import prior
from emogen_core.search.preference.chains import Evidence
from emogen_core.search.preference.likelihood import arranged
from emogen_core.search.preference.sample import Sample
from emogen_core.search.preference.utility import Space

GENES = 12


def space() -> Space:
    """Twelve genes, every second a pair, whose meshes overlap."""
    rng = np.random.default_rng(5)
    offsets = rng.normal(size=(GENES, 30))
    return Space(np.stack([np.diag(np.tile([1.0, 2.0], GENES // 2)), offsets @ offsets.T / 20]))


def faces(count: int, seed: int = 0, genes: int = GENES) -> np.ndarray:
    """Sparse faces, the first of each ten neutral."""
    rng = np.random.default_rng(seed)
    made = rng.random((count, genes)) * (rng.random((count, genes)) < 0.3)
    made[::10] = 0
    return made


def draws(count: int, seed: int = 0, genes: int = GENES) -> Sample:
    return prior.drawn(np.random.default_rng(seed).random((count, 3 + 2 * genes)))


def choice(selected: int, seed: int = 0) -> Choice:
    order = np.random.default_rng(seed).permutation(10)[:selected] + 1
    return Choice(tuple(order.tolist()), int(order[0]))


def evidence(counts: tuple[int, ...], seed: int = 0) -> Evidence:
    """Answers with these numbers of selected faces."""
    choices = [choice(count, seed + i) for i, count in enumerate(counts)]
    return Evidence(faces(10 * len(counts), seed)[None], [arranged(choices)])
