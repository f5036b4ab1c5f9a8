"""Who is where in a study, from its participations: counts with their denominators. Pure."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass
from datetime import datetime, timedelta
from statistics import quantiles
from typing import TYPE_CHECKING

from ...participation.assignment import cells
from .stations import INSTRUCTIONS

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from ....store.monitor import Run
    from ...config import StudyConfig
    from .stations import Stations

AWAY = timedelta(minutes=5)
COURSE_DAYS = 365
LEAST_FOR_COURSE = 3


@dataclass(frozen=True, slots=True)
class Figures:
    """Key figures of the whole study; `today` counts since midnight, `most` is how many were there at once today."""

    here: int
    most: int
    most_at: datetime | None
    complete: int
    quota: int | None
    today: int
    left: int
    middle_half: tuple[float, float, float] | None
    """Quartiles of the seconds from arrival to the end, of those who completed."""
    full_on: datetime | None
    withdrew: int


@dataclass(frozen=True, slots=True)
class CellPlaces:
    """The places of one condition."""

    condition: str
    complete: int
    leased: int
    quota: int | None

    @property
    def over(self) -> int:
        """How many have a place beyond the quota."""
        return 0 if self.quota is None else max(self.complete + self.leased - self.quota, 0)


@dataclass(frozen=True, slots=True)
class Kept:
    """How many of a group's people who finished or left reached each station."""

    name: str
    reached: tuple[int, ...]

    @property
    def people(self) -> int:
        """How many finished or left."""
        return self.reached[0]


@dataclass(frozen=True, slots=True)
class Retention:
    """Who still took part at each station, by group."""

    stations: tuple[str, ...]
    groups: tuple[Kept, ...]


@dataclass(frozen=True, slots=True)
class Arrivals:
    """Arrivals and completions in equal spans of time; `edges` has one more entry than the counts."""

    edges: tuple[datetime, ...]
    arrived: tuple[int, ...]
    complete: tuple[int, ...]
    left: int


def is_here(run: Run, moment: datetime) -> bool:
    """Return whether somebody is in the study now: running on a lease."""
    return run.outcome is None and run.lease_until is not None and run.lease_until > moment


def has_left(run: Run, moment: datetime) -> bool:
    """Return whether somebody left early: did not finish, and pressed Stop or was quiet until the lease ended."""
    return run.outcome == "stopped" or (run.outcome is None and not is_here(run, moment))


def figures(runs: Sequence[Run], config: StudyConfig, moment: datetime, midnight: datetime) -> Figures:
    """Return the key figures."""
    finished = [run for run in runs if run.outcome == "complete" and run.ended_at]
    most, most_at = _peak(runs, moment, midnight)
    quota = wanted(config.quota, [one.quota for one in config.conditions])
    return Figures(
        here=sum(is_here(run, moment) for run in runs),
        most=most,
        most_at=most_at,
        complete=len(finished),
        quota=quota,
        today=sum(_ended(run) >= midnight for run in finished),
        left=sum(has_left(run, moment) for run in runs),
        middle_half=_quartiles([(_ended(run) - run.arrived_at).total_seconds() for run in finished]),
        full_on=_course(finished, quota, moment),
        withdrew=sum(run.outcome == "erased" for run in runs),
    )


def places(runs: Sequence[Run], config: StudyConfig, moment: datetime) -> tuple[CellPlaces, ...]:
    """Return the places of every condition of the study, and of those that older versions had."""
    complete = Counter(run.condition for run in runs if run.outcome == "complete")
    leased = Counter(run.condition for run in runs if is_here(run, moment))
    quotas = {one.name: one.quota for one in config.conditions}
    names = dict.fromkeys([cell.condition for cell in cells(config)] + [run.condition for run in runs])
    return tuple(CellPlaces(name, complete[name], leased[name], quotas.get(name)) for name in names)


def where_now(runs: Sequence[Run], stations: Stations, moment: datetime) -> tuple[tuple[str, int], ...]:
    """Return how many are at each station now."""
    there = Counter(stations.at(run) for run in runs if is_here(run, moment))
    return tuple((name, there[at]) for at, name in enumerate(stations.names[:-1]))


def retention(runs: Sequence[Run], config: StudyConfig, stations: Stations, moment: datetime) -> Retention:
    """Return how far those came who finished or left, by condition, and by head where people differ in it."""
    shown = [at for at, name in enumerate(stations.names) if name not in {INSTRUCTIONS, "Practice"}]
    far: dict[str, list[int]] = {_group(cell.condition, cell.head): [] for cell in cells(config)}
    for run in runs:
        if run.outcome == "complete" or has_left(run, moment):
            far.setdefault(group_of(run), []).append(stations.at(run))
    groups = [Kept(name, tuple(sum(reached >= at for reached in one) for at in shown)) for name, one in far.items()]
    return Retention(tuple(stations.names[at] for at in shown), tuple(groups))


def arrivals(runs: Sequence[Run], edges: Sequence[datetime], moment: datetime) -> Arrivals:
    """Return how many arrived and completed in each span between edges."""
    within = [run for run in runs if edges[0] <= run.arrived_at <= edges[-1]]
    return Arrivals(
        tuple(edges),
        _histogram((run.arrived_at for run in runs), edges),
        _histogram((_ended(run) for run in runs if run.outcome == "complete"), edges),
        sum(has_left(run, moment) for run in within),
    )


def wanted(quota: int | None, of_conditions: Sequence[int | None]) -> int | None:
    """Return how many people a study wants: its own quota, or that of its conditions where all have one."""
    together = sum(filter(None, of_conditions)) if of_conditions and None not in of_conditions else None
    return min((limit for limit in (quota, together) if limit is not None), default=None)


def last_sign(run: Run) -> datetime:
    """Return when somebody was last heard of."""
    return run.last_answer_at or run.ended_at or run.arrived_at


def _ended(run: Run) -> datetime:
    return run.ended_at or last_sign(run)


def group_of(run: Run) -> str:
    """Return the condition of a person, with the head where people differ in it."""
    return _group(run.condition, run.head)


def _group(condition: str, head: str) -> str:
    return condition if head in {"", condition} else f"{condition}, {head}"


def _peak(runs: Sequence[Run], moment: datetime, midnight: datetime) -> tuple[int, datetime | None]:
    """Return how many were in the study at once at most since midnight, and when first."""
    changes: list[tuple[datetime, int]] = []
    for run in runs:
        until = moment if is_here(run, moment) else _ended(run)
        if until >= midnight:
            changes += [(max(run.arrived_at, midnight), 1), (until, -1)]
    if not changes:
        return 0, None
    most, most_at, there = 0, None, 0
    for at, change in sorted(changes, key=lambda one: (one[0], -one[1])):
        there += change
        if there > most:
            most, most_at = there, at
    return most, most_at


def _quartiles(seconds: Sequence[float]) -> tuple[float, float, float] | None:
    if len(seconds) < 2:
        return (seconds[0], seconds[0], seconds[0]) if seconds else None
    low, middle, high = quantiles(seconds, n=4, method="inclusive")
    return low, middle, high


def _course(finished: Sequence[Run], quota: int | None, moment: datetime) -> datetime | None:
    """Return when the study is full if it goes on as in the last three days; one or two people are no course yet."""
    if quota is None or not LEAST_FOR_COURSE <= len(finished) < quota:
        return None
    began = max(min(run.arrived_at for run in finished), moment - timedelta(days=3))
    lately = sum(_ended(run) >= began for run in finished)
    days = max((moment - began).total_seconds() / 86_400, 0.25)
    ahead = (quota - len(finished)) * days / lately if lately else COURSE_DAYS
    return (moment + timedelta(days=ahead)).replace(minute=0, second=0, microsecond=0) if ahead < COURSE_DAYS else None


def _histogram(moments: Iterable[datetime], edges: Sequence[datetime]) -> tuple[int, ...]:
    # Every span is as long as the first: edges are equally far apart.
    width = (edges[1] - edges[0]).total_seconds()
    counts = [0] * (len(edges) - 1)
    for moment in moments:
        at = int((moment - edges[0]).total_seconds() // width)
        if 0 <= at < len(counts):
            counts[at] += 1
    return tuple(counts)
