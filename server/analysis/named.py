"""What people named the faces as that were meant for an emotion."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING

import numpy as np

from emogen_core.analysis.matching import Judgements

from ..services.participation.recorded_export import matrix

if TYPE_CHECKING:
    from collections.abc import Collection

    from emogen_client import Export
    from emogen_core.face.rig import Rig


def judgements(export: Export, rig: Rig, people: Collection[str]) -> Judgements:
    """Return the labels that people gave; none in a study without categorise trials."""
    stimuli = export.arrow("stimuli")
    weights = matrix(stimuli, "weight_", rig.shape_names)
    meant = np.array(stimuli["meant"].fill_null("").to_pylist(), str)
    place = {name: at for at, name in enumerate(stimuli["stimulus"].to_pylist()) if meant[at]}
    labels = _labels(export, people, place)
    at = np.array([place[stimulus] for _, stimulus, _ in labels], np.intp)
    named = [emotion in said for emotion, (_, _, said) in zip(meant[at].tolist(), labels, strict=True)]
    return Judgements(np.array([who for who, _, _ in labels], str), meant[at], weights[at], np.array(named, bool))


def _labels(export: Export, people: Collection[str], stimuli: Collection[str]) -> list[tuple[str, str, list[str]]]:
    """Return who gave a stimulus which labels, of the people who count."""
    found = [
        (row["participation"], row["stimulus"], json.loads(row["value"] or "[]"))
        for row in export.arrow("responses").to_pylist()
        if row["question"] == "label" and row["participation"] in people and row["stimulus"] in stimuli
    ]
    return [one for one in found if one[2]]
