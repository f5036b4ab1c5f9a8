"""Who counts: people of an export who completed, each with the study as they had it."""

from __future__ import annotations

import json
from collections import Counter
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from ..services.participation.recorded_export import RecordedExport
from ..services.participation.replay.stored import other_rig

if TYPE_CHECKING:
    from collections.abc import Collection, Mapping

    from emogen_client import Export
    from emogen_core.face.rig import Rig

    from ..services.config import StudyConfig

    Row = dict[str, Any]

PEOPLE, PILOT, SIMULATED = "people", "pilot", "simulated"
"""Who can be counted: the same kinds as on the Results page."""
FAILED = "failed an attention check"
NOT_ASKED_FOR = {PEOPLE: "people", PILOT: "of the pilot phase", SIMULATED: "simulated"}


@dataclass(frozen=True, slots=True)
class Counted:
    """Participations.

    Attributes:
        people: those that count, by their id.
        configs: by the same ids, the study in the condition of each.
        left_out: how many do not count, by reason.
        grouped: whether the study has conditions.
    """

    people: Mapping[str, Row]
    configs: Mapping[str, StudyConfig]
    left_out: Mapping[str, int]
    grouped: bool

    def condition(self, who: str) -> str:
        """Return the condition of somebody, empty in a study without any."""
        return str(self.people[who]["condition"]) if self.grouped else ""


def counted(export: Export, rig: Rig, kinds: Collection[str], *, flagged: bool = False) -> Counted:
    """Return who counts.

    Args:
        export: what was recorded.
        rig: the face model that it has to be of.
        kinds: who counts: people, pilot, simulated.
        flagged: whether those who failed an attention check count as well.

    Raises:
        EmogenClientError: the export lacks a file, or one is not the one that its manifest tells of.
        NotFoundError: it was recorded on another face model.
        InvalidError: a configuration is none, or not the one that somebody's row names.
    """
    rows = export.arrow("participations").to_pylist()
    failed = frozenset() if flagged else _failed(export)
    reasons = [_reason(row, kinds, failed) for row in rows]
    people = {row["participation"]: row for row, reason in zip(rows, reasons, strict=True) if not reason}
    for row in people.values():
        if row["rig_hash"] != rig.hash:
            raise other_rig(rig.hash, row["rig_hash"])
    record = RecordedExport(export)
    configs = {who: record.own(row) for who, row in people.items()}
    return Counted(people, configs, dict(Counter(filter(None, reasons))), record.grouped)


def _failed(export: Export) -> frozenset[str]:
    """Return who gave another answer to an attention check than the right one."""
    rows = export.arrow("responses").select(["participation", "kind", "value", "expected"]).to_pylist()
    checks = [row for row in rows if row["kind"] == "attention" and row["expected"] is not None]
    return frozenset(row["participation"] for row in checks if _plain(row["value"]) != _plain(row["expected"]))


def _plain(answer: str | None) -> Any:
    return None if answer is None else json.loads(answer)


def _reason(row: Row, kinds: Collection[str], failed: Collection[str]) -> str:
    """Return why a participation does not count; nothing if it does."""
    kind = SIMULATED if row["simulated"] else PILOT if row["pilot"] else PEOPLE
    if row["erased_at"] is not None:
        return "erased"
    if kind not in kinds:
        return NOT_ASKED_FOR[kind]
    if row["outcome"] != "complete":
        return "not complete"
    return FAILED if row["participation"] in failed else ""
