"""One drawing process of the pool: `python -m emogen_core.rendering.worker FD BACKEND RIG LOOK`.

It speaks over one inherited socket: first ("ready", (rig hash, look hash)) or ("failed", kind, sentence). Then it is
told ("draw", identity, (B, K) weights, settings), ("wear", `WornHead`) or ("drop", name of a head), and answers
("done", [PNG, ...]), ("done", None) or ("failed", kind, sentence). Which heads it keeps is for the pool to say. It
ends when the socket closes, so it never outlives its pool, and after a bug, which leaves its GL state in doubt: the
pool is told the sentence, the log has the traceback, and another process takes its place.
"""

from __future__ import annotations

import sys
from contextlib import contextmanager, suppress
from importlib import import_module
from multiprocessing.connection import Connection
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from emogen_core.errors import EmogenError, MissingGLError
from emogen_core.rendering.png import encode_png
from emogen_core.rendering.protocol import RenderSettings
from emogen_core.rendering.setup import load_dressed, renderer_for

if TYPE_CHECKING:
    from collections.abc import Iterator

    from emogen_core.rendering.protocol import Renderer


def main(arguments: list[str]) -> None:
    """Serve one pool until its end of the socket closes."""
    socket = Connection(int(arguments[0]))
    # A pool that has gone needs no answer.
    with suppress(BrokenPipeError), _telling(socket):
        renderer, hashes = _start(*arguments[1:])
        socket.send(("ready", hashes))
        _serve(socket, renderer)


@contextmanager
def _telling(socket: Connection) -> Iterator[None]:
    """Tell the pool what ends this process."""
    try:
        yield
    except EmogenError as error:
        socket.send(_failure(error))
    except Exception as error:
        socket.send(_failure(error))
        raise


def _start(backend: str, rig: str, look: str) -> tuple[Renderer, tuple[str, str]]:
    if ":" in backend:
        module, name = backend.split(":")
        return getattr(import_module(module), name)(), ("", "")
    known, worn = load_dressed(Path(rig) if rig else None, Path(look) if look else None)
    renderer = renderer_for(backend, known, worn)
    weights = np.zeros((1, len(known.shape_names)), np.float32)
    renderer.draw(known.identities[0], weights, RenderSettings())
    return renderer, (known.hash, worn.hash)


def _serve(socket: Connection, renderer: Renderer) -> None:
    while True:
        try:
            order = socket.recv()
        except EOFError:
            return
        try:
            answer: tuple[Any, ...] = ("done", _obey(renderer, *order))
        except EmogenError as error:
            answer = _failure(error)
        socket.send(answer)


def _obey(renderer: Renderer, what: str, *given: Any) -> list[bytes] | None:
    if what == "draw":
        return [encode_png(picture) for picture in renderer.draw(*given)]
    (renderer.wear if what == "wear" else renderer.drop)(*given)
    return None


def _failure(error: Exception) -> tuple[str, str, str]:
    kind = "gl" if isinstance(error, MissingGLError) else "input" if isinstance(error, EmogenError) else "bug"
    return "failed", kind, str(error) if kind != "bug" else f"{type(error).__name__}: {error}"


if __name__ == "__main__":
    main(sys.argv[1:])
