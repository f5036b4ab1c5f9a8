"""What a trial type has to know, and nothing else does."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, ClassVar, Protocol

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    import numpy as np
    from numpy.typing import NDArray

    from ...store.runs_tables import Trial
    from .answer_bodies import AnswerBody
    from .walk import Walk

    Later = Callable[[], "Faces"]
    """Works faces out of what a transaction saw, once that is over: a search may learn for long. Raises EmogenError
    where the search cannot go on so, which whoever takes the answer will say."""

Faces = list[tuple[str, "NDArray[np.float64]"]]
"""Faces as head and genes (G,), for the correction to know ahead."""


class TrialType(Protocol):
    """One kind of task. Stateless: everything about a trial is in its rows."""

    KIND: ClassVar[str]
    ANSWERS: ClassVar[Mapping[str, frozenset[str]]]
    """The steps of a participation at which a trial of this type is on the screen, and the kinds of answers to each."""
    WRITES: ClassVar[tuple[str, ...]]
    """Tables of the export that it writes."""

    def enter(self, walk: Walk, trial: Trial) -> bool:
        """Put a trial on the screen and set the participation's step; False when there is nothing to do in it."""
        ...

    def state(self, walk: Walk, trial: Trial) -> dict[str, Any]:
        """Return the part of the state that the page of this trial is told."""
        ...

    def take(self, walk: Walk, trial: Trial, body: AnswerBody) -> None:
        """Apply an answer to the trial that is on the screen.

        Raises:
            InvalidError: not acceptable; nothing may be stored.
            StaleStepError: not for what is on the screen.
        """
        ...

    def rehearsed(self, walk: Walk, trial: Trial, body: AnswerBody | None) -> Later | None:
        """Return the faces that an answer will put on the screen, or without one those that the trial begins with.

        None where an answer makes none in this trial.
        """
        ...

    def concluded(self, walk: Walk, trial: Trial, body: AnswerBody) -> Later | None:
        """Return the faces that an answer which ends the trial has stored but not shown; None where it has none."""
        ...

    def played(self, told: Mapping[str, Any]) -> dict[str, Any]:
        """Return the answer of a simulated participant to a state, but for what needs a face in mind."""
        ...
