"""Does the record tell the truth? Every generation is made again from seeds and choices and compared bit for bit."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from emogen_core.search import Choice, State, place_order, strategy

from ..store import runs, studies
from .errors import NotFoundError
from .evolution import params_of, unpack_genes, unpack_weights
from .journal import config_of

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from ..store.engine import Tx
    from ..store.runs_tables import ChoiceRecord, Face, Generation, Participation, Trial
    from .config import StudyConfig
    from .journal import Journal


@dataclass(frozen=True, slots=True)
class Difference:
    """The first place where the record and its replay disagree."""

    participation: str
    trial: str
    attempt: int
    generation: int
    slot: int | None
    what: str
    expected: str
    got: str


@dataclass(frozen=True, slots=True)
class Replayed:
    """What a replay covered, and the first difference if there is one."""

    generations: int
    difference: Difference | None


@dataclass(frozen=True)
class Replay:
    """Replays recorded participations."""

    journal: Journal

    def study(self, study_id: str) -> Replayed:
        """Replay every participation of a study, up to the first difference.

        Raises:
            NotFoundError: no such study.
        """
        with self.journal.database.read() as tx:
            if studies.study(tx, study_id) is None:
                raise NotFoundError("There is no such study.", field="study", got=study_id)
            ids = runs.participation_ids(tx, study_id)
        count = 0
        for participation_id in ids:
            replayed = self.participation(participation_id)
            count += replayed.generations
            if replayed.difference:
                return Replayed(count, replayed.difference)
        return Replayed(count, None)

    def participation(self, participation_id: str) -> Replayed:
        """Replay one participation.

        Raises:
            NotFoundError: no such participation, or recorded on another rig.
            ConflictError: the head that it saw cannot be fitted any more.
        """
        with self.journal.database.read() as tx:
            participation = runs.participation(tx, participation_id)
            if participation is None:
                raise NotFoundError("There is no such participation.", got=participation_id)
            if participation.rig_hash != self.journal.rig.hash:
                raise NotFoundError(
                    "This participation was recorded on another face model.",
                    field="rig_hash",
                    expected=self.journal.rig.hash,
                    got=participation.rig_hash,
                )
            config, head = config_of(tx, participation.version_id), participation.condition
        # Fitting a head takes seconds: not inside a transaction.
        self.journal.wardrobe.know(config)
        self.journal.wardrobe.wait(head)
        with self.journal.database.read() as tx:
            return self._replay(tx, participation, config)

    def _replay(self, tx: Tx, participation: Participation, config: StudyConfig) -> Replayed:
        count = 0
        for trial in runs.trials(tx, participation.id):
            for difference in self._trial(tx, trial, config):
                count += 1
                if difference is not None:
                    return Replayed(count, difference)
        return Replayed(count, None)

    def _trial(self, tx: Tx, trial: Trial, config: StudyConfig) -> Iterator[Difference | None]:
        search, params = strategy(config.search.strategy), params_of(self.journal.rig, config)
        state: State | None = None
        for generation, faces, choice in runs.generations_with_faces(tx, trial.id):
            if state is None or generation.attempt != state.attempt:
                state = search.init(params, int(trial.seed), generation.attempt)
            found = self._compare(trial, config, state, (generation, faces))
            yield found and Difference(trial.participation_id, trial.id, generation.attempt, generation.number, *found)
            if choice is not None:
                state = search.tell(params, state, _told(faces, choice))

    def _compare(
        self, trial: Trial, config: StudyConfig, state: State, recorded: tuple[Generation, Sequence[Face]]
    ) -> tuple[int | None, str, str, str] | None:
        generation, faces = recorded
        if generation.number != state.generation or len(faces) != 10:
            return None, "generation", f"{state.generation}", f"{generation.number} with {len(faces)} faces"
        _, again = self.journal.evolution(config).offer(trial, state)
        places = place_order(state.seed, state.attempt, state.generation)
        for face, made in zip(faces, again, strict=True):
            for what in ("slot", "origin", "parents", "genes", "weights", *_collision_columns(face)):
                expected, got = getattr(made, what), getattr(face, what)
                if expected != got:
                    return face.slot, what, *self._told_apart(what, expected, got)
            if places[face.place - 1] != face.slot:
                return face.slot, "place", f"{places.index(face.slot) + 1}", f"{face.place}"
        return None

    def _told_apart(self, what: str, expected: Any, got: Any) -> tuple[str, str]:
        """Return two different values in words; of a vector, its first entry that differs."""
        if not isinstance(got, bytes) or len(expected) != len(got):
            return str(expected), str(got)
        rig = self.journal.rig
        names, unpack = (rig.gene_names, unpack_genes) if what == "genes" else (rig.shape_names, unpack_weights)
        size = len(got) // len(names)
        at = next(i for i in range(len(names)) if expected[i * size :][:size] != got[i * size :][:size])
        wanted, found = (f"{names[at]} = {unpack(data)[at]!r}" for data in (expected, got))
        return wanted, found


def _collision_columns(face: Face) -> tuple[str, ...]:
    """Return the columns of the collision's result; none for a face that was stored before there were any."""
    columns = ("collided_lips", "collided_teeth", "depth_before", "depth_after")
    return columns if any(getattr(face, column) is not None for column in columns) else ()


def _told(faces: Sequence[Face], choice: ChoiceRecord) -> Choice:
    slots = {face.id: face.slot for face in faces}
    return Choice(tuple(sorted(slots[face] for face in choice.selected)), slots[choice.elite_face_id])
