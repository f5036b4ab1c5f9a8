"""What the results are counted from: the finished faces of a study that the filters leave, as arrays."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from emogen_core.analysis.recorded import Faces

from ....store import results
from ...faces.sketch import unpack_genes, unpack_weights

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, Sequence

    from numpy.typing import NDArray

    from ....store.engine import Tx

WHO = {"people": "Participants", "pilot": "Pilot", "simulated": "Simulated", "all": "Everybody"}
"""Whose faces are counted."""


@dataclass(frozen=True, slots=True)
class Filters:
    """What the address of the results says; empty fields restrict nothing. `since` is the first version counted."""

    head: str = ""
    condition: str = ""
    since: int = 0
    block: str = ""
    flagged: str = "leave"
    who: str = "people"


@dataclass(frozen=True, slots=True)
class Options:
    """What there is to filter by."""

    heads: tuple[str, ...]
    conditions: tuple[str, ...]
    versions: tuple[int, ...]
    blocks: tuple[str, ...]
    flagged: int
    others: int
    """People who completed and are not counted because of who they are: pilot or simulated."""


@dataclass(frozen=True, slots=True, eq=False)
class Data:
    """Finished faces.

    Attributes:
        options: what there is to filter by.
        faces: the faces, with the best one of every generation on the way to each.
        versions: of each face's participation.
        labels: (source, meant, called) of every face that was categorised.
        foreign: how many faces are of another face model and left out.
    """

    options: Options
    faces: Faces
    versions: list[int]
    labels: list[tuple[str, str, str]]
    foreign: int


def read(tx: Tx, study_id: str, filters: Filters, rig_hash: str, first_block: str) -> Data:
    """Return the faces that the filters leave; of the first evolve block unless another is named."""
    everybody = results.faces(tx, study_id)
    failed = {who for who, got, right in results.attention(tx, study_id) if right is not None and got != right}
    block = filters.block or first_block
    counted = [row for row in everybody if _is(filters.who, row) and row["block"] == block]
    own = [row for row in counted if _fits(filters, row, failed)]
    rows = [row for row in own if row["rig_hash"] == rig_hash]
    return Data(
        options=_options(everybody, counted, failed, filters),
        faces=_faces(rows, results.best_faces(tx, study_id, block), results.ratings(tx, study_id)),
        versions=_column(rows, "version"),
        labels=_labels(tx, study_id, set(_column(own, "participation"))),
        foreign=len(own) - len(rows),
    )


def _faces(
    rows: Sequence[Mapping[str, Any]],
    best: Sequence[tuple[str, bytes]],
    ratings: Sequence[tuple[str, str, int]],
) -> Faces:
    trials = _column(rows, "trial")
    return Faces(
        people=np.array(_column(rows, "participation"), str), emotions=np.array(_column(rows, "emotion"), str),
        identities=np.array(_column(rows, "identity"), str), conditions=np.array(_column(rows, "condition"), str),
        repetitions=np.zeros(len(rows), int), genes=_stacked(map(unpack_genes, _column(rows, "genes"))),
        weights=_stacked(map(unpack_weights, _column(rows, "weights"))), ratings=_ratings(ratings, trials),
        elites=_elites(best, trials),
    )  # fmt: skip


def _stacked(rows: Iterable[NDArray[np.floating]]) -> NDArray[np.float64]:
    """Return (n, K) numbers, also of no rows."""
    found = np.array(list(rows), float)
    return found if found.ndim == 2 else np.zeros((0, 0))


def _column(rows: Sequence[Mapping[str, Any]], name: str) -> list[Any]:
    return [row[name] for row in rows]


def _labels(tx: Tx, study_id: str, people: set[str]) -> list[tuple[str, str, str]]:
    return [
        (source, meant, str(called[0]) if called else "")
        for who, source, meant, called in results.labels(tx, study_id)
        if who in people
    ]


def _is(who: str, row: Mapping[str, Any]) -> bool:
    kind = "simulated" if row["simulated"] else "pilot" if row["pilot"] else "people"
    return who in {"all", kind}


def _fits(filters: Filters, row: Mapping[str, Any], failed: set[str]) -> bool:
    return (
        filters.head in {"", row["identity"]}
        and filters.condition in {"", row["condition"]}
        and row["version"] >= filters.since
        and not (filters.flagged == "leave" and row["participation"] in failed)
    )


def _options(
    everybody: Sequence[Mapping[str, Any]], counted: Sequence[Mapping[str, Any]], failed: set[str], filters: Filters
) -> Options:
    def known(name: str, rows: Iterable[Mapping[str, Any]]) -> tuple[Any, ...]:
        return tuple(sorted({row[name] for row in rows}))

    complete = {row["participation"] for row in everybody}
    kept = {row["participation"] for row in everybody if _is(filters.who, row)}
    return Options(
        heads=known("identity", counted),
        conditions=known("condition", counted),
        versions=known("version", counted),
        blocks=tuple(dict.fromkeys(row["block"] for row in everybody)),
        flagged=len(failed & {row["participation"] for row in counted}),
        others=len(complete - kept),
    )


def _elites(found: Sequence[tuple[str, bytes]], trials: Sequence[str]) -> tuple[NDArray[np.float64], ...]:
    """Return the best face of every generation; of a face without a way to it, as in data from elsewhere, none."""
    best: dict[str, list[NDArray[np.float32]]] = {trial: [] for trial in trials}
    for trial, weights in found:
        if trial in best:
            best[trial].append(unpack_weights(weights))
    width = max((len(one) for own in best.values() for one in own), default=0)
    return tuple(np.array(best[trial], float).reshape(-1, width) for trial in trials)


def _ratings(found: Sequence[tuple[str, str, int]], trials: Sequence[str]) -> dict[str, NDArray[np.float64]]:
    place = {trial: index for index, trial in enumerate(trials)}
    told: dict[str, NDArray[np.float64]] = {}
    for trial, question, value in found:
        if trial in place:
            told.setdefault(question, np.full(len(trials), np.nan))[place[trial]] = value
    return told
