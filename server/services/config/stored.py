"""Studies as the database has them: the configuration of a version, parsed once."""

from __future__ import annotations

import threading
from typing import TYPE_CHECKING

from ...store import studies
from ..errors import NoStudyError, NotFoundError
from .study import StudyConfig

if TYPE_CHECKING:
    from ...store.engine import Tx
    from ...store.runs_tables import Participation
    from ...store.studies_tables import StudyVersion


def own_config(tx: Tx, participation: Participation) -> StudyConfig:
    """Return the study as a participation has it: its version, in its condition."""
    return config_of(tx, participation.version_id, participation.condition)


def config_of(tx: Tx, version_id: str, condition: str | None = None) -> StudyConfig:
    """Return the study of a version, in a condition if one is named.

    Raises:
        NotFoundError: no such version.
    """
    with _lock:
        found = _known.get((version_id, condition))
    if found is not None:
        return found
    version = studies.version(tx, version_id)
    if version is None:
        raise NotFoundError("This version of the study is not there.")
    return parsed(version, condition)


def newest(tx: Tx, study_id: str) -> StudyConfig:
    """Return a study as it is now.

    Raises:
        NotFoundError: no such study.
    """
    version = studies.latest_version(tx, study_id)
    if version is None:
        raise NoStudyError(study_id)
    return parsed(version)


def parsed(version: StudyVersion, condition: str | None = None) -> StudyConfig:
    """Return what the row of a version says, in a condition if one is named."""
    key = (version.id, condition)
    with _lock:
        if key in _known:
            return _known[key]
    config = StudyConfig.model_validate(version.config)
    made = config if condition is None else config.in_condition(condition)
    with _lock:
        while len(_known) >= REMEMBERED:
            _known.pop(next(iter(_known)))
        _known[key] = made
    return made


REMEMBERED = 256
# Versions never change, and their ids are random: what was read once holds for this process.
_known: dict[tuple[str, str | None], StudyConfig] = {}
_lock = threading.Lock()
