"""Recorded studies with known truth: simulated people on the bundled rig, and faces drawn by hand."""

from dataclasses import dataclass
from functools import cache

import numpy as np

from emogen_core.analysis.recorded import Faces
from emogen_core.designs.naming import Answering, pool
from emogen_core.designs.population import Population, names
from emogen_core.simulation.evaluation.threshold import threshold
from tests.emogen_core.simulation.evaluation.laboratories import real_laboratory


@dataclass
class Simulated:
    """Stands in for the noise of a search."""

    mean: float = 0.3
    sd: float = 0.1
    most: float = 0.5


@cache
def population():
    return Population(real_laboratory())


@cache
def noise():
    """Return the noise of the search by which these people search."""
    return threshold(real_laboratory(), 200).faithful


@cache
def templates(emotion, count):
    return population().templates(emotion, count)


@cache
def judging():
    return pool(population())


def judgements(rng, people=20, show_own=False, **answering):
    """Return judgements and own faces of simulated people who answer by what `answering` says."""
    return judging().study(rng, people, Answering(**answering), show_own=show_own)


def drawn(weights, people=None, **columns):
    """Return faces whose genes are their weights."""
    weights = np.asarray(weights, float)
    told = {"emotions": "happy", "identities": "female", "conditions": "all", "repetitions": 0} | columns
    people = names(len(weights)) if people is None else people
    return Faces(
        people, *(np.broadcast_to(told[name], len(weights)) for name in ("emotions", "identities", "conditions")),
        np.broadcast_to(told["repetitions"], len(weights)), weights, weights,
    )  # fmt: skip
