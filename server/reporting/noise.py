"""The noise of a study's own search: which searches it has, and where each is simulated."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING

from emogen_core.simulation.evaluation.laboratory import Laboratory

from ..services.trials.evolution import simulated

if TYPE_CHECKING:
    from emogen_core.face.rig import Rig
    from emogen_core.simulation.evaluation.specs import ResultName

    from ..services.config import StudyConfig


def search_key(config: StudyConfig) -> str:
    """Return what the noise depends on: studies with the same key have the same search."""
    return json.dumps([config.search.model_dump(mode="json"), config.generations, config.minimum, config.maximum])


def laboratory(rig: Rig, config: StudyConfig, seed: int, result: ResultName = "elite") -> Laboratory:
    """Return where a study's own search is simulated, and with which result of it.

    Raises:
        InvalidError: the study's options do not fit the rig.
    """
    params, drawn = simulated(rig, config)
    how = config.search.strategy
    return Laboratory(rig, rig.identities[0], seed, params, drawn=drawn, algorithm=how, result=result)
