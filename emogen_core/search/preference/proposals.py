"""The faces that may be shown next: draws from the posterior, means and parts of them, and sparse faces at random.

Genes are rounded to a grid of 2^-24 wherever a mean or a norm makes them, so that they do not depend on the last bit of
a sum or a root: on every machine the same face is shown.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from emogen_core.search.operators import scatter
from emogen_core.search.preference.utility import COSINE, LEAST_SQUARE

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from emogen_core.search.preference.sample import Sample
    from emogen_core.search.preference.utility import Space

    Floats = NDArray[np.float64]

PAIRS, TRIPLES, CROSSED, PARTS, SPARSE = 24, 12, 16, 48, 24
"""How many means of two draws and of three, mixtures of elite and draw, parts of a draw, and random faces."""
MOST_IN_PART, MOST_SPARSE = 6, 7
GRID = 2.0**24
LEAST_STRONGEST = 0.4
"""Of a shown face's strongest gene while faces are judged by composition: fainter ones could hardly be told apart."""
VISIBLE = 5 / 32
"""Least weight of a shown face's strongest gene, however faces are judged: below it, it looks like the neutral one. It
is on the grid, so that a face that was raised to it is not below it."""
MOST_ACTIVE, EARLY = 16, 7
"""Genes at work in a face, up to this generation."""
FAINT = 0.02
"""Weights below it are not shown."""
STRONGEST = 0.1
"""Share of the genes that count in a face whose weights say how strong it is."""


def on_grid(genes: Floats) -> Floats:
    """Return genes in [0, 1), multiples of 2^-24."""
    return np.asarray(np.clip(np.rint(genes * GRID), 0, GRID - 1) / GRID)


def mean_face(space: Space, sample: Sample) -> Floats:
    """Return the (A,) face that stands for all draws.

    While most draws judge by cosine, it is their mean direction, on average the nearest to all of them. Answers tell
    nothing of strength then, so it is what the prior says of so many genes, see `_strength`.

    While most judge by vertices, every gene is at its root mean square: the mean would be weaker than any draw
    wherever draws have different genes at work.
    """
    (face,) = _means(space, sample, np.arange(len(sample.metric))[None])
    return np.asarray(face)


def composition_leads(sample: Sample) -> bool:
    """Return whether at least half of the draws judge by cosine."""
    return bool(np.mean(sample.metric == COSINE) >= 0.5)


def pool(sample: Sample, elite: Floats, rng: np.random.Generator) -> tuple[Floats, tuple[str, ...]]:
    """Return (P, A) candidates and where each comes from."""
    draws = sample.genes
    kinds = {
        "draw": draws,
        "draws-mean": np.concatenate([_averages(draws, 2, PAIRS, rng), _averages(draws, 3, TRIPLES, rng)]),
        "elite-draw": _crossed(elite, rng.random((CROSSED, len(elite))) < 0.5, _some(draws, CROSSED, rng)),
        "part": _parts(_some(draws, PARTS, rng), rng),
        "random": _sparse(len(elite), rng),
    }
    origins = tuple(name for name, faces in kinds.items() for _ in faces)
    return np.concatenate(list(kinds.values())), origins


def shaped(sample: Sample, genes: Floats, generation: int) -> Floats:
    """Return (B, A) faces as they may be shown: not too many genes at work early, none faint, none nearly invisible."""
    raised = _raised(genes, LEAST_STRONGEST if composition_leads(sample) else VISIBLE)
    shown = np.where(raised < FAINT, 0, raised)
    if generation <= EARLY and genes.shape[1] > MOST_ACTIVE:
        order = np.argsort(-shown, axis=1, kind="stable")
        np.put_along_axis(shown, order[:, MOST_ACTIVE:], 0, axis=1)
    return on_grid(shown)


def visible(face: Floats) -> bool:
    """Return whether an (A,) face can be told from the neutral one."""
    return bool(face.max() >= VISIBLE)


def means_of_many(space: Space, sample: Sample, count: int, draws: int, rng: np.random.Generator) -> Floats:
    """Return (count, A) mean faces of some of the draws each."""
    order = np.argsort(rng.random((count, len(sample.metric))), axis=1, kind="stable")
    return _means(space, sample, order[:, :draws])


def _means(space: Space, sample: Sample, which: NDArray[np.intp]) -> Floats:
    """Return the (B, A) faces that stand for (B, n) draws each."""
    if not composition_leads(sample):
        return on_grid(np.sqrt(np.square(sample.genes)[which].mean(axis=1)))
    squares = np.maximum(space.squares(np.full(len(sample.metric), COSINE), sample.genes), LEAST_SQUARE)
    directions = (sample.genes / np.sqrt(squares)[:, None])[which].sum(axis=1)
    return on_grid(directions * _strength(directions)[:, None])


def _strength(faces: Floats) -> Floats:
    """Return the (B,) factors that make faces as strong as their prior says of the genes that count in them.

    Of ``n`` weights that are U(0, 1) the strongest ``k`` have the mean ``1 - (k + 1) / (2 (n + 1))``; it is given to
    the strongest tenth, since they are known best.
    """
    count = _counting(faces)
    strongest = np.ceil(count * STRONGEST)
    taken = np.arange(faces.shape[1]) < strongest[:, None]
    sums = np.where(taken, -np.sort(-faces, axis=1), 0).sum(axis=1)
    return np.asarray((strongest - strongest * (strongest + 1) / (2 * (count + 1))) / np.maximum(sums, LEAST_SQUARE))


def _counting(faces: Floats) -> Floats:
    """Return how many genes count in (B, A) faces, at least 1.

    ``c``, 1 over the sum of squared shares of the squared weights, is 1 for one gene and ``n (1/3)^2 / (1/5)``, 5/9 of
    ``n``, for many that are U(0, 1). Squared, for a mean of draws also has a little of many genes that are not meant.
    """
    squares = np.square(faces)
    shares = squares / np.maximum(squares.sum(axis=1, keepdims=True), LEAST_SQUARE)
    c = 1 / np.maximum(np.square(shares).sum(axis=1), 1 / faces.shape[1])
    return np.asarray(np.rint((9 * c - 4) / 5 * GRID) / GRID)


def _raised(genes: Floats, least: float) -> Floats:
    """Return (B, A) faces, the faint ones made stronger until their strongest gene has a weight; neutral ones stay."""
    strongest = genes.max(axis=1, keepdims=True)
    factors = np.divide(least, strongest, out=np.ones_like(strongest), where=strongest > 0)
    return np.asarray(genes * np.maximum(factors, 1))


def _crossed(elite: Floats, inherited: NDArray[np.bool_], draws: Floats) -> Floats:
    """Return (B, A) faces with every gene from the elite or from a draw; the draw where nothing would be at work."""
    mixed = np.where(inherited, elite, draws)
    return np.asarray(np.where(mixed.any(axis=1, keepdims=True), mixed, draws))


def _some(draws: Floats, count: int, rng: np.random.Generator) -> Floats:
    return draws[(rng.random(count) * len(draws)).astype(np.intp)]


def _averages(draws: Floats, of: int, count: int, rng: np.random.Generator) -> Floats:
    order = np.argsort(rng.random((count, len(draws))), axis=1, kind="stable")[:, :of]
    return on_grid(draws[order].sum(axis=1) / of)


def _parts(faces: Floats, rng: np.random.Generator) -> Floats:
    """Return faces of which one to six genes that are at work stay."""
    keep = 1 + (rng.random(len(faces)) * MOST_IN_PART).astype(np.intp)
    keys = np.where(faces > 0, rng.random(faces.shape), 2)
    rank = np.argsort(np.argsort(keys, axis=1, kind="stable"), axis=1, kind="stable")
    return np.where(rank < keep[:, None], faces, 0)


def _sparse(genes: int, rng: np.random.Generator) -> Floats:
    """Return faces with one to seven genes at U(0, 1)."""
    most = min(MOST_SPARSE, genes)
    counts = 1 + (rng.random(SPARSE) * most).astype(np.intp)
    indices = np.argsort(rng.random((SPARSE, genes)), axis=1, kind="stable")[:, :most]
    return scatter(genes, indices, rng.random((SPARSE, most)) * (np.arange(most) < counts[:, None]))
