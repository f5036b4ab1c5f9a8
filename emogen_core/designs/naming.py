"""Simulated people who make faces, are shown faces of others, and say of which emotion these are."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from scipy.special import expit

from emogen_core.analysis.distances import cosine_matrix
from emogen_core.analysis.matching import Judgements
from emogen_core.analysis.recorded import joined
from emogen_core.designs.population import names, recorded
from emogen_core.simulation.runs import Elites

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from emogen_core.analysis.recorded import Faces
    from emogen_core.designs.population import Population

    Floats = NDArray[np.float64]
    Places = NDArray[np.intp]

EMOTIONS = ("happy", "angry")
POOL = 200
_SEED = 300


@dataclass(frozen=True, slots=True)
class Answering:
    """By what people answer.

    Attributes:
        own, typical: by how much the log odds of yes grow with the similarity to the face that the person has in mind,
            and to the mean of everybody's.
        readiness: standard deviation over people of how readily they say yes.
    """

    own: float = 0.0
    typical: float = 0.0
    readiness: float = 1.0


@dataclass(frozen=True, eq=False)
class Pool:
    """Two hundred people with a face of their own in mind for each emotion, and what they made.

    Attributes:
        meant: emotion -> (POOL, K) weights of the faces in mind.
        made: emotion -> what the searches for them ended with.
    """

    meant: Mapping[str, NDArray[np.float32]]
    made: Mapping[str, Elites]

    def study(
        self, rng: np.random.Generator, people: int, answering: Answering, shown: int = 8, *, show_own: bool = False
    ) -> tuple[Judgements, Faces]:
        """Return judgements and own faces of people drawn from the pool.

        Args:
            rng: of this study.
            people: how many.
            answering: by what they answer.
            shown: faces of others that each of them sees for each emotion.
            show_own: whether they also see the face that they made.
        """
        who = rng.choice(POOL, people, replace=False)
        readily = answering.readiness * rng.normal(size=people)
        judged = []
        for emotion in EMOTIONS:
            odds = readily[:, None] + self._odds(emotion, who, answering)
            for person, name in enumerate(names(people).tolist()):
                seen = rng.choice(np.setdiff1d(np.arange(POOL), who[person]), shown, replace=False)
                seen = np.append(seen, who[person]) if show_own else seen
                named = rng.random(len(seen)) < expit(odds[person, seen])
                judged.append(self._judged(name, emotion, seen, named))
        own = [recorded(_of(self.made[emotion], who), emotions=emotion) for emotion in EMOTIONS]
        return _together(judged), joined(*own)

    def _odds(self, emotion: str, who: Places, answering: Answering) -> Floats:
        """Return the (people, POOL) log odds that somebody names a face, apart from how readily they do."""
        meant, shown = self.meant[emotion], self.made[emotion].final
        alike = 1 - cosine_matrix(meant[who], shown)
        common = 1 - cosine_matrix(meant.mean(0)[None], shown)
        odds: Floats = answering.own * (alike - alike.mean()) + answering.typical * (common - common.mean())
        return odds

    def _judged(self, name: str, emotion: str, seen: Places, named: NDArray[np.bool_]) -> Judgements:
        weights = self.made[emotion].final[seen].astype(np.float64)
        return Judgements(np.full(len(seen), name), np.full(len(seen), emotion), weights, named)


def pool(population: Population) -> Pool:
    """Return the people of a population who make a face for each emotion."""
    minds = {emotion: population.templates(emotion, POOL) for emotion in EMOTIONS}
    meant = {emotion: population.laboratory.faces(one) for emotion, one in minds.items()}
    made = {emotion: population.searches(minds[emotion], _SEED + i) for i, emotion in enumerate(EMOTIONS)}
    return Pool(meant, made)


def _of(elites: Elites, who: Places) -> Elites:
    return Elites(elites.genes[who], elites.weights[who], elites.right[who], elites.ended[who])


def _together(judged: list[Judgements]) -> Judgements:
    fields = ("people", "emotions", "weights", "named")
    return Judgements(*(np.concatenate([getattr(one, field) for one in judged]) for field in fields))
