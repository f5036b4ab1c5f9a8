"""The noise of a study's own search, simulated once for its settings and face model and then remembered.

Some hundred simulated searches take a second, so they run behind the page, which says so until they are there. Those
of a strategy that learns take minutes, so they run in a process of their own. The result is a small file under the hash
of everything that it depends on: other processes and later starts find it.
"""

from __future__ import annotations

import hashlib
import json
import logging
import threading
from concurrent.futures import ThreadPoolExecutor
from dataclasses import asdict, dataclass, field, replace
from typing import TYPE_CHECKING, Any

from emogen_core.simulation.evaluation.dispersion import Dispersion
from emogen_core.simulation.evaluation.laboratory import Laboratory
from emogen_core.simulation.evaluation.results import Spread
from emogen_core.simulation.evaluation.specs import RunSpec
from emogen_core.simulation.evaluation.threshold import Noise, Threshold, threshold, usual_searches

from ...background import watched
from ...errors import UnavailableError
from ...own_call import made_aside
from ...trials.evolution import algorithm_of, simulated

if TYPE_CHECKING:
    from collections.abc import Callable
    from concurrent.futures import Future
    from pathlib import Path

    from emogen_core.face.rig import Rig

    from ...config import StudyConfig

logger = logging.getLogger(__name__)

SEED = 1
"""As of the command that the page names, so that it prints the same numbers."""
PAUSE = 0.001
"""Seconds after every generation in which those who answer participants go first."""
VERSION = 5
"""Counted up when the same settings come to give other numbers."""


@dataclass(frozen=True, slots=True)
class Settling:
    """How far simulated people's best faces are from their results, a number for every generation but the last.

    Attributes:
        faithful: mean of those who never err.
        noisy: mean of those whose judged distances have a noise of .1.
        random: mean of those who choose at random.
        near: how far those who never err end from the face in mind: whoever is nearer to the own result has settled.
    """

    faithful: tuple[float, ...]
    noisy: tuple[float, ...]
    random: tuple[float, ...]
    near: float


def settling_of(noise: Threshold | None) -> Settling | None:
    """Return how simulated people settle, once the noise is known."""
    if noise is None:
        return None
    kinds = (noise.faithful, noise.noisy, noise.random)
    faithful, noisy, random = (tuple(one.mean for one in kind.settling) for kind in kinds)
    return Settling(faithful, noisy, random, noise.faithful.error.mean)


@dataclass(frozen=True)
class NoiseOfSearch:
    """Knows the noise of every search that was asked for.

    Attributes:
        rig_of: gives the rig of a study.
        folder: where results are kept.
        searches: for each kind of participant; as many as are usual for the strategy unless given.
    """

    rig_of: Callable[[StudyConfig], Rig]
    folder: Path
    searches: int | None = None
    _known: dict[str, Threshold] = field(default_factory=dict)
    _running: dict[str, Future[None]] = field(default_factory=dict)
    _lock: threading.Lock = field(default_factory=threading.Lock)
    _closed: threading.Event = field(default_factory=threading.Event)
    _behind: ThreadPoolExecutor = field(default_factory=lambda: ThreadPoolExecutor(1, thread_name_prefix="noise"))
    _aside: ThreadPoolExecutor = field(default_factory=lambda: ThreadPoolExecutor(1, thread_name_prefix="learning"))
    """Waits for the process in which strategies that learn are simulated, so that nobody else's noise waits for it."""

    def of(self, config: StudyConfig) -> Threshold | None:
        """Return the noise of a study's search, or nothing while it is being simulated."""
        key = self._key(config)
        with self._lock:
            found = self._known.get(key) or self._read(key)
            if found is not None:
                self._known[key] = found
            elif key not in self._running:
                waiting = self._aside if _learns(config) else self._behind
                self._running[key] = waiting.submit(self._simulate, key, config)
                watched(self._running[key], "the noise of a search could not be simulated")
            return found

    def settle(self) -> None:
        """Wait until everything that was asked for is known. For tests."""
        for waiting in (self._behind, self._aside):
            waiting.submit(lambda: None).result()

    def close(self) -> None:
        """Stop, also in the middle of a simulation."""
        self._closed.set()
        for waiting in (self._behind, self._aside):
            waiting.shutdown(wait=True, cancel_futures=True)

    def _simulate(self, key: str, config: StudyConfig) -> None:
        try:
            noise = self._simulated(config)
            with self._lock:
                self._known[key] = noise
        finally:
            with self._lock:
                self._running.pop(key, None)  # a failure is tried again when somebody asks
        self._write(key, noise)

    def _simulated(self, config: StudyConfig) -> Threshold:
        def pause() -> None:
            if self._closed.wait(PAUSE):
                raise UnavailableError("The server is stopping.")

        rig = self.rig_of(config)
        params, drawn = simulated(rig, config)
        laboratory = Laboratory(rig, rig.identities[0], SEED, params, drawn=drawn, algorithm=config.search.strategy)
        if _learns(config):
            return made_aside(self._closed, threshold, laboratory, self.searches)
        laboratory.pause = pause
        return threshold(laboratory, self.searches)

    def _key(self, config: StudyConfig) -> str:
        """Return the hash of all that the noise depends on; a study's texts do not change it."""
        rig = self.rig_of(config)
        params, drawn = simulated(rig, config)
        told: dict[str, Any] = asdict(replace(params, geometry=None))
        del told["geometry"]  # the rig's, whose hash is told
        told["drawn"] = None if drawn is None else drawn.tolist()
        searches = self.searches or usual_searches(config.search.strategy)
        told |= {"rig": rig.hash, "algorithm": algorithm_of(config), "version": VERSION, "searches": searches}
        return hashlib.sha256(json.dumps(told, sort_keys=True).encode()).hexdigest()

    def _read(self, key: str) -> Threshold | None:
        try:
            return _threshold(json.loads((self.folder / f"{key}.json").read_text(encoding="utf-8")))
        except (OSError, ValueError, KeyError, TypeError, AttributeError):
            return None

    def _write(self, key: str, noise: Threshold) -> None:
        try:
            self.folder.mkdir(parents=True, exist_ok=True)
            part = self.folder / f".{key}.{threading.get_ident()}.part"
            part.write_text(json.dumps(asdict(noise)), encoding="utf-8")
            part.replace(self.folder / f"{key}.json")
        except OSError as error:
            logger.warning("the noise of a search cannot be kept on disk: %s", error)


def _threshold(told: dict[str, Any]) -> Threshold:
    """Return a threshold from what was written of it."""
    faithful, noisy, random = (_noise(told[name]) for name in ("faithful", "noisy", "random"))
    return Threshold(told["searches"], faithful, noisy, random, told["no_answer"], Spread(**told["paper"]))


def _noise(told: dict[str, Any]) -> Noise:
    error, apart, proxy = (Spread(**told[name]) for name in ("error", "apart", "proxy"))
    within, among = (Dispersion(**told[name]) for name in ("within", "among"))
    settling = tuple(Spread(**one) for one in told["settling"])
    return Noise(error, apart, proxy, settling, told["right"], within, among, told["kept"], told["generations"])


def _learns(config: StudyConfig) -> bool:
    return RunSpec("people", algorithm=config.search.strategy).learns
