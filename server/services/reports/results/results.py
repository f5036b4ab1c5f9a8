"""The results of a study: counted when somebody looks, and again when somebody has finished since."""

from __future__ import annotations

import threading
from collections import OrderedDict
from concurrent.futures import Future
from dataclasses import dataclass, field
from datetime import datetime
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from ....store import results, studies
from ...clock import local, now
from ...config import Evolve, StudyConfig
from ...config.stored import config_of, newest
from ...errors import InvalidError, NotFoundError
from ...faces.sketch import Sketch, settings_of
from .data import WHO, Data, Filters, Options, read
from .noise import settling_of
from .numbers import Numbers, numbers

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from emogen_core.simulation.evaluation.threshold import Threshold

    from ...participation.journal import Journal
    from .noise import NoiseOfSearch

_REMEMBERED = 8
"""Results that are kept, with all the faces that they were counted from: some megabytes each."""


@dataclass(frozen=True, slots=True, eq=False)
class Results:
    """The results that one set of filters leaves."""

    filters: Filters
    options: Options
    numbers: Numbers
    data: Data
    noise: Threshold | None
    config: StudyConfig
    counted_at: datetime
    """In the time zone of this machine."""


_Place: TypeAlias = "tuple[str, Filters]"


@dataclass(frozen=True, eq=False)
class _Counted:
    """Results that are there or on their way, and what they were counted from."""

    stamp: object
    promise: Future[Results] = field(default_factory=Future)


@dataclass(frozen=True)
class StudyResults:
    """Counts results and keeps them."""

    journal: Journal
    noise: NoiseOfSearch
    _kept: OrderedDict[_Place, _Counted] = field(default_factory=OrderedDict)
    _lock: threading.Lock = field(default_factory=threading.Lock)

    def of(self, study_id: str, filters: Filters) -> Results:
        """Return the results of a study.

        Raises:
            NotFoundError: no such study.
            InvalidError: a filter that there is not.
        """
        _check(filters)
        with self.journal.database.read() as tx:
            config = newest(tx, study_id)
            signature = results.signature(tx, study_id)
        noise = self.noise.of(config)
        counted, mine = self._place((study_id, filters), (signature, config.hash(), noise))
        if mine:
            self._fill(counted, (study_id, filters), config, noise)
        return counted.promise.result()

    def face(self, study_id: str, filters: Filters, emotion: str, condition: str) -> Future[bytes]:
        """Return the promise of the portrait of a mean face.

        Raises:
            NotFoundError: no such study, or no face of this emotion and condition.
        """
        counted = self.of(study_id, filters)
        cell = counted.numbers.cell(emotion, condition)
        if cell is None:
            raise NotFoundError("There are no such faces.", field="emotion", got=f"{emotion}, {condition}")
        weights = cell.weights.astype(np.float32)
        return self.journal.portraits.sketched(Sketch(cell.cell.identity, weights, settings_of(counted.config)))

    def _place(self, place: _Place, stamp: object) -> tuple[_Counted, bool]:
        """Return where the results of these filters are or will be, and whether it is on the caller to count them."""
        with self._lock:
            kept = self._kept.get(place)
            mine = kept is None or kept.stamp != stamp
            if kept is None or mine:
                kept = self._kept[place] = _Counted(stamp)
            self._kept.move_to_end(place)
            while len(self._kept) > _REMEMBERED:
                self._kept.popitem(last=False)
            return kept, mine

    def _fill(self, counted: _Counted, place: _Place, config: StudyConfig, noise: Threshold | None) -> None:
        """Count without holding anybody up who looks at something else; a failure is told to all and not kept."""
        try:
            counted.promise.set_result(self._count(*place, config, noise))
        except BaseException as error:  # all who wait for this promise are told, whatever it was
            with self._lock:
                if self._kept.get(place) is counted:
                    del self._kept[place]
            counted.promise.set_exception(error)
            raise

    def _count(self, study_id: str, filters: Filters, config: StudyConfig, noise: Threshold | None) -> Results:
        with self.journal.database.read() as tx:
            data = read(tx, study_id, filters, self.journal.rig_of(config).hash, _first_block(config))
            versions = [config_of(tx, version.id) for version in studies.versions(tx, study_id)]
        # A head may be of an older version only.
        for own in (one for version in versions for one in version.whole):
            self.journal.wardrobe.know(own)
        for head in sorted(set(data.faces.identities.tolist())):
            self.journal.wardrobe.wait(head)
        settling = settling_of(noise)
        told = numbers(data, config, self._corrected, settling.near if settling else None)
        return Results(filters, data.options, told, data, noise, config, local(now()))

    def _corrected(self, head: str, genes: NDArray[np.float64]) -> NDArray[np.float32]:
        (made,) = self.journal.correction.faces(head, [genes])
        return made.weights


def _first_block(config: StudyConfig) -> str:
    return next((block.name for block in config.steps if isinstance(block, Evolve)), "")


def _check(filters: Filters) -> None:
    for name, got, known in (("who", filters.who, list(WHO)), ("flagged", filters.flagged, ["leave", "keep"])):
        if got not in known:
            raise InvalidError("There is no such filter.", field=name, expected=f"one of {', '.join(known)}", got=got)
