"""What every part of the analysis is given: faces, noise, mean faces, and random numbers of its own."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from emogen_core.analysis.cells import summaries

from .head_names import head_names
from .section import Column
from .simulated import group
from .telling import lacking

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from numpy.typing import NDArray

    from emogen_core.analysis.cells import Corrected, Summary
    from emogen_core.analysis.enough import Result
    from emogen_core.analysis.recorded import Cell, Faces
    from emogen_core.face.rig import Rig
    from emogen_core.simulation.evaluation.groups import Noises

    from .faces import Studio
    from .reading import Recording
    from .section import Value
    from .simulated import Crowd, Simulated


@dataclass(frozen=True)
class Context:
    """An analysis.

    Attributes:
        recording: what was read.
        rig: the face model.
        simulated: the searches of the study.
        corrected: the pipeline.
        seed: of all that draws.
        studio: draws faces; none where this machine cannot.
    """

    recording: Recording
    rig: Rig
    simulated: Simulated
    corrected: Corrected
    seed: int
    studio: Studio | None

    @cached_property
    def faces(self) -> Faces:
        """The first face of everybody for an emotion on a head: retests are left out, since noise is of one search."""
        return self.recording.faces.only(repetition=0)

    @cached_property
    def cells(self) -> tuple[tuple[Cell, Faces], ...]:
        """Every cell with its first faces."""
        return tuple(self.faces.by_cell())

    @cached_property
    def summaries(self) -> tuple[Summary, ...]:
        """What the faces of every cell have in common."""
        return summaries(self.faces, self.corrected)

    @cached_property
    def conditions(self) -> tuple[str, ...]:
        """The conditions that there are faces of; one without a name where the study has none."""
        return tuple(sorted(set(self.faces.conditions.tolist())))

    @cached_property
    def identities(self) -> tuple[str, ...]:
        """The heads, in the order in which faces are sorted."""
        return tuple(dict.fromkeys(self.faces.identities.tolist()))

    @cached_property
    def emotions(self) -> tuple[str, ...]:
        """The emotions, in the study's order."""
        return tuple(dict.fromkeys(self.faces.emotions.tolist()))

    def noise(self, cell: Cell) -> Noises:
        """Return the noise of the search by which most faces of a cell were found."""
        return self.simulated.thresholds[self.recording.searches_of(cell)[0]]

    def crowd(self, cell: Cell) -> Crowd:
        """Return simulated people of one face in mind by the same search, as many as there are in a cell."""
        return self.simulated.crowds[group(self.recording, cell)]

    @property
    def mixed(self) -> tuple[str, ...]:
        """A sentence for every cell whose faces were found by several searches: its noise is that of most of them."""
        return tuple(
            f"{self.label(cell)}: faces were found by {count} different searches; the simulated distances are of the"
            " one that found most of them."
            for cell, _ in self.cells
            if (count := len(self.recording.searches_of(cell))) > 1
        )

    def rng(self, *place: int) -> np.random.Generator:
        """Return random numbers that depend on the seed and on what they are for, not on what was drawn before."""
        return np.random.default_rng(np.random.SeedSequence(self.seed, spawn_key=place))

    @property
    def key_columns(self) -> tuple[Column, ...]:
        """The columns that name a cell."""
        return (Column("emotion"), Column("head"), *((Column("condition"),) if self.conditions != ("",) else ()))

    def key(self, cell: Cell) -> tuple[Value, ...]:
        """Return what is in these columns."""
        return tuple(cell[: len(self.key_columns)])

    def label(self, cell: Cell) -> str:
        """Return what a cell is called in figures: what is the same in all cells goes without saying."""
        varied = (True, len(self.identities) > 1, len(self.conditions) > 1)
        names = (cell.emotion, self.head(cell.identity), cell.condition)
        return ", ".join(name for name, wanted in zip(names, varied, strict=True) if wanted)

    def head(self, identity: str) -> str:
        """Return what people call a head; tables have it as the export has it, so that they can be joined."""
        return self.names.get(identity, identity)

    def ways(self, faces: Faces) -> tuple[NDArray[np.float64], ...]:
        """Return the best faces on the way to each face: without the estimate, which nobody chose."""
        return faces.elites if self.recording.result == "elite" else tuple(way[:-1] for way in faces.elites)

    @cached_property
    def names(self) -> Mapping[str, str]:
        """What people call the heads of the study's own."""
        return head_names(self.recording.studies, self.identities)

    def lacking(self, results: Iterable[tuple[Cell, Result]], what: str) -> tuple[str, ...]:
        """Return what is lacking of cells, a sentence for all that lack the same."""
        return lacking(((self.label(cell), result) for cell, result in results), what)
