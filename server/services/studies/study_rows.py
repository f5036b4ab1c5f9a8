"""Rows of what an experimenter sets up, made in one place."""

from __future__ import annotations

import secrets
from typing import TYPE_CHECKING, Literal

from ...store.studies_tables import Link, StudyVersion
from ..clock import new_id, now

if TYPE_CHECKING:
    from ..config import StudyConfig

LinkKind = Literal["general_multiple", "general_single", "personal"]


def new_version(study_id: str, number: int, config: StudyConfig, user: str | None) -> StudyVersion:
    """Return a version of a study."""
    return StudyVersion(
        id=new_id(),
        study_id=study_id,
        number=number,
        config=config.canonical(),
        config_hash=config.hash(),
        author_id=user,
        created_at=now(),
    )


def new_link(study_id: str, kind: LinkKind, label: str) -> Link:
    """Return an address by which people join a study."""
    return Link(id=secrets.token_urlsafe(12), study_id=study_id, kind=kind, label=label, created_at=now())
