"""`emogen bench export`: how fast and in how much memory a study is exported, in every format.

The faces are those of searches that somebody went through who chooses by chance, so as many of their genes and weights
are 0 as of real ones; every number that is not is changed a little from person to person, or formats that store equal
columns once would be measured on what they never get. Each format is measured in a process of its own, on one core; its
memory is the greatest that the process had, less what it had before the first byte. On a machine that does other things
meanwhile, rows a second of the processor tell more.
"""

from __future__ import annotations

import os
import time
import uuid
from concurrent.futures import ProcessPoolExecutor
from datetime import UTC, datetime, timedelta
from multiprocessing import get_context
from typing import TYPE_CHECKING, Any, get_args

import numpy as np

from ..services.config import DEMO
from ..services.faces.correction import Correction
from ..services.faces.sketch import pack_genes, pack_weights, unpack_genes, unpack_weights
from ..services.participation.seating import register_rig
from ..services.reports.tables.export import Exports
from ..services.reports.tables.formats import Format
from ..services.reports.tables.package import PackageFormat
from ..services.trials.evolution import Evolution
from ..store.engine import Database
from ..store.fill import insert_rows
from ..store.runs_tables import ChoiceRecord, Face, Generation, Participation, Trial
from .common import peak_mib
from .filled import SETS, choice_row, face_row, generation_row, participation_row, trial_row

if TYPE_CHECKING:
    from emogen_core.face.rig import Rig

    from ..services.house import House
    from ..store.base import Base

    Row = dict[str, Any]
    Search = list[list[Row]]
    """The faces of every generation."""

GENERATIONS, FACES = 11, 10
SEARCHES = 8
COPIED = (
    "slot", "place", "origin", "parents", "genes", "weights", "collided_lips", "collided_teeth", "depth_before",
    "depth_after",
)  # fmt: skip
"""Columns of a face that its search decides."""
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
    idle, begun, worked = peak_mib(), time.perf_counter(), time.process_time()
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
        "memory_over_idle_mib": round(peak_mib() - idle, 1),
    }


def _fill(house: House, study: str, people: int) -> None:
    """Store participations with all their faces, a hundred in memory at a time."""
    version, link = house.life.versions(study)[-1], house.studies.summary(study).links[0]
    rig, random = house.journal.rig, np.random.default_rng(0)
    searches = [_search(rig, seed) for seed in range(SEARCHES)]
    with house.database.write() as tx:
        register_rig(tx, rig)
    shared = {"study_id": study, "version_id": version.id, "link_id": link, "rig_hash": rig.hash}
    for first in range(0, people, 100):
        found = [{**shared, **_person(study, number)} for number in range(first, min(first + 100, people))]
        recorded = _recorded(found, random, searches)
        with house.database.write() as tx:
            for table, rows in recorded.items():
                insert_rows(tx, table, rows)


def _search(rig: Rig, seed: int) -> Search:
    """Return the faces of the generations of one search, whoever chooses in it by chance."""
    config = DEMO.model_copy(update={"identities": rig.identities[:1]})
    evolution, random = Evolution(rig, config, Correction(lambda _: rig), lambda *_: ""), np.random.default_rng(seed)
    trial = Trial(id="", identity=rig.identities[0], seed=str(seed))
    state, found = evolution.begin(trial, 0), []
    for _ in range(GENERATIONS):
        found.append([{name: getattr(face, name) for name in COPIED} for face in evolution.offer(trial, state)[1]])
        trial.state = evolution.dump(state)
        slots = random.choice(np.arange(1, FACES + 1), 3, replace=False).tolist()
        state = evolution.tell(trial, slots, slots[0])
    return found


def _person(study: str, number: int) -> Row:
    return participation_row(number, study, datetime(2026, 1, 1, tzinfo=UTC) + timedelta(minutes=number))


def _recorded(people: list[Row], random: np.random.Generator, searches: list[Search]) -> dict[type[Base], list[Row]]:
    """Return the rows of participations by their table, in the order in which they can be stored."""
    trials = [trial_row(person, position) for person in people for position in range(SETS)]
    offered = [generation_row(trial, number) for trial in trials for number in range(GENERATIONS)]
    shown = [faces for _ in trials for faces in searches[random.integers(len(searches))]]
    faces = [_face(one["id"], face, random) for one, ten in zip(offered, shown, strict=True) for face in ten]
    chosen = [_choice(one, faces[FACES * place]["id"]) for place, one in enumerate(offered)]
    return {Participation: people, Trial: trials, Generation: offered, Face: faces, ChoiceRecord: chosen}


def _face(generation: str, face: Row, random: np.random.Generator) -> Row:
    """Return a face with numbers of its own, about those of a face that was made."""
    genes, weights = unpack_genes(face["genes"]), unpack_weights(face["weights"])
    return {
        **face_row(generation),
        **face,
        "id": str(uuid.UUID(bytes=random.bytes(16))),
        "genes": pack_genes(genes * random.uniform(0.9, 1, len(genes))),
        "weights": pack_weights(weights * random.uniform(0.9, 1, len(weights)).astype(np.float32)),
        "portrait_key": random.bytes(32).hex(),
    }


def _choice(generation: Row, face: str) -> Row:
    return {**choice_row(generation), "selected": [face], "elite_face_id": face}
