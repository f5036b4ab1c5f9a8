"""Where runs are made: a rig on one head, its metrics, its targets, and the faces that metrics learn from."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from emogen_core.correctives.pipeline import shape_weights
from emogen_core.similarity.catalogue import Material, Metric
from emogen_core.simulation.complexity import named
from emogen_core.simulation.evaluation.judges import judge
from emogen_core.simulation.evaluation.learning import HAPPY, Made, made_by_people, starts
from emogen_core.simulation.evaluation.targets import EMOTIONS, SEED, targets
from emogen_core.simulation.learners import learned
from emogen_core.simulation.participant import selection_count
from emogen_core.simulation.runs import Elites, Experiment, chunk

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from numpy.typing import NDArray

    from emogen_core.face.rig import Rig
    from emogen_core.search.params import SearchParams
    from emogen_core.simulation.evaluation.specs import Algorithm, ResultName, RunSpec, Selections
    from emogen_core.simulation.learners import Learned

    Genomes = NDArray[np.float64]

SELECTIONS: dict[Selections, Callable[[int], int]] = {
    "paper": selection_count,
    "three": lambda _generation: 3,
    "elite": lambda _generation: 1,
}
MEAN_HAPPY = "mean happy"
_GENE_STREAM = 5


@dataclass(eq=False)
class Laboratory:
    """Makes runs. Weights are those of all shapes with the combinational correctives of the rig.

    Collision correctives are left out of the searches: they would cost a hundred times the search itself. What they
    change on what is found is a table of its own (`beyond.collisions`).

    Attributes:
        rig: the face model.
        identity: the head that wears it.
        seed: of the searches; targets, and what people made before, belong to the rig.
        params: the search, for example that of a study.
        pause: called before every batch of faces, by those who share a processor with people.
        drawn: (S, 10, G) fixed first populations one of which every search of a study draws; None without a choice.
        algorithm: of a study's own search, for what is simulated of it.
        result: what that search ends with. With `estimate` it follows the best faces as one more.
        starts: fixed first populations by name, (10, G).
    """

    rig: Rig
    identity: str
    seed: int
    params: SearchParams
    pause: Callable[[], object] | None = None
    drawn: Genomes | None = None
    algorithm: Algorithm = "emogen"
    result: ResultName = "elite"
    starts: dict[str, Genomes] = field(init=False)
    _targets: dict[str, Genomes] = field(init=False)
    _made: dict[str, Made] = field(default_factory=dict, init=False)
    _metrics: dict[str, Metric] = field(default_factory=dict, init=False)

    def __post_init__(self) -> None:
        """Draw what belongs to the rig."""
        self.starts = dict(starts(self.rig, self.params))
        self._targets = targets(self.rig, self.params.active)

    def __getstate__(self) -> dict[str, Any]:
        """Return what another process needs; offsets, the largest part, are made there again if they are needed."""
        return {name: value for name, value in self.__dict__.items() if name != "offsets"}

    @cached_property
    def offsets(self) -> NDArray[np.float32]:
        """(K, N, 3) offsets of the shapes as the head wears them, millimetres."""
        return self.rig.shape_offsets(self.identity)

    @property
    def training(self) -> NDArray[np.float32]:
        """(M, K) weights that the empirical metrics learn from: all elites of the people of four emotions."""
        return np.concatenate([self.made(emotion).elites for emotion in EMOTIONS])

    def made(self, emotion: str) -> Made:
        """Return what people with an emotion in mind made, simulated once."""
        if emotion not in self._made:
            self._made[emotion] = made_by_people(self.rig, self.params, self.faces, emotion)
        return self._made[emotion]

    def prepare(self, specs: Iterable[RunSpec]) -> None:
        """Make what runs need before they can begin, so that it is not made in every process."""
        for spec in specs:
            self.target(spec.target)
            self.metric(spec.metric)

    def faces(self, genes: Genomes) -> NDArray[np.float32]:
        """Return the (B, K) weights of (B, G) genomes."""
        if self.pause is not None:
            self.pause()
        return shape_weights(self.rig, genes)

    def target(self, name: str) -> Genomes:
        """Return a target by its name: a (G,) genome, or (R, G), one a search.

        Raises:
            KeyError: there is none of this name.
        """
        if name == MEAN_HAPPY and name not in self._targets:
            self._targets[name] = self.made(HAPPY).genes.mean(0)
        if name not in self._targets:
            self._targets[name] = named(self.rig, self.params.active, name)
        return self._targets[name]

    def meant(self, spec: RunSpec) -> Genomes:
        """Return the target of a run, as far as its search can reach it."""
        target = self.target(spec.target)
        return (target[: spec.minds] if spec.minds else target) * self._reach(spec)

    def even(self, spec: RunSpec) -> Genomes:
        """Return the (G,) genome in which all genes of a run are the same: nothing is known of what was meant."""
        return 0.5 * self._reach(spec)

    def metric(self, name: str) -> Metric:
        """Return a metric of the catalogue or of a judge beyond it, made from this laboratory's material.

        Raises:
            InvalidInputError: there is none of this name.
        """
        if name not in self._metrics:
            shapes = len(self.rig.shape_names)
            material = Material(self.rig.gene_to_core, shapes, lambda: self.offsets, lambda: self.training)
            self._metrics[name] = judge(name, material)
        return self._metrics[name]

    def experiment(self, spec: RunSpec) -> Experiment:
        """Return a run with everything that it needs.

        Raises:
            InvalidInputError: options that the search cannot run with.
        """
        start = {"initialisation": "fixed", "fixed_population": _rows(self.starts[spec.start])} if spec.start else {}
        params = self.params.limited(self._genes(spec.genes)) if spec.genes else self.params
        return Experiment(
            replace(params, **{**spec.search, **start}),
            self.faces,
            self.metric(spec.metric),
            self.meant(spec),
            spec.observer,
            SELECTIONS[spec.selections],
            spec.algorithm == "pressure",
            None if spec.start else self.drawn,
        )

    def chunk(self, spec: RunSpec, number: int, searches: int) -> Elites:
        """Return one chunk of a run."""
        if spec.learns:
            made = self.learned(spec, number, searches)
            return made.elites if self.result == "elite" else made.estimated
        return chunk(self.experiment(spec), spec.entropy(self.seed), number, searches)

    def learned(self, spec: RunSpec, number: int, searches: int) -> Learned:
        """Return one chunk of a run whose searches learn."""
        begun = number * spec.chunk
        return learned(self.experiment(spec), spec.entropy(self.seed), range(begun, begun + searches))

    def _reach(self, spec: RunSpec) -> Genomes:
        """Return (G,) ones where a run's search moves a gene."""
        reach = np.zeros(self.params.gene_count)
        reach[self._genes(spec.genes) if spec.genes else list(self.params.active)] = 1
        return reach

    def _genes(self, count: int) -> list[int]:
        """Return this many genes: those of the richest target first, then others in an order drawn once."""
        rich = set(np.flatnonzero(self.target("target 2")))
        order = np.random.default_rng((SEED, _GENE_STREAM)).permutation(self.params.active)
        others = [i for i in order if i not in rich]
        return sorted([*rich, *others][: max(count, len(rich))])


def _rows(population: Genomes) -> tuple[tuple[float, ...], ...]:
    return tuple(tuple(row) for row in population.tolist())
