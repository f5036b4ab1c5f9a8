"""What is to be simulated, as plain data: a run can be named, sent to another process, and made there."""

from __future__ import annotations

import hashlib
import json
from dataclasses import asdict, dataclass, field
from typing import TYPE_CHECKING, Any, Literal

from emogen_core.simulation import learners, runs
from emogen_core.simulation.observer import Observer

if TYPE_CHECKING:
    from collections.abc import Mapping

Selections = Literal["paper", "three", "elite"]
"""How many faces are selected: 2, then 4, then 5; always three; only the best."""
Algorithm = Literal["emogen", "pressure", "preference"]
"""The published search; with more selection pressure; the one that learns from every choice."""
LEARNING: frozenset[Algorithm] = frozenset({"preference"})
"""Those that learn from every choice: a thousand times slower than the others, and with an estimate of their own."""
ResultName = Literal["elite", "estimate"]
"""What a search ends with: the face last chosen as best, or its own estimate of the face in mind."""


@dataclass(frozen=True)
class RunSpec:
    """Searches for one target, or for one target each.

    Attributes:
        target: name of a target of the laboratory.
        metric: name in the catalogue or of a judge beyond it (`judges`), by which the participant judges.
        search: options of the search other than the rig's defaults, for example ``{"activation": (1, 3)}``.
        selections: how many faces are selected in each generation.
        observer: how well the participant judges.
        algorithm: that searches.
        start: name of a fixed first population; empty for the protocol.
        genes: how many genes the search has, 0 for all; the target has no others then.
        minds: of a target of one face a search, how many of the first there are, 0 for all.
    """

    target: str
    metric: str = "cosine"
    search: Mapping[str, Any] = field(default_factory=dict)
    selections: Selections = "paper"
    observer: Observer = field(default_factory=Observer)
    algorithm: Algorithm = "emogen"
    start: str = ""
    genes: int = 0
    minds: int = 0

    @property
    def key(self) -> str:
        """Return what stands for this run: equal runs have equal keys, so no table pays for another's run again."""
        return json.dumps(asdict(self), sort_keys=True, default=list)

    @property
    def learns(self) -> bool:
        """Return whether the search learns from every choice."""
        return self.algorithm in LEARNING

    @property
    def chunk(self) -> int:
        """Return how many searches are made at a time; those that learn take long and go by single streams."""
        return learners.CHUNK if self.learns else runs.CHUNK

    def entropy(self, seed: int) -> tuple[int, int]:
        """Return the entropy of this run's numbers: the same for all runs with the same target and start.

        So what is compared, settings or participants, begins with the same faces and has the same luck as far as it
        draws the same numbers, and a difference shows in fewer searches.
        """
        own = hashlib.sha256(json.dumps([self.target, self.start]).encode()).digest()[:8]
        return seed, int.from_bytes(own, "big")
