"""What a study says about itself, and what comes in it, by the names that the participant's templates use."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from ..config import Attention, Evolve
from ..config.parts import LEAST_HEIGHT, LEAST_WIDTH
from ..trials.evolve import may_end_early
from .order import emotions_of

if TYPE_CHECKING:
    from ..config import Spoken, StudyConfig

EXAMPLES = ("surprised", "disgusted", "fearful", "happy", "sad", "angry")
"""Emotions for the worked example, the one that its pictures show best first."""


def study_words(config: StudyConfig, spoken: Spoken) -> dict[str, Any]:
    """Return what the pages of a study in one language are made from beside the state."""
    return {
        **spoken.texts.model_dump(),
        "title": spoken.title,
        "generations": config.generations,
        "open": may_end_early(config),
        "practice": config.practice is not None,
        "example": _example(config),
        "emotions": [emotion.model_dump() for emotion in config.emotions],
        "ratings": list(config.ratings),
        "minimum": config.minimum,
        "maximum": config.maximum,
        "parts": _parts(config),
        "asks": _asks(config),
        "recorded": _recorded(config),
        "needs": _needs(config),
    }


def _example(config: StudyConfig) -> str | None:
    """Return the adjective of an emotion that is not in the study."""
    practised = [config.practice.adjective] if config.practice else []
    taken = {emotion.adjective for emotion in config.emotions}
    return next((one for one in (EXAMPLES[0], *practised, *EXAMPLES) if one not in taken), None)


def _parts(config: StudyConfig) -> list[dict[str, Any]]:
    """Return what comes, in order: kind of block and, where it is known, how many faces are made; no checks."""
    heads = len(config.heads) if config.head_assignment == "within" else 1
    told: list[dict[str, Any]] = []
    for block in config.steps:
        if isinstance(block, Evolve):
            kind = "again" if block.retest_of else "evolve"
            told.append({"kind": kind, "faces": len(emotions_of(config, block)) * heads})
        elif not isinstance(block, Attention):
            told.append({"kind": block.kind, "faces": 0})
    return told


def _asks(config: StudyConfig) -> str:
    """Return which questions are asked: both usual ones of each finished face, others, or none."""
    others = [block for block in config.steps if not isinstance(block, Evolve)]
    if others or len(config.ratings) == 1:
        return "questions"
    return "ratings" if config.ratings else ""


def _recorded(config: StudyConfig) -> list[str]:
    """Return what is recorded beside answers: names of sentences."""
    told = ["screen"]
    told += ["size"] if config.devices.face_degrees else []
    told += ["browser"] if config.user_agent else []
    told += ["recruiter"] if config.recruiter_parameters else []
    return told


def _needs(config: StudyConfig) -> dict[str, Any]:
    devices = config.devices
    large = devices.least_width > LEAST_WIDTH or devices.least_height > LEAST_HEIGHT
    return {"phones": devices.phones, "large": large, "width": devices.least_width, "height": devices.least_height}
