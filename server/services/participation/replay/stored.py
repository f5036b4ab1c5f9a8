"""Replays what the database has."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from ....store import runs, studies
from ...config.stored import own_config
from ...errors import NotFoundError, ServiceError
from .comparison import Comparison
from .recorded import Recorded, Replayed, Seat

if TYPE_CHECKING:
    from ....store.runs_tables import Participation
    from ..journal import Journal


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
        # Fitting a head takes seconds, and so does the search: not inside a transaction.
        recorded = self._recorded(participation_id)
        return Comparison(self.journal.rig_of(recorded.config), self.journal.wardrobe).of(recorded)

    def checked(self, participation_id: str) -> tuple[Replayed | None, str | None]:
        """Replay one participation for a page: what it covered, or why it cannot be replayed here."""
        try:
            return self.participation(participation_id), None
        except ServiceError as error:
            return None, error.message

    def _recorded(self, participation_id: str) -> Recorded:
        with self.journal.database.read() as tx:
            participation = runs.participation(tx, participation_id)
            if participation is None:
                raise NotFoundError("There is no such participation.", got=participation_id)
            config = own_config(tx, participation)
            expected = self.journal.rig_of(config).hash
            if participation.rig_hash != expected:
                raise other_rig(expected, participation.rig_hash)
            trials = [(trial, runs.generations_with_faces(tx, trial.id)) for trial in runs.trials(tx, participation.id)]
            estimates = {one.trial_id: one for one in runs.estimates(tx, participation.id)}
            return Recorded(
                participation.id, participation.seed, config, _seat(participation),
                participation.outcome == "complete", "all", trials, estimates,
            )  # fmt: skip


def _seat(participation: Participation) -> Seat | None:
    """Return where somebody sat; erasing gives that up with everything else."""
    if participation.erased_at is not None:
        return None
    return Seat(participation.head, participation.order_row, tuple(participation.trial_order))


def other_rig(expected: str, got: str) -> NotFoundError:
    """Return the error of a record that was made on another face model."""
    return NotFoundError(
        "This participation was recorded on another face model.", field="rig_hash", expected=expected, got=got
    )
