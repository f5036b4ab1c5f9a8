"""Withdrawal: a participant's answers go, a row stays that says that somebody was here and withdrew.

What goes: every row of what they did, the recruiter's parameters, the device, the seed, the order of trials and its row
in the Latin square, the withdrawal code, the report of the study, which was counted with them, and the pictures that no
other row names, from memory and from the folder of portraits. What stays: number, times of arrival and end, condition,
head, language, the link, whose numbers add up, the completion code, for which somebody may yet be paid, and the hash of
the address, by which their own page can say that they were erased.
Pictures that were drawn ahead and never offered stay in the cache; nothing says whose they might have been.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from ...store import analyses, roster, runs
from ..clock import new_code
from ..config.stored import own_config
from ..errors import InvalidError, NotFoundError
from ..naming import name_of
from ..people.accounts import audit

if TYPE_CHECKING:
    from ...store.engine import Tx
    from ...store.runs_tables import Participation
    from ..trials.walk import Walk
    from .journal import Journal


@dataclass(frozen=True, slots=True)
class Erasure:
    """What erasing somebody would take away."""

    number: int
    name: str
    running: bool
    answers: int
    portraits: int


@dataclass(frozen=True)
class Withdrawals:
    """Erases people."""

    journal: Journal

    def number_of(self, study_id: str, code: str) -> int:
        """Return the number of the participant who has a withdrawal code.

        Raises:
            NotFoundError: nobody in this study has it, or they were erased before.
        """
        with self.journal.database.read() as tx:
            found = runs.participation_by_withdrawal(tx, code.strip().upper())
            if found is None or found.study_id != study_id or found.preview or found.erased_at is not None:
                raise NotFoundError("No participation has this withdrawal code. Check that it was typed as a whole.")
            return found.number

    def preview(self, study_id: str, number: int) -> Erasure:
        """Return what would be erased.

        Raises:
            NotFoundError: no such participant.
            InvalidError: they were erased before.
        """
        with self.journal.database.read() as tx:
            found = _found(tx, study_id, number)
            answers = roster.number_of_answers(tx, found.id)
            portraits = len(roster.portrait_keys(tx, found.id))
            return Erasure(number, name_of(number), found.outcome is None, answers, portraits)

    def erase(self, study_id: str, number: int, user: str | None) -> str:
        """Erase a participant, also one who is still taking part; return their id.

        Raises:
            NotFoundError: no such participant.
            InvalidError: they were erased before.
        """
        with self.journal.database.write() as tx:
            participation = _found(tx, study_id, number, lock=True)
            config = own_config(tx, participation)
            portraits = erase_rows(self.journal.walk(tx, participation, config))
            audit(tx, user, "erase participation", participation.id)
            participation_id = participation.id
        self.journal.portraits.discard(portraits)
        return participation_id


def erase_rows(walk: Walk) -> set[str]:
    """Leave a tombstone; return the portraits that no row names any more."""
    participation = walk.participation
    if participation.erased_at is not None:
        return set()
    portraits = roster.portrait_keys(walk.tx, participation.id)
    runs.erase_content(walk.tx, participation.id)
    code = participation.completion_code
    walk.finish("erased")
    participation.completion_code = code
    participation.erased_at = participation.ended_at
    participation.recruiter, participation.device, participation.trial_order = {}, {}, []
    participation.seed, participation.order_row = "0", None
    participation.withdrawal_code = new_code()  # the column wants one; nobody has been told this one
    if not participation.preview:
        analyses.forget(walk.tx, participation.study_id)
    return portraits - roster.named_portraits(walk.tx, portraits)


def _found(tx: Tx, study_id: str, number: int, *, lock: bool = False) -> Participation:
    found = roster.person(tx, study_id, number, lock=lock)
    if found is None:
        raise NotFoundError("This study has no such participant.", field="number", got=number)
    if found[0].erased_at is not None:
        raise InvalidError("This participant was erased before.", field="number", got=number)
    return found[0]
