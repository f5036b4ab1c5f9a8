"""`emogen bench export`: how fast and in how much memory a study is exported, in every format.

Every second gene and weight is a number with all its digits, the others are 0: more to write than real faces have.
Each format is measured in a process of its own, on one core; its memory is the greatest that the process had, less
what it had before the first byte. On a machine that does other things
meanwhile, rows a second of the processor tell more.
"""

from __future__ import annotations

import os
import resource
import time
import uuid
from concurrent.futures import ProcessPoolExecutor
from datetime import UTC, datetime, timedelta
from multiprocessing import get_context
from pathlib import Path
from typing import TYPE_CHECKING, Any, get_args

import numpy as np

from ..services.config import DEMO
from ..services.faces.sketch import pack_genes, pack_weights
from ..services.participation.seating import register_rig
from ..services.reports.tables.export import Exports
from ..services.reports.tables.formats import Format
from ..services.reports.tables.package import PackageFormat
from ..store.engine import Database
from ..store.fill import insert_rows
from ..store.runs_tables import ChoiceRecord, Face, Generation, Participation, Trial
from .filled import SETS, choice_row, face_row, generation_row, participation_row, trial_row

if TYPE_CHECKING:
    from ..services.house import House
    from ..store.base import Base

Row = dict[str, Any]
GENERATIONS, FACES = 11, 10
MIB = 2**20


def bench_export(house: House, rows: int) -> dict[str, Any]:
    """Return rows a second and memory in MiB for each format, on a study of about so many faces."""
    study = house.studies.create(DEMO.model_copy(update={"quota": None})).id
    people = max(1, rows // (SETS * GENERATIONS * FACES))
    _fill(house, study, people)
    report: dict[str, Any] = {"faces": people * SETS * GENERATIONS * FACES, "participations": people}
    for form in get_args(Format):
        report[f"table_{form}"] = _measured(house.database.url, study, form, packed=False)
    for form in get_args(PackageFormat):
        report[f"package_{form}"] = _measured(house.database.url, study, form, packed=True)
    return report


def _measured(url: str, study: str, form: str, *, packed: bool) -> Row:
    with ProcessPoolExecutor(1, mp_context=get_context("spawn")) as pool:
        return pool.submit(_stream, url, study, form, packed).result()


def _stream(url: str, study: str, form: Any, packed: bool) -> Row:
    if hasattr(os, "sched_setaffinity"):
        os.sched_setaffinity(0, {max(os.sched_getaffinity(0))})
    exports = Exports(Database(url))
    exports.overview(study)
    idle, begun, worked = _peak(), time.perf_counter(), time.process_time()
    download = exports.zip(study, form) if packed else exports.table(study, "faces", form)
    size = sum(map(len, download.chunks))
    seconds, worked = time.perf_counter() - begun, time.process_time() - worked
    rows = download.tally.rows
    return {
        "rows": rows,
        "rows_per_second": round(rows / seconds),
        "rows_per_cpu_second": round(rows / worked),
        "seconds": round(seconds, 1),
        "mib": round(size / MIB, 1),
        "memory_over_idle_mib": round(_peak() - idle, 1),
    }


def _peak() -> float:
    """Return the most memory that this process has had since it was started, in MiB."""
    status = Path("/proc/self/status")
    if not status.exists():
        return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    (line,) = (line for line in status.read_text().splitlines() if line.startswith("VmHWM:"))
    return int(line.split()[1]) / 1024


def _fill(house: House, study: str, people: int) -> None:
    """Store participations with all their faces, a hundred in memory at a time."""
    version, link = house.life.versions(study)[-1], house.studies.summary(study).links[0]
    rig, random = house.journal.rig, np.random.default_rng(0)
    with house.database.write() as tx:
        register_rig(tx, rig)
    shared = {"study_id": study, "version_id": version.id, "link_id": link, "rig_hash": rig.hash}
    for first in range(0, people, 100):
        found = [{**shared, **_person(study, number)} for number in range(first, min(first + 100, people))]
        recorded = _recorded(found, random, len(rig.gene_names), len(rig.shape_names))
        with house.database.write() as tx:
            for table, rows in recorded.items():
                insert_rows(tx, table, rows)


def _person(study: str, number: int) -> Row:
    return participation_row(number, study, datetime(2026, 1, 1, tzinfo=UTC) + timedelta(minutes=number))


def _recorded(people: list[Row], random: np.random.Generator, genes: int, shapes: int) -> dict[type[Base], list[Row]]:
    """Return the rows of participations by their table, in the order in which they can be stored."""
    trials = [trial_row(person, position) for person in people for position in range(SETS)]
    offered = [generation_row(trial, number) for trial in trials for number in range(GENERATIONS)]
    faces = [face for one in offered for face in _faces(one["id"], random, genes, shapes)]
    chosen = [_choice(one, faces[FACES * place]["id"]) for place, one in enumerate(offered)]
    return {Participation: people, Trial: trials, Generation: offered, Face: faces, ChoiceRecord: chosen}


def _faces(generation: str, random: np.random.Generator, genes: int, shapes: int) -> list[Row]:
    numbers = random.random((FACES, genes + shapes))
    numbers[random.random(numbers.shape) < 0.5] = 0
    return [
        {
            **face_row(generation),
            "id": str(uuid.UUID(bytes=random.bytes(16))),
            "slot": slot + 1,
            "place": slot + 1,
            "parents": [1, 2],
            "genes": pack_genes(row[:genes]),
            "weights": pack_weights(row[genes:].astype(np.float32)),
            "portrait_key": random.bytes(32).hex(),
        }
        for slot, row in enumerate(numbers)
    ]


def _choice(generation: Row, face: str) -> Row:
    return {**choice_row(generation), "selected": [face], "elite_face_id": face}
