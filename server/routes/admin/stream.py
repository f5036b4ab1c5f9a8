"""Updates of a page while it is looked at: server-sent events, from one look that all who watch a study share."""

from __future__ import annotations

import asyncio
import json
from typing import TYPE_CHECKING, Any

from starlette.concurrency import run_in_threadpool as run

from ...services.errors import ServiceError

if TYPE_CHECKING:
    from collections.abc import AsyncIterator, Awaitable, Callable

    from ...services.reports.monitor.monitor import Monitor

TICK = 3.0
STEP = 0.25
"""How soon a stream notices that the server is about to stop."""
CHECKS = 5
"""After so many ticks it is asked again whether the watcher is still signed in."""
TICKS = 400
"""Then the stream ends, and the browser opens a new one: nobody holds one for ever."""
HEADERS = {"Content-Type": "text/event-stream", "Cache-Control": "no-store", "X-Accel-Buffering": "no"}


async def updates(
    monitor: Monitor,
    parts: Callable[[], dict[str, Any]],
    signed_in: Callable[[], object],
    gone: Callable[[], Awaitable[bool]],
) -> AsyncIterator[str]:
    """Yield what changes of a page, as server-sent events, until the watcher goes or the server stops.

    Args:
        monitor: counts its watchers.
        parts: returns the present parts of the page, by name; only those that differ from what was sent are sent.
        signed_in: raises when the session has ended.
        gone: says whether the watcher has gone.
    """
    try:
        with monitor.watching():
            yield f"retry: {int(TICK * 1000)}\n\n"
            known: dict[str, Any] = {}
            for tick in range(TICKS):
                if tick % CHECKS == 0:
                    await run(signed_in)
                present = await run(parts)
                yield _event("look", {name: part for name, part in present.items() if known.get(name) != part})
                known = present
                if await _over(monitor, gone):
                    return
    except ServiceError as error:
        yield _event("end", {"why": error.message})


async def _over(monitor: Monitor, gone: Callable[[], Awaitable[bool]]) -> bool:
    """Wait for the next tick; return whether it is over."""
    for _ in range(round(TICK / STEP)):
        if monitor.closed.is_set() or await gone():
            return True
        await asyncio.sleep(STEP)
    return monitor.closed.is_set()


def _event(name: str, body: dict[str, Any]) -> str:
    return f"event: {name}\ndata: {json.dumps(body)}\n\n"
