"""From a file of feature points or coefficients to fitted frames."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Protocol, TypeVar

import numpy as np

from emogen_core.errors import InvalidInputError, expected
from emogen_core.landmarks.arkit import core_weights, unserved
from emogen_core.landmarks.bank import bank_genes, make_bank
from emogen_core.landmarks.coefficient_file import Recording, read_mediapipe, read_recording
from emogen_core.landmarks.fit import Fitter
from emogen_core.landmarks.point_file import PointFrame, are_points, read_points
from emogen_core.landmarks.rows import read_rows
from emogen_core.landmarks.solvers import make_solver
from emogen_core.rigs.landmark_head import driven_head

from .common import rig_of
from .landmark_files import Face, Fit

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

    from emogen_core.landmarks.head import DrivenHead

MOST_BYTES = 200 * 2**20
ALL = "all"


@dataclass(frozen=True, slots=True)
class Asked:
    """The options of `emogen landmarks fit`."""

    method: str
    regions: int
    emphasis: float
    rig: Path | None
    identity: str
    seed: int
    frame: str
    unit: str


class _Named(Protocol):
    @property
    def name(self) -> str: ...


AnyFrame = TypeVar("AnyFrame", bound=_Named)


def fit_file(file: Path, asked: Asked) -> Fit:
    """Return the frames of a file as faces.

    Raises:
        InvalidInputError: no such file, a file or option that is not understood, or points that no face has.
    """
    text = _text(file)
    head = driven_head(rig_of(asked.rig), asked.identity)
    if text.lstrip("\ufeff \r\n\t")[:1] in {"{", "["}:
        return _mapped(head, read_mediapipe(text), asked)
    header, rows = read_rows(text)
    if not are_points(header):
        return _mapped(head, read_recording(header, rows), asked)
    return _fitted(head, read_points(header, rows, asked.unit, head.points), asked)


def _text(file: Path) -> str:
    try:
        if file.stat().st_size > MOST_BYTES:
            raise InvalidInputError(f"{file}: {expected(f'at most {MOST_BYTES} bytes', file.stat().st_size)}")
        return file.read_text(encoding="utf-8")
    except OSError as error:
        raise InvalidInputError(f"{file}: {expected('a file to read', error.strerror)}") from None
    except UnicodeDecodeError:
        raise InvalidInputError(f"{file}: {expected('text in UTF-8', 'other bytes')}") from None


def _fitted(head: DrivenHead, frames: Sequence[PointFrame], asked: Asked) -> Fit:
    bank = None if asked.method == "rig" else make_bank(head, bank_genes(head.rig))
    fitter = Fitter(head, make_solver(asked.method, head, bank), asked.regions, asked.seed)
    faces = []
    for frame in _chosen(frames, asked.frame):
        found = fitter.fit(frame.motions.emphasised(asked.emphasis))
        told = {"fitness": found.fitness, "point_error_mm": found.point_error, "clipped": found.clipped}
        faces.append(Face(frame.name, found.core, {name: round(value, 4) for name, value in told.items()}))
    facts = {"method": asked.method, "regions": asked.regions, "emphasis": asked.emphasis, "seed": asked.seed}
    return Fit(head, tuple(faces), facts, _known_as(head, asked))


def _known_as(head: DrivenHead, asked: Asked) -> str:
    """Return what a study calls a head: of another face model, with the model's name, which is that of its file."""
    return f"{asked.rig.stem}:{head.identity}" if asked.rig else head.identity


def _mapped(head: DrivenHead, recording: Recording, asked: Asked) -> Fit:
    if not 0 < asked.emphasis <= 10:
        raise InvalidInputError(f"emphasis: {expected('a number above 0, at most 10', asked.emphasis)}")
    faces = []
    for frame in _chosen(recording.frames, asked.frame):
        core = core_weights(head.rig, frame.values)
        faces.append(Face(frame.name, np.minimum(core * asked.emphasis, 1), {}))
    facts: dict[str, Any] = {
        "method": "coefficients",
        "emphasis": asked.emphasis,
        "not_known": list(recording.unknown),
        "not_in_the_file": list(recording.missing),
        "not_on_the_rig": unserved(head.rig, recording.frames[0].values),
    }
    return Fit(head, tuple(faces), facts, _known_as(head, asked))


def _chosen(frames: Sequence[AnyFrame], wanted: str) -> Sequence[AnyFrame]:
    """Return all frames, or the one with a name, or else with a number from 1."""
    if wanted == ALL:
        return frames
    named = [frame for frame in frames if frame.name == wanted]
    if not named and wanted.isdecimal() and 1 <= int(wanted) <= len(frames):
        named = [frames[int(wanted) - 1]]
    if not named:
        names = ", ".join(frame.name for frame in frames[:5])
        raise InvalidInputError(f"frame: {expected(f'all, a number up to {len(frames)} or a name ({names})', wanted)}")
    return named[:1]
