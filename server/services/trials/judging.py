"""Trials in which faces are judged: which faces they are, as weights of their own."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, ClassVar

from ...store import runs
from ...store.runs_tables import Stimulus
from ..clock import new_id, now
from ..faces.sketch import pack_genes, pack_weights
from .items import Items
from .stimuli import chosen

if TYPE_CHECKING:
    from ...store.runs_tables import Trial
    from ..config import Categorise, Rate
    from .answer_bodies import AnswerBody
    from .base import Later
    from .stimuli import Shown
    from .walk import Walk


class Judging(Items):
    """What rate and categorise share."""

    WRITES: ClassVar[tuple[str, ...]] = ("stimuli", "responses")
    BLOCK: type[Rate] | type[Categorise]
    TELLS_EMOTION: ClassVar[bool]

    def enter(self, walk: Walk, trial: Trial) -> bool:
        """Choose the faces, keep them, and put the first one on the screen."""
        faces = chosen(walk, trial, walk.block(trial, self.BLOCK).faces)
        runs.add_all(walk.tx, [_row(walk, trial, item, face) for item, face in enumerate(faces)])
        super().enter(walk, trial)
        if not faces:
            trial.ended_at = trial.started_at = now()
        return bool(faces)

    def told(self, walk: Walk, trial: Trial) -> dict[str, Any]:
        """Return the emotion that the face was made for, where the page may know it."""
        if not self.TELLS_EMOTION:
            return {}
        meant = runs.stimuli(walk.tx, trial.id)[trial.generation].emotion
        known = {emotion.adjective: emotion for emotion in walk.config.emotions}
        return {"emotion": meant, "noun": known[meant].noun if meant in known else meant}

    def rehearsed(self, walk: Walk, trial: Trial, body: AnswerBody | None) -> Later | None:
        """Return the faces that have to be corrected: means and named ones."""
        if body is not None:
            return None
        faces = [(face.identity, face.genes) for face in chosen(walk, trial, walk.block(trial, self.BLOCK).faces)]
        return lambda: faces


def _row(walk: Walk, trial: Trial, item: int, face: Shown) -> Stimulus:
    made = walk.evolution.face(face.identity, face.genes)
    row = Stimulus(
        id=new_id(),
        trial_id=trial.id,
        item=item,
        source=face.source,
        name=face.name,
        emotion=face.emotion,
        identity=face.identity,
        made_from=list(face.made_from),
        genes=pack_genes(face.genes),
        weights=pack_weights(made.weights),
        portrait_key=made.key,
    )
    walk.offered.append(row)
    return row
