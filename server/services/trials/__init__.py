"""Trial types, one module each: what a trial is while it is on the screen (docs/study.md)."""

from __future__ import annotations

from typing import TYPE_CHECKING

from . import attention, categorise, evolve, questionnaire, rate

if TYPE_CHECKING:
    from ...store.runs_tables import Trial
    from .base import TrialType

TYPES: dict[str, TrialType] = {
    made.KIND: made
    for made in (
        evolve.EVOLVE,
        rate.RATE,
        categorise.CATEGORISE,
        attention.ATTENTION,
        questionnaire.QUESTIONNAIRE,
    )
}


def type_of(trial: Trial) -> TrialType:
    """Return the type of a trial."""
    return TYPES[trial.kind]


ANSWERS = {step: kinds for made in TYPES.values() for step, kinds in made.ANSWERS.items()}
"""Every step at which a trial is on the screen, and the kinds of answers to it."""
