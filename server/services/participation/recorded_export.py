"""What replay and analysis both read in an export: the study as each person had it, and columns as numbers."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from pydantic import ValidationError

from ..config import StudyConfig
from ..errors import InvalidError

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    import pyarrow as pa
    from numpy.typing import NDArray

    from emogen_client import Export

    Row = dict[str, Any]


class Wrong(NamedTuple):
    """What a row says of its configuration, and the configurations of the export do not."""

    what: str
    expected: str
    got: str


@dataclass(frozen=True)
class RecordedExport:
    """The configurations of an export.

    Raises:
        EmogenClientError: the export lacks their file, or it is not the one that the manifest tells of.
        InvalidError: a configuration is none.
    """

    export: Export
    _own: dict[tuple[str, str | None], StudyConfig] = field(default_factory=dict)

    @cached_property
    def versions(self) -> Mapping[str, StudyConfig]:
        """Every version of the study by the hash that participations name."""
        try:
            return {
                one["config_hash"]: StudyConfig.model_validate(one["config"]) for one in self.export.configurations()
            }
        except ValidationError as error:
            raise InvalidError(f"A configuration of the export is none: {error}.", field="configurations") from error

    @cached_property
    def grouped(self) -> bool:
        """Whether the study has conditions; without any, the column tells only who saw which head."""
        return any(version.conditions for version in self.versions.values())

    def wrong(self, row: Row) -> Wrong | None:
        """Return what is wrong with the configuration that a participation names; nothing if it is the right one."""
        named = row["config_hash"]
        whole = self.versions.get(named)
        if whole is None:
            return Wrong("config_hash", f"one of {sorted(self.versions)}", named)
        if self._hashes[named] != named:
            return Wrong("configuration", named, self._hashes[named])
        names = [one.name for one in whole.conditions]
        if names and row["condition"] not in names:
            return Wrong("condition", f"one of {names}", str(row["condition"]))
        return None

    def own(self, row: Row) -> StudyConfig:
        """Return the study as a participation had it: its version, in its condition.

        Raises:
            InvalidError: the configuration that it names is not the one of the export.
        """
        wrong = self.wrong(row)
        if wrong:
            raise InvalidError(
                f"Participation {row['participation']}: {wrong.what}: expected {wrong.expected}, got {wrong.got}.",
                field=wrong.what, expected=wrong.expected, got=wrong.got,
            )  # fmt: skip
        whole = self.versions[row["config_hash"]]
        key = row["config_hash"], row["condition"] if whole.conditions else None
        if key not in self._own:
            self._own[key] = whole.in_condition(row["condition"])
        return self._own[key]

    @cached_property
    def _hashes(self) -> Mapping[str, str]:
        return {named: version.hash() for named, version in self.versions.items()}


def matrix(table: pa.Table, prefix: str, names: Sequence[str]) -> NDArray[np.float64]:
    """Return (n, len(names)) values of columns such as `gene_jawOpen`; what is not there is NaN."""
    there = set(table.column_names)  # an export of nobody lacks them
    found = np.full((table.num_rows, len(names)), np.nan)
    for at, name in enumerate(names):
        if prefix + name in there:
            found[:, at] = table[prefix + name].to_numpy()
    return found
