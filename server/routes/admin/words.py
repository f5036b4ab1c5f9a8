"""Numbers and times as the admin pages write them. Pure; times of day in the zone of this machine."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ...services.clock import local

if TYPE_CHECKING:
    from datetime import datetime

NOTHING = "–"
MINUTE, HOUR, DAY = 60, 3600, 86_400


def percent(share: float | None, digits: int = 1) -> str:
    """Return a share such as 9.4 %."""
    return NOTHING if share is None else f"{share * 100:.{digits}f} %"


def seconds(ms: float | None) -> str:
    """Return milliseconds as seconds with one digit, such as 0.5 s."""
    return NOTHING if ms is None else f"{ms / 1000:.1f} s"


def lasting(total: float | None) -> str:
    """Return seconds as minutes and seconds, such as 23:40, with hours where there are some."""
    if total is None:
        return NOTHING
    whole = round(total)
    hours, rest = divmod(whole, HOUR)
    return f"{hours}:{rest // 60:02}:{rest % 60:02}" if hours else f"{rest // 60}:{rest % 60:02}"


def elapsed(since: datetime, moment: datetime) -> str:
    """Return how much time has passed, in the largest unit that fits: 6 s, 4 min, 2 h, 3 d."""
    passed = max((moment - since).total_seconds(), 0)
    for unit, name in ((DAY, "d"), (HOUR, "h"), (MINUTE, "min")):
        if passed >= unit:
            return f"{int(passed // unit)} {name}"
    return f"{int(passed)} s"


def when(past: datetime | None, moment: datetime) -> str:
    """Return when something happened, as exactly as one wants to know: 12 s ago, Yesterday, 17:40, 2 Sep 2025."""
    if past is None:
        return NOTHING
    here, there = local(moment), local(past)
    days = (here.date() - there.date()).days
    if (moment - past).total_seconds() < HOUR:
        return f"{elapsed(past, moment)} ago"
    if days == 0:
        return f"Today, {there:%H:%M}"
    if days == 1:
        return f"Yesterday, {there:%H:%M}"
    if days < 14:
        return f"{day(there)}, {there:%H:%M}"
    return day(there) if there.year == here.year else f"{day(there)} {there.year}"


def day(moment: datetime) -> str:
    """Return the day of a moment, such as 24 Nov."""
    there = local(moment)
    return f"{there.day} {there:%b}"


def time_of_day(moment: datetime) -> str:
    """Return hour and minute."""
    return f"{local(moment):%H:%M}"


def stamp(moment: datetime) -> str:
    """Return a moment to the second, such as 22 Nov 2026 14:07:31, with the name of its zone."""
    there = local(moment)
    return f"{there.day} {there:%b %Y %H:%M:%S %Z}".strip()


def initial(name: str | None) -> str:
    """Return a name with its first part shortened, such as T. Okafor."""
    first, _, rest = (name or NOTHING).partition(" ")
    return f"{first[0]}. {rest}" if rest else first


def listed(words: tuple[str, ...] | list[str]) -> str:
    """Return words as the beginning of a line, such as Anger, fear."""
    text = ", ".join(words)
    return text[:1].upper() + text[1:]
