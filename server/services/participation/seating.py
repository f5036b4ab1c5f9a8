"""A participation is made: its row, its place in the design, its trials. Works inside a transaction."""

from __future__ import annotations

from datetime import timedelta
from typing import TYPE_CHECKING

from ...store import runs, studies
from ...store.runs_tables import Participation
from ...store.studies_tables import RigRecord
from ..clock import digest, new_code, new_id, new_seed, now
from ..trials.evolution import algorithm_of
from .plan import planned

if TYPE_CHECKING:
    from emogen_core.face.rig import Rig

    from ...store.engine import Tx
    from ...store.studies_tables import Link, Study, StudyVersion
    from ..config import StudyConfig
    from .assignment import Place


def new_participation(link: Link, study: Study, version: StudyVersion, token: str) -> Participation:
    """Return somebody who has just arrived."""
    return Participation(
        id=new_id(),
        study_id=study.id,
        version_id=version.id,
        link_id=link.id,
        token_hash=digest(token),
        config_hash=version.config_hash,
        simulated=False,
        pilot=study.status == "pilot",
        preview=False,
        recruiter={},
        device={},
        seed=new_seed(),
        step="consent",
        position=0,
        withdrawal_code=new_code(),
        arrived_at=now(),
    )


def seat(tx: Tx, rig: Rig, participation: Participation, own: StudyConfig, place: Place) -> None:
    """Store a participation at a place of the design with its trials; `own` is the study in its condition."""
    register_rig(tx, rig)
    trials = planned(own, place, participation.id, int(participation.seed))
    participation.condition, participation.head = place.cell.condition, place.cell.head
    participation.order_row = place.row
    participation.lease_until = participation.arrived_at + timedelta(minutes=own.lease_minutes)
    participation.trial_order = [trial.emotion for trial in trials if trial.kind == "evolve" and not trial.practice]
    participation.rig_hash, participation.algorithm = rig.hash, algorithm_of(own)
    runs.add(tx, participation)
    runs.add_all(tx, trials)


def register_rig(tx: Tx, rig: Rig) -> None:
    """Store the names that give this rig's vectors their meaning, once."""
    if studies.rig(tx, rig.hash) is None:
        record = RigRecord(
            hash=rig.hash,
            name=rig.name,
            genes=list(rig.gene_names),
            shapes=list(rig.shape_names),
            first_used_at=now(),
        )
        runs.add_once(tx, record)
