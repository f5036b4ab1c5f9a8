"""How a study goes: one look at its rows, from which the monitor's page and its live updates are made.

A look is one read transaction of five queries. Everybody who watches the same study shares it: a look is taken anew
only when the last one is older than `FRESH`.
"""

from __future__ import annotations

import threading
from collections import OrderedDict
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from datetime import datetime, timedelta
from typing import TYPE_CHECKING

from ....store import monitor, studies
from ....store.monitor import Who as Who  # noqa: PLC0414 - pages ask by it
from ...clock import local, now
from ...config.stored import parsed
from ...errors import NotFoundError, UnavailableError
from ...naming import name_of
from .people import (
    AWAY,
    Arrivals,
    CellPlaces,
    Figures,
    Retention,
    arrivals,
    figures,
    group_of,
    is_here,
    last_sign,
    places,
    retention,
    where_now,
)
from .spans import Span, begin_of, coarser, edges_of, midnight_of
from .stations import sets_of, stations_of
from .times import Times, kind_of, times_of, wait_of

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from ....store.engine import Database, Tx
    from ....store.monitor import At, Run, Timed
    from ...config import StudyConfig
    from .stations import Stations

FRESH = timedelta(seconds=2.5)
SAMPLE = 64
"""Times are taken from at most about so many people, evenly over the span: enough for a median, quick at any size."""
ROWS = 10
MOST_ROWS = 200
MOST_WATCHERS = 60
REMEMBERED = 64


@dataclass(frozen=True, slots=True)
class View:
    """What is looked at: the span of time, whose participations, and whether all of those in the study are listed.

    Without `who` it is those of the pilot while the study is in it, else the people who count.
    """

    span: Span = "today"
    who: Who | None = None
    everyone: bool = False


@dataclass(frozen=True, slots=True)
class Person:
    """Somebody who is in the study now."""

    number: int
    name: str
    group: str
    device: str
    done: float
    """How many of `sets` are behind them, the present one in part."""
    sets: int
    at: str
    started: datetime
    last: datetime
    wait_ms: float | None
    away: bool


@dataclass(frozen=True, slots=True)
class Look:
    """Everything that the monitor shows, at one moment. Its parts are compared to see what has changed."""

    moment: datetime
    view: View
    lease_minutes: int
    arrived: int
    figures: Figures
    arrivals: Arrivals
    where: tuple[tuple[str, int], ...]
    retention: Retention
    times: Times
    places: tuple[CellPlaces, ...]
    people: tuple[Person, ...]


@dataclass
class Monitor:
    """Looks at studies, for pages and for those who watch."""

    database: Database
    most_watchers: int = MOST_WATCHERS
    closed: threading.Event = field(default_factory=threading.Event)
    _watching: int = 0
    _lock: threading.Lock = field(default_factory=threading.Lock)
    _looks: OrderedDict[tuple[str, View], _Kept] = field(default_factory=OrderedDict)

    def look(self, study_id: str, view: View) -> Look:
        """Return how a study goes now.

        Raises:
            NotFoundError: no such study.
        """
        return self._kept(study_id, view).renew(self.database, study_id, view)

    def glance(self, study_id: str, view: View) -> Look:
        """Return how a study went a moment ago: everybody who watches it shares one look.

        Raises:
            NotFoundError: no such study.
        """
        return self._kept(study_id, view).fresh(self.database, study_id, view)

    def check_watchers(self) -> None:
        """Refuse whom `watching` would refuse.

        Raises:
            UnavailableError: too many watch already, or the server is about to stop.
        """
        with self.watching():
            pass

    @contextmanager
    def watching(self) -> Iterator[None]:
        """Count somebody who watches while the block runs.

        Raises:
            UnavailableError: too many watch already, or the server is about to stop.
        """
        with self._lock:
            if self.closed.is_set() or self._watching >= self.most_watchers:
                raise UnavailableError("Too many pages are watching. Reload this one to see the present numbers.", 15)
            self._watching += 1
        try:
            yield
        finally:
            with self._lock:
                self._watching -= 1

    def close(self) -> None:
        """Tell all who watch that the server is about to stop."""
        self.closed.set()

    def _kept(self, study_id: str, view: View) -> _Kept:
        with self._lock:
            kept = self._looks.setdefault((study_id, view), _Kept())
            self._looks.move_to_end((study_id, view))
            while len(self._looks) > REMEMBERED:
                self._looks.popitem(last=False)
            return kept


class _Kept:
    """The last look at one study; whoever comes while it is being taken waits for it."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._look: Look | None = None

    def renew(self, database: Database, study_id: str, view: View) -> Look:
        with self._lock:
            self._look = _look(database, study_id, view)
            return self._look

    def fresh(self, database: Database, study_id: str, view: View) -> Look:
        with self._lock:
            if self._look is None or now() - self._look.moment >= FRESH:
                self._look = _look(database, study_id, view)
            return self._look


@dataclass(frozen=True, slots=True)
class _Seen:
    """The rows of one look."""

    who: Who
    config: StudyConfig
    runs: Sequence[Run]
    edges: tuple[datetime, ...]
    between: int
    choices: Sequence[Timed]
    trials: Sequence[At]


def _look(database: Database, study_id: str, view: View) -> Look:
    moment = local(now())
    with database.read() as tx:
        seen = _seen(tx, study_id, view, moment)
    config, runs = seen.config, seen.runs
    stations = stations_of(config)
    sampled = {run.id for run in _sample(runs, seen.edges[0])}
    return Look(
        moment=moment,
        view=replace(view, who=seen.who),
        lease_minutes=config.lease_minutes,
        arrived=len(runs),
        figures=figures(runs, config, moment, midnight_of(moment)),
        arrivals=arrivals(runs, seen.edges, moment),
        where=where_now(runs, stations, moment),
        retention=retention(runs, config, stations, moment),
        times=times_of(
            [one for one in seen.choices if one.participation in sampled],
            coarser(seen.edges),
            seen.between,
            len(sampled),
        ),
        places=places(runs, config, moment),
        people=_people(seen, view, stations, moment),
    )


def _seen(tx: Tx, study_id: str, view: View, moment: datetime) -> _Seen:
    study, latest = studies.study(tx, study_id), studies.latest_version(tx, study_id)
    if study is None or latest is None:
        raise NotFoundError("There is no such study.", field="study", got=study_id)
    config = parsed(latest)
    who: Who = view.who or ("pilot" if study.status == "pilot" else "people")
    runs = monitor.runs_of(tx, study_id, who)
    edges = _edges(runs, view, moment)
    listed = [run.id for run in _listed(runs, view, moment)]
    ids = {*listed, *(run.id for run in _sample(runs, edges[0]))}
    choices = monitor.choices_of(tx, ids, edges[0])
    between = sum(last_sign(run) >= edges[0] for run in runs)
    return _Seen(who, config, runs, edges, between, choices, monitor.trials_at(tx, listed))


def _edges(runs: Sequence[Run], view: View, moment: datetime) -> tuple[datetime, ...]:
    end = moment if view.span != "all" or not runs else _end(runs, moment)
    today = [run.arrived_at for run in runs if view.span != "today" or run.arrived_at >= midnight_of(moment)]
    return edges_of(begin_of(view.span, end, min(today, default=None)), end)


def _end(runs: Sequence[Run], moment: datetime) -> datetime:
    """Return when the whole study ends: now, or when the last one was heard of if nobody is in it."""
    if any(is_here(run, moment) for run in runs):
        return moment
    return local(max(map(last_sign, runs)))


def _sample(runs: Sequence[Run], begin: datetime) -> list[Run]:
    """Return every nth of the people heard of since `begin`; n is a power of two, so that it seldom changes."""
    within = [run for run in runs if last_sign(run) >= begin]
    every = 1
    while len(within) / every > SAMPLE:
        every *= 2
    return [run for run in within if run.number % every == 0]


def _listed(runs: Sequence[Run], view: View, moment: datetime) -> list[Run]:
    """Return those in the study now who are listed, the newest first."""
    here = [run for run in reversed(runs) if is_here(run, moment)]
    return here[: MOST_ROWS if view.everyone else ROWS]


def _people(seen: _Seen, view: View, stations: Stations, moment: datetime) -> tuple[Person, ...]:
    last = {choice.participation: choice for choice in seen.choices}
    at = {one.participation: one for one in seen.trials}
    sets = sets_of(seen.config)
    return tuple(
        _person(run, last.get(run.id), at.get(run.id), _Course(seen.config, stations, sets, moment))
        for run in _listed(seen.runs, view, moment)
    )


@dataclass(frozen=True, slots=True)
class _Course:
    config: StudyConfig
    stations: Stations
    sets: int
    moment: datetime


def _person(run: Run, last: Timed | None, at: At | None, course: _Course) -> Person:
    generation, ends = (at.generation, at.last_generation) if at else (0, None)
    practised = course.config.practice is not None
    begun = run.step not in {"consent", "instructions", "practice"}
    whole = max(run.position - practised, 0) if begun else 0
    pages = (course.config.generations if ends is None else ends) + 1
    part = (generation + (run.step == "rating")) / pages if begun else 0
    return Person(
        number=run.number,
        name=name_of(run.number),
        group=group_of(run),
        device=(run.device or (kind_of(last) if last else "")).capitalize() or "Unknown",
        done=whole + min(part, 1),
        sets=course.sets,
        at=_at(run, generation, course.stations.name(run)),
        started=run.arrived_at,
        last=last_sign(run),
        wait_ms=wait_of(last) if last else None,
        away=course.moment - last_sign(run) >= AWAY,
    )


def _at(run: Run, generation: int, station: str) -> str:
    short = station.replace("Face set", "Set")
    match run.step:
        case "evolve":
            return f"{short}, generation {generation}" if generation else f"{short}, first faces"
        case "rating":
            return f"{short}, questions"
        case "rate" | "categorise" | "questionnaire":
            return f"{short}, item {generation + 1}"
        case _:
            return short
