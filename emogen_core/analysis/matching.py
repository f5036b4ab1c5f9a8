"""Do people name a face as an emotion more often if it is like the face that they made for it.

Answers are yes or no, and nested in people. Two things must not pass for a match: that somebody says yes often, and
that a face is a good example which everybody names so. Both are dealt with twice:

- **p** is by permutation of people. The statistic is ``sum_j (y_j - y_s) s_j`` over judgements j, y_s the mean answer
  of the same person about faces of the same emotion: the score of a conditional logistic regression (Breslow and Day
  1980, Statistical Methods in Cancer Research I, chapter 7). Own faces are shuffled over people: if it does not matter
  whose face it is, that of anybody else does as well. Stimuli and answers stay what they are, so good examples
  are good examples in every shuffling.
- **The odds ratio** is of a logistic regression by generalised estimating equations with people as clusters (Liang and
  Zeger 1986, doi:10.1093/biomet/73.1.13), its standard error robust and corrected for few clusters (Mancl and DeRouen
  2001, doi:10.1111/j.0006-341X.2001.00126.x), its interval by Student's t. Similarity to the own face, and to the mean
  face of all others as a measure of how typical a face is, are centred on person and emotion.
"""

from __future__ import annotations

import warnings
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
from scipy import stats

from emogen_core.analysis.distances import cosine_matrix
from emogen_core.analysis.enough import Lacking, Result, too_few
from emogen_core.analysis.intervals import LEVEL
from emogen_core.analysis.permutation import RESAMPLES, pairing_p
from emogen_core.analysis.recorded import by_person
from emogen_core.errors import InvalidInputError, expected

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from emogen_core.analysis.recorded import Faces

    Floats = NDArray[np.float64]
    Places = NDArray[np.intp]
    Words = NDArray[np.str_]

CLUSTERS = 10
"""People that an odds ratio needs: with fewer, robust standard errors are too small."""
ANSWERS = 20
"""Judgements of the rarer answer that it needs: ten for each of two predictors (Peduzzi et al. 1996)."""
STEP = 0.1
"""Of similarity, that the odds ratio is told for."""
TORN = "people who answered differently about faces of one emotion"
RARER, ESTIMATE = "judgements of the rarer answer", "estimates that are finite"
_SAME = 1 - 1e-6


@dataclass(frozen=True, slots=True, eq=False)
class Judgements:
    """What people said of faces that were shown to them.

    Attributes:
        people: (J,) who said it.
        emotions: (J,) the emotion in question.
        weights: (J, K) of the face that was shown.
        named: (J,) whether they named it as that emotion.
    """

    people: Words
    emotions: Words
    weights: Floats
    named: NDArray[np.bool_]

    def __post_init__(self) -> None:
        """Refuse arrays of different lengths."""
        lengths = [len(one) for one in (self.people, self.emotions, self.weights, self.named)]
        if len(set(lengths)) > 1 or np.ndim(self.weights) != 2:
            raise InvalidInputError(f"judgements: {expected('one entry a judgement in every array', lengths)}")

    def take(self, which: NDArray[np.bool_]) -> Judgements:
        """Return some of them."""
        return Judgements(self.people[which], self.emotions[which], self.weights[which], self.named[which])


@dataclass(frozen=True, slots=True)
class OddsRatio:
    """How the odds of being named so multiply with every `STEP` of similarity, and the 95 % interval of it."""

    value: float
    low: float
    high: float


@dataclass(frozen=True, slots=True, kw_only=True)
class Match(Result):
    """Whether likeness to the own face predicts the name.

    Attributes:
        people, judgements: how many count.
        left_out: people with judgements who have not made a face for every emotion in question.
        shown_own: judgements of the very face that the person made, which are left out: it is recognised.
        own: odds ratio of the similarity to the own face, beside that to the others'; None where it lacks something.
        typical: odds ratio of the similarity to the mean face of all others, beside that to the own.
        odds_lack: what the odds ratios lack.
        p: two-sided, by permutation; None with too few people.
        permutations, exact: how many shufflings, and whether these are all.
    """

    people: int
    judgements: int
    left_out: int
    shown_own: int
    own: OddsRatio | None = None
    typical: OddsRatio | None = None
    odds_lack: Lacking | None = None
    p: float | None = None
    permutations: int = 0
    exact: bool = False


@dataclass(frozen=True, slots=True, eq=False)
class _Table:
    """Judgements as numbers.

    Attributes:
        person: (J,) index of who judged.
        stratum: (J,) index of person and emotion.
        named: (J,) 0 or 1.
        alike: (P, J) similarity of the face shown to the face that each of the people made for the emotion.
    """

    person: Places
    stratum: Places
    named: Floats
    alike: Floats

    def centred(self, values: Floats) -> Floats:
        """Return (J,) values less their mean over the same person and emotion."""
        sizes = np.bincount(self.stratum)
        return np.asarray(values - (np.bincount(self.stratum, values) / sizes)[self.stratum])

    @property
    def own(self) -> Floats:
        """(J,) similarity to the face of the person who judged."""
        return np.asarray(self.alike[self.person, np.arange(len(self.person))])

    @property
    def typical(self) -> Floats:
        """(J,) mean similarity to the faces of all other people."""
        return np.asarray((self.alike.sum(0) - self.own) / max(len(self.alike) - 1, 1))


def match(judgements: Judgements, own: Faces, rng: np.random.Generator, resamples: int = RESAMPLES) -> Match:
    """Return whether people name faces by how much these are like their own.

    Args:
        judgements: of faces that were shown.
        own: what people made; several of one person and emotion count by their mean.
        rng: where shufflings come from, unless all are made.
        resamples: greatest number of shufflings.
    """
    people = _complete(judgements, own)
    kept = judgements.take(np.isin(judgements.people, people))
    fresh = _table(kept, own, people).own < _SAME
    table = _table(kept.take(fresh), own, people)
    judging = len(np.unique(table.person))
    lacks = too_few(judging) or too_few(_rarer(table), 1, RARER) or too_few(_torn(table), 1, TORN)
    told = Match(
        people=judging, judgements=len(table.named), left_out=len(np.unique(judgements.people)) - len(people),
        shown_own=int((~fresh).sum()), lacks=lacks, odds_lack=lacks,
    )  # fmt: skip
    if lacks:
        return told
    p, permutations, exact = pairing_p(_scores(table), "two-sided", rng, resamples)
    found = replace(told, p=p, permutations=permutations, exact=exact)
    odds = _odds(table)
    if isinstance(odds, Lacking):
        return replace(found, odds_lack=odds)
    return replace(found, own=odds[0], typical=odds[1])


def _complete(judgements: Judgements, own: Faces) -> Words:
    """Return who judged and made a face for every emotion in question, sorted."""
    people = np.unique(judgements.people)
    for emotion in np.unique(judgements.emotions):
        people = np.intersect1d(people, own.only(emotion).people)
    return np.asarray(people)


def _table(judgements: Judgements, own: Faces, people: Words) -> _Table:
    emotions, emotion = np.unique(judgements.emotions, return_inverse=True)
    person = np.searchsorted(people, judgements.people)
    alike = np.zeros((len(people), len(person)))
    for i, name in enumerate(emotions):
        made = own.only(str(name))
        made = made.take(np.isin(made.people, people))
        alike[:, emotion == i] = 1 - cosine_matrix(
            by_person(made.weights, made.people)[1], judgements.weights[emotion == i]
        )
    _, stratum = np.unique(person * max(len(emotions), 1) + emotion, return_inverse=True)
    return _Table(person, stratum, judgements.named.astype(np.float64), alike)


def _rarer(table: _Table) -> int:
    yes = int(table.named.sum())
    return min(yes, len(table.named) - yes)


def _torn(table: _Table) -> int:
    """Return how many people said yes to some and no to other faces of one emotion: only they tell anything."""
    return len(np.unique(table.person[np.abs(table.centred(table.named)) > 1e-12]))


def _scores(table: _Table) -> Floats:
    """Return (P, P) scores of each person's answers with each person's own faces."""
    judged = np.zeros((len(table.named), len(table.alike)))
    judged[np.arange(len(judged)), table.person] = table.centred(table.named)
    return np.asarray((table.alike @ judged).T)


def _odds(table: _Table) -> tuple[OddsRatio, OddsRatio] | Lacking:
    """Return the odds ratios of the similarity to the own face and to the others', or what is lacking for them."""
    lacks = too_few(len(np.unique(table.person)), CLUSTERS) or too_few(_rarer(table), ANSWERS, RARER)
    if lacks:
        return lacks
    predictors = np.stack([np.ones(len(table.named)), table.centred(table.own), table.centred(table.typical)], 1)
    # It takes two seconds to load, which every command that does not need it would pay.
    from statsmodels.genmod.families import Binomial  # noqa: PLC0415
    from statsmodels.genmod.generalized_estimating_equations import GEE  # noqa: PLC0415

    model = GEE(table.named, predictors, groups=table.person, family=Binomial())
    with warnings.catch_warnings():
        # Answers that are foretold without error have no finite estimate; that is seen below.
        warnings.simplefilter("ignore")
        fit = model.fit(cov_type="bias_reduced")
    slopes, errors = np.asarray(fit.params)[1:], np.asarray(fit.bse)[1:]
    if not (fit.converged and np.isfinite(slopes).all() and np.isfinite(errors).all()):
        return Lacking(ESTIMATE, 1, 0)
    half = stats.t.ppf((1 + LEVEL) / 2, len(np.unique(table.person)) - predictors.shape[1]) * errors
    own, typical = (
        OddsRatio(*np.exp(STEP * np.array([slope, slope - wide, slope + wide])).tolist())
        for slope, wide in zip(slopes, half, strict=True)
    )
    return own, typical
