"""Reading a participation, its events, and its early end."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from ..store import runs
from ..store.runs_tables import Event
from .accounts import audit
from .clock import digest, new_id, now
from .config import StudyConfig  # a dataclass field
from .errors import InvalidError, NotFoundError
from .evolution import unpack_weights
from .journal import config_of
from .steps import Walk

if TYPE_CHECKING:
    from collections.abc import Sequence

    from ..store.engine import Tx
    from ..store.runs_tables import Face, Generation
    from .answer_bodies import EventBody
    from .journal import Journal


@dataclass(frozen=True, slots=True)
class PageView:
    """What a page is made from: the state, and the study's own words."""

    state: dict[str, Any]
    config: StudyConfig

    @property
    def study(self) -> dict[str, Any]:
        """What the study says about itself, by the names that the templates use."""
        return study_words(self.config)


def study_words(config: StudyConfig) -> dict[str, Any]:
    """Return what a study says about itself, by the names that the templates use."""
    return {
        **config.texts.model_dump(),
        "title": config.title,
        "generations": config.generations,
        "practice": config.practice is not None,
        "example": config.practice.adjective if config.practice else "surprised",
        "emotions": [emotion.model_dump() for emotion in config.emotions],
        "ratings": list(config.ratings),
        "minimum": config.minimum,
        "maximum": config.maximum,
    }


@dataclass(frozen=True)
class Participations:
    """Everything about a running participation but its answers."""

    journal: Journal

    def state(self, token: str) -> dict[str, Any]:
        """Return the current step; nothing changes.

        Raises:
            NotFoundError: unknown token.
        """
        return self.view(token).state

    def view(self, token: str) -> PageView:
        """Return what the page of the current step is made from; nothing changes.

        Raises:
            NotFoundError: unknown token.
        """
        with self.journal.database.read() as tx:
            participation, config = self.journal.find(tx, token)
            return PageView(Walk(tx, participation, config, self.journal.evolution(config)).state(), config)

    def running(self, token: str) -> bool:
        """Return whether a token leads to a participation that was not erased."""
        with self.journal.database.read() as tx:
            found = runs.participation_by_token(tx, digest(token))
            return found is not None and found.erased_at is None

    def new_answer_id(self) -> str:
        """Return an id for the answer of a page without script."""
        return new_id()

    def weights(self, ids: Sequence[str]) -> dict[str, list[float]]:
        """Return the weights of faces by id, for simulated participants; unknown ids are left out."""
        with self.journal.database.read() as tx:
            return {face.id: unpack_weights(face.weights).tolist() for face in runs.faces(tx, ids)}

    def events(self, token: str, events: Sequence[EventBody]) -> int:
        """Store what the page saw, each event once; return how many were new.

        Raises:
            NotFoundError: unknown token.
            InvalidError: an event of a generation or face that this participation did not see; nothing is stored.
        """
        with self.journal.database.write() as tx:
            participation, _ = self.journal.find(tx, token, lock=True)
            if participation.erased_at is not None:
                return 0
            known = runs.known_events(tx, participation.id, [str(event.id) for event in events])
            fresh = {str(event.id): event for event in events if str(event.id) not in known}
            seen = _Seen(tx, participation.id)
            runs.add_all(tx, [seen.row(event) for event in fresh.values()])
            return len(fresh)

    def stop(self, token: str, *, erase: bool) -> dict[str, Any]:
        """End a participation early, or erase it even after its end; return the state.

        Raises:
            NotFoundError: unknown token.
        """
        with self.journal.database.write() as tx:
            participation, config = self.journal.find(tx, token, lock=True)
            walk = Walk(tx, participation, config, self.journal.evolution(config))
            if erase:
                _erase(walk)
            elif participation.outcome is None:
                walk.finish("stopped")
            tx.flush()
            return walk.state()

    def withdraw(self, code: str, study_id: str, user: str | None = None) -> str:
        """Erase the participation of a study that has a withdrawal code; return its id.

        Raises:
            NotFoundError: unknown code.
        """
        with self.journal.database.write() as tx:
            participation = runs.participation_by_withdrawal(tx, code.strip().upper())
            if participation is None or participation.study_id != study_id:
                raise NotFoundError("No participation has this withdrawal code. Check that it was typed as a whole.")
            config = config_of(tx, participation.version_id)
            _erase(Walk(tx, participation, config, self.journal.evolution(config)))
            audit(tx, user, "erase participation", participation.id)
            return participation.id


def _erase(walk: Walk) -> None:
    """Leave a tombstone: that somebody was here and withdrew, nothing of what they did."""
    participation = walk.participation
    if participation.erased_at is not None:
        return
    runs.erase_content(walk.tx, participation.id)
    code = participation.completion_code
    walk.finish("erased")
    participation.completion_code = code
    participation.erased_at = participation.ended_at
    participation.recruiter, participation.seed = {}, "0"


class _Seen:
    """Finds the generations and faces that events name, each once."""

    def __init__(self, tx: Tx, participation_id: str) -> None:
        self._tx = tx
        self._participation = participation_id
        self._trials = {trial.id for trial in runs.trials(tx, participation_id)}
        self._generations: dict[tuple[str, int, int], Generation | None] = {}
        self._arrived = now()

    def row(self, event: EventBody) -> Event:
        """Return an event as it is stored.

        Raises:
            InvalidError: it names what this participation did not see.
        """
        generation = self._generation(event)
        if event.face is not None and self._face(event.face, generation) is None:
            raise InvalidError(
                "An event names a face of another generation.",
                field="face",
                expected="a face of the event's generation",
                got=event.face,
            )
        return Event(
            participation_id=self._participation,
            id=str(event.id),
            generation_id=generation.id,
            face_id=event.face,
            type=event.type,
            at_ms=event.at_ms,
            duration_ms=event.duration_ms,
            arrived_at=self._arrived,
        )

    def _generation(self, event: EventBody) -> Generation:
        key = (event.trial, event.attempt, event.generation)
        if key not in self._generations:
            own = event.trial in self._trials
            self._generations[key] = runs.generation_of(self._tx, *key) if own else None
        found = self._generations[key]
        if found is None:
            raise InvalidError(
                "An event names a generation that this participation has not seen.",
                field="generation",
                expected="a generation that was shown",
                got=f"{event.trial}, attempt {event.attempt}, generation {event.generation}",
            )
        return found

    def _face(self, face_id: str, generation: Generation) -> Face | None:
        face = runs.face(self._tx, face_id)
        return face if face is not None and face.generation_id == generation.id else None
