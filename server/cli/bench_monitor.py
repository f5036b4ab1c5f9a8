"""`emogen bench monitor`: how long a look at a large study takes, and the list of many studies."""

from __future__ import annotations

import statistics
import time
from datetime import timedelta
from functools import partial
from typing import TYPE_CHECKING, Any, get_args

from ..services.clock import now
from ..services.config import DEMO
from ..services.participation.seating import register_rig
from ..services.reports.monitor.monitor import View
from ..services.reports.monitor.spans import Span
from ..store.fill import insert_rows
from ..store.runs_tables import ChoiceRecord, Face, Generation, Participation, Trial
from .filled import SETS, choice_row, face_row, generation_row, participation_row, trial_row

if TYPE_CHECKING:
    from collections.abc import Callable

    from ..services.house import House


def bench_monitor(house: House, participations: int, generations: int, studies: int, rounds: int) -> dict[str, Any]:
    """Return medians in milliseconds, on a study of so many participations and a list of so many studies.

    `generations` are all of a participation, over its four face sets.
    """
    ids = [house.studies.create(DEMO.model_copy(update={"quota": participations})).id for _ in range(studies)]
    _fill(house, ids[0], participations, generations)
    for study in ids[1:]:
        _fill(house, study, max(participations // studies, 1), 0)
    spans: tuple[Span, ...] = get_args(Span)
    report: dict[str, Any] = {"participations": participations, "generations": generations, "studies": studies}
    for span in spans:
        report[f"look_{span}_ms"] = _median(partial(house.monitor.look, ids[0], View(span)), rounds)
    return {**report, "list_ms": _median(house.overview.all, rounds)}


def _median(work: Callable[[], object], rounds: int) -> float:
    taken = []
    for _ in range(rounds):
        begun = time.perf_counter()
        work()
        taken.append((time.perf_counter() - begun) * 1000)
    return round(statistics.median(taken), 1)


def _fill(house: House, study: str, participations: int, generations: int) -> None:
    """Store participations over the last thirty days, as rows: nobody looks at their faces."""
    begin = now() - timedelta(days=30)
    version = house.life.versions(study)[-1]
    link = house.studies.summary(study).links[0]
    with house.database.write() as tx:
        register_rig(tx, house.journal.rig)
        shared = {"study_id": study, "version_id": version.id, "link_id": link, "rig_hash": house.journal.rig.hash}
        people = [
            participation_row(number, study, begin + timedelta(days=30) * number / participations)
            for number in range(participations)
        ]
        insert_rows(tx, Participation, [{**shared, **person} for person in people])
        trials = [trial_row(person, position) for person in people for position in range(SETS)] if generations else []
        insert_rows(tx, Trial, trials)
        offered = [generation_row(trial, number) for trial in trials for number in range(generations // SETS)]
        insert_rows(tx, Generation, offered)
        insert_rows(tx, Face, [face_row(one["id"]) for one in offered])
        insert_rows(tx, ChoiceRecord, [choice_row(one) for one in offered])
