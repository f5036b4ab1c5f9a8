"""Portraits of recorded faces, drawn again from their weights."""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

from ...faces.sketch import Sketch, settings_of, unpack_weights

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator
    from concurrent.futures import Future

    from emogen_core.rendering.protocol import RenderSettings

    from ...faces.portraits import PortraitDrawer
    from ...faces.wardrobe import Wardrobe
    from .recorded import Recorded

Waiting = tuple[str, "Future[bytes]"]
Which = Literal["finished", "best", "all", "estimates"]
AHEAD = 64
"""Pictures that are asked for before the first of them is taken."""


@dataclass(frozen=True)
class Album:
    """Draws the faces of recorded participations."""

    drawer: PortraitDrawer
    wardrobe: Wardrobe

    def pictures(self, people: Iterable[Recorded], which: Which) -> Iterator[tuple[str, bytes]]:
        """Yield name and PNG of the faces that ended a trial, of the best of every generation, of all, or of estimates.

        Raises:
            RenderingError: this machine cannot draw.
        """
        waiting: deque[Waiting] = deque()
        for name, sketch in (found for one in people for found in _sketches(one, which)):
            self.wardrobe.wait(sketch.identity)
            waiting.append((name, self.drawer.submit(sketch, 0, self.wardrobe.head(sketch.identity))))
            if len(waiting) == AHEAD:
                yield _taken(waiting)
        while waiting:
            yield _taken(waiting)


def _taken(waiting: deque[Waiting]) -> tuple[str, bytes]:
    name, picture = waiting.popleft()
    return name, picture.result()


def _sketches(recorded: Recorded, which: Which) -> Iterator[tuple[str, Sketch]]:
    """Yield name and face: participation, trial, then attempt, generation and slot."""
    settings = settings_of(recorded.config)
    if which == "estimates":
        yield from _estimates(recorded, settings)
        return
    for trial, shown in recorded.trials:
        for generation, faces, choice in shown:
            best = choice.elite_face_id if choice else None
            for face in faces:
                if which == "all" or face.id == (trial.final_face_id if which == "finished" else best):
                    place = f"{generation.attempt}-{generation.number:02d}-{face.slot:02d}"
                    name = f"{recorded.participation}/{trial.position:02d}-{place}.png"
                    yield name, Sketch(face.identity, unpack_weights(face.weights), settings)


def _estimates(recorded: Recorded, settings: RenderSettings) -> Iterator[tuple[str, Sketch]]:
    """Yield name and face of what the search itself took for the faces in mind."""
    for trial, _ in recorded.trials:
        found = recorded.estimates.get(trial.id)
        if found is not None:
            name = f"{recorded.participation}/{trial.position:02d}-estimate.png"
            yield name, Sketch(found.identity, unpack_weights(found.weights), settings)
