"""Markov chains on what somebody may have in mind, all of them in step.

A chain holds a target t in [0, 1)^A with genes that are exactly 0, a noise scale and a metric. A round has moves

- of one gene: switch on at U(0, 1); or, if on, switch off with probability `DEATH`, else a step of sd .08 or .3
  (reversible jumps between numbers of genes; P. J. Green: Reversible jump Markov chain Monte Carlo computation.
  Biometrika 82 (4), 1995, 711-732. doi:10.1093/biomet/82.4.711);
- every eighth, a swap of a gene that is on with one that is off;
- every eighth, a step of log tau; and the last one goes to the other metric.

All chance comes in as uniform numbers, so that another implementation can use the same ones. A step is a sum of three
of them, not a normal deviate, and genes are sums and copies of such numbers: neither exp nor a norm enters a gene, only
the comparisons that accept it. What moves change (products, powers, probabilities) is in single precision and made of
additions, multiplications, divisions and roots, which are the same on every machine; the rest is in double precision.

Symbols: ``C`` chains of ``R`` searches, which may be in step too; ``A`` genes; ``F`` faces.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from emogen_core.search.preference.likelihood import likelihood
from emogen_core.search.preference.powers import power_of_two
from emogen_core.search.preference.prior import LOG_TAU, birth_odds
from emogen_core.search.preference.sample import Sample
from emogen_core.search.preference.utility import COSINE, LEAST_SQUARE, VERTEX, shown

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from emogen_core.search.preference.likelihood import Block
    from emogen_core.search.preference.utility import Space

    Floats = NDArray[np.float64]
    Singles = NDArray[np.float32]
    Indices = NDArray[np.intp]
    Marks = NDArray[np.bool_]

ROUND = 48
"""Moves a round; the last one is of the metric."""
EVERY = 8
NUMBERS = 7
"""Uniform numbers a move and chain."""
DEATH = 0.4
"""Chance that a gene that is on is switched off rather than changed."""
STEP_SDS = (0.08, 0.3)
LOG_TAU_SD = 0.4
LN2 = 0.6931471805599453
BORN = np.array([1, 0, -1])
"""How many genes more are on after a birth, a step and a death."""
LIFT = 72.0
"""Half of the largest cosine utility in bits, at the least tau. Utilities are moved by it so that they stay within what
single precision can tell; the choice model only compares faces."""


@dataclass(frozen=True, eq=False)
class Evidence:
    """What was shown and answered in R searches with as many answers of as many faces each.

    Attributes:
        faces: (R, 10 answers, A) faces that were shown.
        blocks: of the answers of every search.
    """

    faces: Floats
    blocks: Sequence[Sequence[Block]]

    def ranked(self) -> Floats:
        """Return the (R, F, A) faces as the blocks rank them, neutral ones for fillers."""
        filled = np.concatenate([self.faces, np.zeros_like(self.faces[:, :1])], axis=1)
        rows = [np.concatenate([block.rows for block in blocks]) for blocks in self.blocks]
        return np.stack([faces[some] for faces, some in zip(filled, rows, strict=True)])


class Chains:
    """Chains in step, sorted by metric so that each metric has its own run of columns."""

    def __init__(self, space: Space, evidence: Evidence, sample: Sample, searches: Indices) -> None:
        faces = shown(space, evidence.ranked())
        self.blocks, self.searches = evidence.blocks[0], len(evidence.faces)
        self.space, self.features, self.squares = space, faces.features, faces.squares.astype(np.float32)
        self.table = faces.features.reshape(len(faces.features), -1).astype(np.float32)
        self.forms = space.products.reshape(-1, space.genes)
        self.fillers = np.concatenate([block.lift for block in self.blocks])
        self.odds = _odds(space.genes)
        self.columns = self.order = np.arange(len(searches))
        self.search, self.genes = searches, sample.genes
        self.log_tau, self.metric = sample.log_tau, sample.metric
        self.refresh()

    def refresh(self) -> None:
        """Sort the chains by metric, and compute from scratch what moves keep up to date."""
        order = np.argsort(self.metric, kind="stable")
        self.order, self.search = self.order[order], self.search[order]
        self.genes, self.log_tau, self.metric = self.genes[order], self.log_tau[order], self.metric[order]
        self.cosine = int((self.metric == COSINE).sum())
        self.lift = self.fillers + np.where(self.metric == COSINE, -LIFT, LIFT).astype(np.float32)
        self.own = self.squares[:, self.search[self.cosine :]]
        self.base = (self.metric * self.searches + self.search) * self.space.genes
        self.form = self.metric * self.space.genes
        self.on = (self.genes > 0).sum(axis=1)
        self.sharp = _sharpness(self.log_tau)
        self.dots, self.square = self.products(), self.space.squares(self.metric, self.genes)
        self.like = self.likely(self.dots, self.square, self.sharp)

    def products(self) -> Singles:
        """Return the (F, C) products of faces and targets, from scratch."""
        dots = np.empty((len(self.table), len(self.columns)), np.float32)
        for metric in (COSINE, VERTEX):
            for search in range(self.searches):
                chosen = np.flatnonzero((self.metric == metric) & (self.search == search))
                dots[:, chosen] = self.features[:, metric, search] @ self.genes[chosen].T
        return dots

    def likely(self, dots: Singles, square: Floats, sharp: Floats) -> Floats:
        """Return the (C,) likelihoods of all answers."""
        squares, cosine = np.maximum(square, LEAST_SQUARE), self.cosine
        scale = (sharp / np.sqrt(squares)).astype(np.float32)
        utility = dots * scale
        if cosine < len(scale):
            apart = self.own - dots[:, cosine:]
            apart += squares[cosine:].astype(np.float32)
            np.sqrt(np.maximum(apart, 0, out=apart), out=apart)
            np.multiply(apart, -scale[cosine:], out=utility[:, cosine:])
        utility += self.lift
        return likelihood(self.blocks, power_of_two(utility))

    def round(self, numbers: Floats) -> None:
        """Make a round of moves with (`ROUND`, 7, C) numbers, by the chains as they came."""
        uniform = numbers[:, :, self.order]
        gene = (uniform[:, 0] * self.space.genes).astype(np.intp)
        step = (uniform[:, 3] + uniform[:, 4] + uniform[:, 5]) * 2 - 3
        width = np.where(uniform[:, 1] < 0.5, *STEP_SDS) * step
        off = uniform[:, 2] < DEATH
        for place in range(ROUND - 1):
            if place % EVERY == EVERY - 1:
                self.step_tau(step[place], uniform[place, 6])
            elif place % EVERY == EVERY // 2 - 1:
                self.swap(uniform[place])
            else:
                self.one_gene(gene[place], off[place], width[place], uniform[place])
        self.other_metric(uniform[-1, 6])

    def one_gene(self, gene: Indices, off: Marks, step: Floats, uniform: Floats) -> None:
        """Switch a gene on or off, or change it."""
        now = self.genes[self.columns, gene]
        on = now > 0
        died = on & off
        new = np.where(on, np.where(died, 0, now + step), uniform[1])
        allowed = ((new > 0) | died) & (new < 1)
        kind = on.astype(np.intp) + died
        change = (new - now) * allowed
        added, square = self.changed(gene, change)
        taken = self.accept(added, square, self.odds[kind, self.on] * allowed, uniform[6])
        self.genes[self.columns, gene] = np.where(taken, new, now)
        self.on += taken * BORN[kind]

    def swap(self, uniform: Floats) -> None:
        """Give the weight of a gene that is on to one that is off."""
        on = self.genes > 0
        able = (self.on > 0) & (self.on < self.space.genes)
        first, second = _nth(on, uniform[0] * self.on), _nth(~on, uniform[1] * (self.space.genes - self.on))
        weight = np.where(able, self.genes[self.columns, first], 0)
        added, without = self.changed(first, -weight)
        more, grown = self.changed(second, weight)
        added += more
        square = without + grown - self.square - 2 * weight * weight * self.forms[self.form + first, second]
        rows = np.flatnonzero(self.accept(added, square, able.astype(np.float64), uniform[6]))
        self.genes[rows, first[rows]], self.genes[rows, second[rows]] = 0, weight[rows]

    def step_tau(self, step: Floats, uniform: Floats) -> None:
        """Change the noise scale."""
        new = self.log_tau + LOG_TAU_SD * step
        sharp = _sharpness(new)
        like = self.likely(self.dots, self.square, sharp)
        taken = (uniform * self.like < like) & (new > LOG_TAU[0]) & (new < LOG_TAU[1])
        self.log_tau, self.sharp = np.where(taken, new, self.log_tau), np.where(taken, sharp, self.sharp)
        self.like = np.where(taken, like, self.like)

    def other_metric(self, uniform: Floats) -> None:
        """Judge by the other metric."""
        before, metric, order = self.like, self.metric, self.order
        self.metric = 1 - metric
        self.refresh()
        taken = uniform * before < self.in_order()[order]
        back = np.empty_like(metric)
        back[order] = np.where(taken, 1 - metric, metric)
        self.metric = back[self.order]
        self.refresh()

    def changed(self, gene: Indices, change: Floats) -> tuple[Singles, Floats]:
        """Return what a change of one gene a chain adds to the (F, C) products, and the squares after it."""
        added = self.table.take(self.base + gene, axis=1)
        added *= change.astype(np.float32)
        form = self.forms.take(self.form + gene, axis=0)
        along = np.einsum("ca,ca->c", form, self.genes)
        return added, self.square + change * (2 * along + change * form[self.columns, gene])

    def accept(self, added: Singles, square: Floats, odds: Floats, uniform: Floats) -> Marks:
        """Return which chains take a change of products and squares, after they did."""
        like = self.likely(self.dots + added, square, self.sharp)
        taken = uniform * self.like < like * odds
        added *= taken
        self.dots += added
        self.square, self.like = np.where(taken, square, self.square), np.where(taken, like, self.like)
        return np.asarray(taken)

    def in_order(self) -> Floats:
        """Return the (C,) likelihoods of the chains as they came."""
        return self.like[np.argsort(self.order)]

    def sample(self) -> Sample:
        """Return the draws as they came."""
        return Sample(self.genes, self.log_tau, self.metric).at(np.argsort(self.order))


def _odds(genes: int) -> Floats:
    """Return (3, A + 1) prior odds times ratio of proposals of a birth, a step and a death, by genes that are on."""
    birth = birth_odds(genes) * DEATH
    death = 1 / birth[1:-1]  # the last gene stays on
    return np.stack([birth, np.ones_like(birth), np.concatenate([[0, 0], death])])


def _sharpness(log_tau: Floats) -> Floats:
    """Return how many powers of two a unit of utility is worth."""
    return np.asarray(np.exp(-log_tau) / LN2)


def _nth(marks: Marks, rank: Floats) -> Indices:
    """Return in every row of (C, A) marks the place of the mark with a rank from 0; any place where there is none."""
    return np.asarray(np.argmax(np.cumsum(marks, axis=1) > np.floor(rank)[:, None], axis=1))
