"""Replays an export: nothing but its files, the rig and this program."""

from __future__ import annotations

import json
from collections import defaultdict
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from emogen_core.rendering.worn import apart

from ....store.runs_tables import ChoiceRecord, Estimate, Face, Generation, Trial
from ...faces.sketch import pack_genes, pack_weights
from ..recorded_export import RecordedExport, matrix
from .comparison import Comparison
from .recorded import Difference, Recorded, Replayed, Seat
from .stored import other_rig

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping

    import pyarrow as pa
    from numpy.typing import NDArray

    from emogen_client import Export
    from emogen_core.face.rig import Rig

    from ...config import StudyConfig
    from ...faces.wardrobe import Wardrobe

    Row = dict[str, Any]
    Where = tuple[str, int, int]
    """Trial, attempt, generation."""

SAME_HEAD = 1.0
"""Millimetres: processors fit a head up to 0.4 mm apart."""


class _Numbers(NamedTuple):
    """(F, G) genes and (F, K) weights of all faces of a table."""

    genes: NDArray[np.float64]
    weights: NDArray[np.float64]


@dataclass(frozen=True)
class ExportReplay:
    """Replays the participations of an export, each on the rig of its heads.

    Raises:
        EmogenClientError: the export lacks a file, or one is not the one that its manifest tells of.
    """

    export: Export
    wardrobe: Wardrobe
    _comparisons: dict[str, Comparison] = field(default_factory=dict)
    _numbers: dict[tuple[str, str], _Numbers] = field(default_factory=dict)
    _heads: dict[str, float] = field(default_factory=dict)

    def everybody(self, done: Callable[[int, int], object] = lambda _done, _of: None) -> Replayed:
        """Replay every participation, up to the first difference.

        Args:
            done: told after each how many are done, of how many.

        Raises:
            NotFoundError: one was recorded on another face model.
            ConflictError: a head cannot be fitted any more.
        """
        count = 0
        for at, row in enumerate(self._people, 1):
            recorded = self.recorded(row)
            replayed = self._replayed(recorded) if isinstance(recorded, Recorded) else Replayed(0, recorded)
            count += replayed.generations
            if replayed.difference:
                return Replayed(count, replayed.difference)
            done(at, len(self._people))
        return Replayed(count, None)

    def participations(self) -> Iterator[Recorded]:
        """Yield every participation whose configuration is the one that it names."""
        for row in self._people:
            recorded = self.recorded(row)
            if isinstance(recorded, Recorded):
                yield recorded

    def recorded(self, row: Row) -> Recorded | Difference:
        """Return a participation as the export has it, or what is wrong in the export itself."""
        who = row["participation"]
        wrong = self._record.wrong(row)
        if wrong:
            return _amiss(who, *wrong)
        config = self._record.own(row)
        rig = self.wardrobe.rig_of(config)
        if row["rig_hash"] != rig.hash:
            raise other_rig(rig.hash, row["rig_hash"])
        marked = self._marked(who)
        if marked:
            return marked
        complete = row["outcome"] == "complete"
        return Recorded(
            who, row["seed"], config,
            Seat(row["head"] or "", row["order_row"], tuple(json.loads(row["trial_order"]))),
            complete, "some" if self._partial else "all" if complete else "begun",
            [(trial, self._shown(trial, rig)) for trial in self._trials[who]],
            self._estimates(who, rig),
        )  # fmt: skip

    def _marked(self, who: str) -> Difference | None:
        """Return the first face whose row says something else of its choice than the choice does."""
        for where in (place for trial in self._trials[who] for place in self._generations.get(trial.id, ())):
            choice = self._choices.get(where)
            for _, face in self._offered[where]:
                chosen = choice and (face["face"] in json.loads(choice["selected"]), face["face"] == choice["elite"])
                if (chosen or (None, None)) != (face["selected"], face["elite"]):
                    told = f"selected, best: {chosen}", f"{face['selected']}, {face['elite']}"
                    return Difference(who, *where, face["slot"], "marks", *told)
        return None

    def _replayed(self, recorded: Recorded) -> Replayed:
        rig = self.wardrobe.rig_of(recorded.config)
        if rig.hash not in self._comparisons:
            self._comparisons[rig.hash] = Comparison(rig, self.wardrobe)
        for name, document in recorded.config.documents.items():
            away = self._away(recorded.config, name, document)
            if away > SAME_HEAD:
                told = f"within {SAME_HEAD:g} mm of what its document gives", f"{away:.2f} mm away"
                return Replayed(0, _amiss(recorded.participation, f"head {name}", *told))
        return self._comparisons[rig.hash].of(recorded)

    def _away(self, config: StudyConfig, name: str, document: Mapping[str, Any]) -> float:
        """Return how far, in millimetres, a head lies from the one that this processor fits to its document."""
        if name not in self._heads:
            self.wardrobe.know(config)
            self.wardrobe.wait(name)
            kept = self.wardrobe.head(name)
            again, _ = self.wardrobe.anew(document)
            self._heads[name] = apart(again, kept) if kept else 0.0
        return self._heads[name]

    def _shown(self, trial: Trial, rig: Rig) -> list[tuple[Generation, list[Face], ChoiceRecord | None]]:
        return [
            (
                Generation(trial_id=trial.id, attempt=where[1], number=where[2]),
                [self._face(at, row, self._of(rig, "faces")) for at, row in self._offered[where]],
                _choice(self._choices.get(where)),
            )
            for where in self._generations.get(trial.id, ())
        ]

    def _face(self, at: int, row: Row, numbers: _Numbers) -> Face:
        return Face(
            id=row["face"],
            slot=row["slot"],
            place=row["place"],
            origin=row["origin"],
            parents=json.loads(row["parents"]),
            **_made(at, row, numbers),
        )

    def _estimates(self, who: str, rig: Rig) -> dict[str, Estimate]:
        return {
            row["trial"]: Estimate(trial_id=row["trial"], **_made(at, row, self._of(rig, "estimates")))
            for at, row in self._estimated[who]
        }

    @cached_property
    def _people(self) -> list[Row]:
        """The participations that were not erased; of those a row is all that is left."""
        return [row for row in self.export.arrow("participations").to_pylist() if row["erased_at"] is None]

    @cached_property
    def _record(self) -> RecordedExport:
        return RecordedExport(self.export)

    @property
    def _partial(self) -> bool:
        """Whether the export was restricted to some trials of its people."""
        return not {"block", "emotion"}.isdisjoint(self.export.manifest["filters"])

    @cached_property
    def _trials(self) -> Mapping[str, list[Trial]]:
        found: dict[str, list[Trial]] = defaultdict(list)
        for row in sorted(self.export.arrow("trials").to_pylist(), key=lambda row: row["position"]):
            found[row["participation"]].append(
                Trial(
                    id=row["trial"], participation_id=row["participation"], position=row["position"],
                    block=row["block"], kind=row["kind"], practice=row["practice"], emotion=row["emotion"] or "",
                    identity=row["identity"] or "", seed=row["seed"], attempt=row["attempts"],
                    generation=row["generations"], final_face_id=row["final_face"],
                    last_generation=row["generations"] if row.get("ended_early") else None,  # not in earlier exports
                )
            )  # fmt: skip
        return found

    @cached_property
    def _generations(self) -> Mapping[str, list[Where]]:
        found: dict[str, list[Where]] = defaultdict(list)
        for row in self.export.arrow("generations").to_pylist():
            found[row["trial"]].append(_where(row))
        return {trial: sorted(places) for trial, places in found.items()}

    @cached_property
    def _choices(self) -> Mapping[Where, Row]:
        return {_where(row): row for row in self.export.arrow("choices").to_pylist()}

    @cached_property
    def _tables(self) -> Mapping[str, pa.Table]:
        """The tables with genes and weights; exports of earlier releases have no estimates."""
        return {name: self.export.arrow(name) for name in ("faces", "estimates") if name in self.export.tables}

    @cached_property
    def _offered(self) -> Mapping[Where, list[tuple[int, Row]]]:
        """The faces of every generation by slot, each with its row in the table."""
        found: dict[Where, list[tuple[int, Row]]] = defaultdict(list)
        for at, row in self._rows("faces"):
            found[_where(row)].append((at, row))
        for faces in found.values():
            faces.sort(key=lambda one: one[1]["slot"])
        return found

    @cached_property
    def _estimated(self) -> Mapping[str, list[tuple[int, Row]]]:
        """What the search took for the faces in mind, by participation, each with its row in the table."""
        found: dict[str, list[tuple[int, Row]]] = defaultdict(list)
        for at, row in self._rows("estimates"):
            found[row["participation"]].append((at, row))
        return found

    def _rows(self, name: str) -> Iterator[tuple[int, Row]]:
        """Yield the rows of a table, without their genes and weights."""
        if name in self._tables:
            table = self._tables[name]
            plain = [column for column in table.column_names if not column.startswith(("gene_", "weight_"))]
            yield from enumerate(table.select(plain).to_pylist())

    def _of(self, rig: Rig, name: str) -> _Numbers:
        """Return the numbers of a table's faces by the names of a rig; of another rig's faces they mean nothing."""
        if (rig.hash, name) not in self._numbers:
            table = self._tables[name]
            genes = matrix(table, "gene_", rig.gene_names)
            self._numbers[rig.hash, name] = _Numbers(genes, matrix(table, "weight_", rig.shape_names))
        return self._numbers[rig.hash, name]


def _where(row: Row) -> Where:
    return row["trial"], row["attempt"], row["generation"]


def _made(at: int, row: Row, numbers: _Numbers) -> Row:
    """Return what a face is made of, by the names of its columns in the database."""
    return {
        "identity": row["identity"],
        "genes": pack_genes(numbers.genes[at]),
        "weights": pack_weights(numbers.weights[at].astype(np.float32)),
        "collided_lips": row["collided_lips"],
        "collided_teeth": row["collided_teeth"],
        "depth_before": row["depth_before_mm"],
        "depth_after": row["depth_after_mm"],
    }


def _choice(row: Row | None) -> ChoiceRecord | None:
    return ChoiceRecord(selected=json.loads(row["selected"]), elite_face_id=row["elite"]) if row else None


def _amiss(who: str, what: str, expected: str, got: str) -> Difference:
    return Difference(who, "", None, None, None, what, expected, got)
