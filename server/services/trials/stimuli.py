"""Which faces a person is shown to judge: their own, those of others, means, and faces that the study brings along.

Looking through everybody's faces takes long in a large study. It is done while an answer is rehearsed; the write
transaction takes what was found (`Walk.ahead`), unless somebody was erased in between.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from ...store import judged, runs
from ..config import Evolve
from ..faces.sketch import unpack_genes

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

    from numpy.typing import NDArray

    from ...store.runs_tables import Trial
    from ..config import Faces
    from .walk import Walk


@dataclass(frozen=True, slots=True, eq=False)
class Shown:
    """A face to be judged.

    Attributes:
        source: own, others, means or named.
        name: the face behind it, or the name that the study has for it.
        emotion: what it is meant to show.
        identity: the head.
        genes: (G,), in the rig's order.
        made_from: ids of the finished faces behind it.
    """

    source: str
    name: str
    emotion: str
    identity: str
    genes: NDArray[np.float64]
    made_from: tuple[str, ...] = ()


def chosen(walk: Walk, trial: Trial, faces: Faces) -> list[Shown]:
    """Return the faces of a trial in their random order, which follows from the trial's seed."""
    _check_ahead(walk)
    rng = np.random.Generator(np.random.PCG64(int(trial.seed)))
    found = [face for source in faces.sources for face in _FROM[source](walk, trial, faces, rng)]
    return [found[i] for i in np.argsort(rng.random(len(found)), kind="stable")]


def _own(walk: Walk, trial: Trial, faces: Faces, rng: np.random.Generator) -> Iterator[Shown]:  # noqa: ARG001
    for emotion, face in judged.own_faces(walk.tx, trial.participation_id, _block(walk, faces)):
        yield Shown("own", face.id, emotion, face.identity, unpack_genes(face.genes), (face.id,))


def _others(walk: Walk, trial: Trial, faces: Faces, rng: np.random.Generator) -> Iterator[Shown]:
    for emotion, identity in _pairs(walk, trial, faces):
        candidates = _found(walk, judged.others_faces, _block(walk, faces), emotion, identity)
        chosen_ids = _least_shown(candidates, faces.others, rng)
        genes = {face.id: face.genes for face in runs.faces(walk.tx, chosen_ids)}
        for face_id in filter(genes.__contains__, chosen_ids):
            yield Shown("others", face_id, emotion, identity, unpack_genes(genes[face_id]), (face_id,))


def _means(walk: Walk, trial: Trial, faces: Faces, rng: np.random.Generator) -> Iterator[Shown]:  # noqa: ARG001
    for emotion, identity in _pairs(walk, trial, faces):
        made = _found(walk, judged.genes_of_others, _block(walk, faces), emotion, identity)
        if len(made) >= faces.least:
            mean = np.mean([unpack_genes(genes) for _, genes in made], axis=0)
            yield Shown("means", f"mean of {emotion}", emotion, identity, mean, tuple(face for face, _ in made))


def _named(walk: Walk, trial: Trial, faces: Faces, rng: np.random.Generator) -> Iterator[Shown]:  # noqa: ARG001
    rig = walk.evolution.rig
    for head in [trial.identity] if trial.identity else walk.config.heads:
        for face in faces.named:
            genes = np.zeros(len(rig.genes))
            genes[rig.gene_indices(tuple(face.genes))] = list(face.genes.values())
            yield Shown("named", face.name, face.emotion, head, genes)


_ERASED = ("erased",)
_FROM = {"own": _own, "others": _others, "means": _means, "named": _named}


def _block(walk: Walk, faces: Faces) -> str:
    evolved = (block.name for block in walk.config.steps if isinstance(block, Evolve))
    return faces.of or next(evolved)


def _pairs(walk: Walk, trial: Trial, faces: Faces) -> list[tuple[str, str]]:
    """Return the emotions and heads that this person made faces for: what the others' faces have to match."""
    return list(judged.pairs_made(walk.tx, trial.participation_id, _block(walk, faces), walk.ending))


def _found(walk: Walk, look: Callable[..., Sequence[Any]], *where: str) -> Sequence[Any]:
    """Return what a query on the faces of others finds, or found when this answer was rehearsed."""
    key = (look.__name__, *where)
    found: Sequence[Any] | None = walk.ahead.get(key)
    if found is None:
        found = walk.ahead[key] = look(walk.tx, walk.participation, *where)
    return found


def _check_ahead(walk: Walk) -> None:
    """Forget what was found before somebody was erased: their faces are gone."""
    erased = judged.erased(walk.tx, walk.participation.study_id)
    if walk.ahead.get(_ERASED) != erased:
        walk.ahead.clear()
        walk.ahead[_ERASED] = erased


def _least_shown(candidates: Sequence[tuple[str, int]], count: int, rng: np.random.Generator) -> list[str]:
    """Return faces that were shown to the fewest people, those that are level in random order."""
    drawn = rng.random(len(candidates))
    order = sorted(range(len(candidates)), key=lambda i: (candidates[i][1], drawn[i]))
    return [candidates[i][0] for i in order[:count]]
