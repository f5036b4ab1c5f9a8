"""A long computation in a process of its own: it gives way to everybody else, and ends where the server does."""

from __future__ import annotations

import os
from multiprocessing import get_context
from typing import TYPE_CHECKING, ParamSpec, TypeVar

from .errors import UnavailableError

if TYPE_CHECKING:
    import threading
    from collections.abc import Callable
    from multiprocessing.connection import Connection

P = ParamSpec("P")
T = TypeVar("T")

NICE = 10
"""How far it stands back behind the processes of the server."""
_GLANCE = 0.1


def made_aside(stopped: threading.Event, make: Callable[P, T], *given: P.args, **named: P.kwargs) -> T:
    """Return what a function of a module gives for arguments that can be sent to a process.

    Args:
        stopped: ends it when it is set.
        make: the function.
        given: its arguments.
        named: its arguments by name.

    Raises:
        UnavailableError: the server is stopping, or the process failed; its own words are in the server's log.
    """
    context = get_context("spawn")
    here, there = context.Pipe(duplex=False)
    process = context.Process(target=_make, args=(there, make, given, named), daemon=True)
    process.start()
    there.close()
    try:
        while not here.poll(_GLANCE):
            if stopped.is_set():
                raise UnavailableError("The server is stopping.")
        made: T = here.recv()
        return made
    except EOFError as error:
        raise UnavailableError("A simulation ended before it was done; the server's log says why.") from error
    finally:
        process.kill()
        process.join()
        here.close()


def _make(there: Connection, make: Callable[..., object], given: tuple[object, ...], named: dict[str, object]) -> None:
    if hasattr(os, "nice"):
        os.nice(NICE)
    there.send(make(*given, **named))
    there.close()
