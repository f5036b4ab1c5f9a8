"""Reading a participation, its events, and its early end."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import timedelta
from typing import TYPE_CHECKING, Any

from ...store import runs
from ...store.runs_tables import Event
from ..clock import new_id, now
from ..config import Spoken, StudyConfig, in_language  # dataclass fields
from ..errors import ForbiddenError, InvalidError
from ..faces.sketch import unpack_weights
from .returning import proven, wanted_proof
from .self_description import study_words
from .withdrawal import erase_rows

if TYPE_CHECKING:
    from collections.abc import Sequence

    from ...store.engine import Tx
    from ...store.runs_tables import Face, Generation, Participation
    from ..trials.answer_bodies import EventBody
    from .journal import Journal

WARNED = 6
"""The page asks whether somebody is there in the last sixth of a lease: after 25 of 30 minutes."""


@dataclass(frozen=True, slots=True)
class Lease:
    """How long a place is kept, and how many seconds before its end to ask whether somebody is there."""

    seconds: int
    warning: int


@dataclass(frozen=True, slots=True)
class PageView:
    """What a page is made from: the state, and the study's own words."""

    state: dict[str, Any]
    config: StudyConfig
    language: str
    preview: str | None = None
    """The study, where this is an experimenter's preview."""
    lease: Lease | None = None
    """How long the place is kept, while the participation runs."""
    proof: str | None = None
    """What a browser must have to erase, where the address can be had by an id that others may know."""

    def may_erase(self, shown: str | None) -> bool:
        """Return whether a browser that shows this proof may erase what was given."""
        return proven(self.proof, shown)

    @property
    def spoken(self) -> Spoken:
        """The study's own words in the participant's language."""
        return in_language(self.config, self.language)

    @property
    def study(self) -> dict[str, Any]:
        """What the study says about itself, by the names that the templates use."""
        return study_words(self.config, self.spoken)

    @property
    def running(self) -> bool:
        """Whether there is something to answer yet."""
        return "completion" not in self.state


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
            state = self.journal.walk(tx, participation, config).state()
            preview = participation.study_id if participation.preview else None
            lease = None if participation.outcome else _lease(participation, config)
            proof = wanted_proof(tx, token, participation, config)
            return PageView(state, config, participation.language, preview, lease, proof)

    def lease(self, token: str) -> Lease:
        """Return how long a place is kept; nothing changes.

        Raises:
            NotFoundError: unknown token.
        """
        with self.journal.database.read() as tx:
            return _lease(*self.journal.find(tx, token))

    def renew_lease(self, token: str) -> Lease:
        """Keep a place for as long as after an answer; one that has ended stays as it is.

        Raises:
            NotFoundError: unknown token.
        """
        with self.journal.database.write() as tx:
            participation, config = self.journal.find(tx, token, lock=True)
            if participation.outcome is None:
                participation.lease_until = now() + timedelta(minutes=config.lease_minutes)
            return _lease(participation, config)

    def new_answer_id(self) -> str:
        """Return an id for the answer of a page without script."""
        return new_id()

    def weights(
        self, ids: Sequence[str], study_id: str | None = None
    ) -> tuple[dict[str, list[float]], tuple[str, ...]]:
        """Return the weights of faces that simulated participants were offered, by id, and the hashes of their rigs.

        Other ids are left out.

        Args:
            ids: the faces.
            study_id: the study that they have to be of, if it matters.
        """
        with self.journal.database.read() as tx:
            faces = runs.simulated_faces(tx, ids, study_id)
            weights = {face.id: unpack_weights(face.weights).tolist() for face, _ in faces}
            return weights, tuple(sorted({rig_hash for _, rig_hash in faces}))

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

    def stop(self, token: str, *, erase: bool, proof: str | None = None) -> dict[str, Any]:
        """End a participation early, or erase it even after its end; return the state.

        Raises:
            NotFoundError: unknown token.
            ForbiddenError: to erase this one takes the browser in which it was begun.
        """
        portraits: set[str] = set()
        with self.journal.database.write() as tx:
            participation, config = self.journal.find(tx, token, lock=True)
            walk = self.journal.walk(tx, participation, config)
            if erase:
                _check_proof(wanted_proof(tx, token, participation, config), proof)
                portraits = erase_rows(walk)
            elif participation.outcome is None:
                walk.finish("stopped")
            tx.flush()
            state = walk.state()
        self.journal.portraits.discard(portraits)
        return state


def _check_proof(wanted: str | None, shown: str | None) -> None:
    if not proven(wanted, shown):
        raise ForbiddenError(
            "Your answers can be erased in the browser in which you began, or by whoever runs the study with your"
            " withdrawal code.",
            field="erase",
            expected="the browser in which this participation was begun",
        )


def _lease(participation: Participation, config: StudyConfig) -> Lease:
    until = participation.lease_until if participation.outcome is None else None
    left = 0 if until is None else max(0, round((until - now()).total_seconds()))
    return Lease(left, config.lease_minutes * 60 // WARNED)


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
