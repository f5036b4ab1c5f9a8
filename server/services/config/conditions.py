"""Conditions: named changes to a study, and the whole study that each of them makes."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any

from pydantic import StringConstraints

from .base import Part, option

if TYPE_CHECKING:
    from .study import StudyConfig

FIXED = frozenset(
    {"conditions", "quota", "lease_minutes", "head_assignment", "assignment", "recruiter_parameters", "language"}
)
"""What all conditions of a study share, since it is needed before a participant has one."""


class Condition(Part):
    """One cell of a between-person design."""

    name: Annotated[str, StringConstraints(pattern=r"^[A-Za-z0-9][\w .-]{0,39}$")] = option(
        ..., "Name", "The condition in the data."
    )
    quota: int | None = option(None, "Quota", "Most people in it. Empty: no limit.", ge=1, le=1_000_000)
    changes: dict[str, Any] = option(dict, "Changes", "Fields of the study that are different here.")


def in_condition(study: StudyConfig, condition: Condition) -> dict[str, Any]:
    """Return the plain data of the study that somebody in a condition takes part in."""
    return laid_over({**study.canonical(), "conditions": []}, condition.changes)


def laid_over(below: dict[str, Any], above: dict[str, Any]) -> dict[str, Any]:
    """Return plain data with changes: objects are laid over each other, everything else is replaced."""
    merged = dict(below)
    for name, value in above.items():
        nested = isinstance(value, dict) and isinstance(merged.get(name), dict)
        merged[name] = laid_over(merged[name], value) if nested else value
    return merged
