"""The search of one trial, between the core (genes, slots) and the store (faces, places on screen)."""

from __future__ import annotations

import json
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from emogen_core.errors import InvalidInputError
from emogen_core.rendering.protocol import RenderSettings
from emogen_core.search import Choice, Population, SearchParams, State, Strategy, emogen, place_order, strategy
from emogen_core.search.params import search_params
from emogen_core.search.streams import option_of

from ...store.runs_tables import Estimate, Face, Generation
from ..clock import new_id, now
from ..config.search import BREEDING, ENDING
from ..errors import InvalidError
from ..faces.sketch import Sketch, pack_genes, pack_weights, settings_of

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from numpy.typing import NDArray

    from emogen_core.face.rig import Rig

    from ...store.runs_tables import Trial
    from ..config import StudyConfig
    from ..faces.correction import CorrectedFace, Correction


SLOTS = 10
"""Faces of a generation."""


@dataclass(frozen=True, slots=True)
class Finished:
    """Weights of all shapes and the key of the portrait."""

    weights: NDArray[np.float32]
    key: str


def params_of(rig: Rig, config: StudyConfig, state: State | None = None) -> SearchParams:
    """Return the search that a study asks for on a rig.

    Args:
        rig: the face model.
        config: the study.
        state: of a trial; says which of several fixed populations it begins with. Without it, the first.

    Raises:
        InvalidError: the study's options do not fit the rig.
    """
    search = config.search
    name, population = _fixed(config, state)
    try:
        return search_params(
            rig,
            gaze=search.gaze,
            lids=search.lids,
            lateral=search.lateral,
            excluded=search.excluded_genes,
            generations=config.generations,
            minimum=1,
            maximum=config.maximum,
            **_own_options(config),
            activation=search.activation,
            initialisation=search.initialisation,
            fixed_population=population,
            fixed_name=name,
            reset=search.reset,
        )
    except InvalidInputError as error:
        raise InvalidError(f"The study does not fit the face model: {error}.", field="search") from error


def _own_options(config: StudyConfig) -> dict[str, Any]:
    """Return the options that only the study's strategy has: for the others they stay what they are by default."""
    search = config.search
    if search.strategy == emogen.NAME:
        return {name: getattr(search, name) for name in BREEDING}
    return {} if search.stop_at is None else {name: getattr(search, name) for name in ENDING}


def simulated(rig: Rig, config: StudyConfig) -> tuple[SearchParams, NDArray[np.float64] | None]:
    """Return the search as simulated people meet it: with as many selections as the study wants.

    Returns:
        The search, and the (S, 10, G) fixed populations one of which every trial draws; none unless there are several.

    Raises:
        InvalidError: the study's options do not fit the rig.
    """
    search = config.search
    drawn = np.array(search.fixed_options) if search.fixed_options and search.fixed_option is None else None
    return replace(params_of(rig, config), minimum=config.minimum), drawn


def _fixed(config: StudyConfig, state: State | None) -> tuple[str, tuple[tuple[float, ...], ...]]:
    """Return number and genomes of the fixed population that a trial begins with."""
    search = config.search
    options = search.fixed_options
    if not options:
        return "", search.fixed_population
    number = search.fixed_option or 1
    if search.fixed_option is None and state is not None:
        number = 1 + option_of(state.seed, 0 if search.reset == "keep" else state.attempt, len(options))
    return str(number), options[min(number, len(options)) - 1]


def algorithm_of(config: StudyConfig) -> str:
    """Return name and version of the search, as stored with the data."""
    chosen = strategy(config.search.strategy)
    return f"{chosen.NAME}/{chosen.VERSION}"


@dataclass(frozen=True)
class Evolution:
    """The search of one study on one rig. Pure: nothing is read or stored here."""

    rig: Rig
    config: StudyConfig
    correction: Correction
    key_of: Callable[[str, NDArray[np.float32], RenderSettings], str]

    def begin(self, trial: Trial, attempt: int) -> State:
        """Return the state of a trial at the start of an attempt."""
        return self._strategy.init(params_of(self.rig, self.config), int(trial.seed), attempt)

    def load(self, trial: Trial) -> State:
        """Return the state that a trial was left in."""
        return State.from_json(json.loads(trial.state or "{}"))

    def dump(self, state: State) -> str:
        """Return a state as it is stored."""
        return json.dumps(state.to_json())

    def tell(self, trial: Trial, selected: Iterable[int], elite: int) -> State:
        """Return the state after a choice of slots."""
        state = self.load(trial)
        return self._strategy.tell(self._params(state), state, Choice(tuple(sorted(selected)), elite))

    def offer(self, trial: Trial, state: State) -> tuple[Generation, list[Face]]:
        """Return the rows of the ten faces that `state` asks for."""
        generation = Generation(
            id=new_id(),
            trial_id=trial.id,
            attempt=state.attempt,
            number=state.generation,
            made_at=now(),
            discarded_at=None,
        )
        population = self._strategy.ask(self._params(state), state)
        return generation, self._faces(trial, generation, population, self.places(state))

    def last_early(self, trial: Trial, state: State) -> int | None:
        """Return the generation that `state` asks for if it is the trial's last one before the study's most."""
        early = not trial.practice and state.generation < self.config.generations
        return state.generation if early and self._strategy.last(self._params(state), state) else None

    def estimate(self, trial: Trial, state: State) -> Estimate | None:
        """Return the row of the face that all answers of `state` speak for; None where the search weighs none."""
        genes = self._strategy.estimate(self._params(state), state)
        if genes is None:
            return None
        (made,) = self.correction.faces(trial.identity, [genes])
        return Estimate(
            trial_id=trial.id,
            identity=trial.identity,
            genes=pack_genes(genes),
            weights=pack_weights(made.weights),
            portrait_key=self.key_of(trial.identity, made.weights, settings_of(self.config)),
            **_collision(made),
        )

    def estimated(self, trial: Trial, state: State) -> list[tuple[str, NDArray[np.float64]]]:
        """Return head and genes of that face; nothing where there is none."""
        genes = self._strategy.estimate(self._params(state), state)
        return [] if genes is None else [(trial.identity, genes)]

    def places(self, state: State) -> tuple[int, ...]:
        """Return the slots in the order of their places on the screen."""
        if self.config.places == "fixed":
            return tuple(range(1, SLOTS + 1))
        return place_order(state.seed, state.attempt, state.generation, SLOTS)

    def asked(self, trial: Trial, state: State) -> list[tuple[str, NDArray[np.float64]]]:
        """Return head and genes of the ten faces that `state` asks for; none if it cannot be asked."""
        try:
            return [(trial.identity, genes) for genes in self._strategy.ask(self._params(state), state).genes]
        except InvalidInputError:
            return []

    def face(self, identity: str, genes: NDArray[np.float64]) -> Finished:
        """Return one face, corrected, and the key of its portrait."""
        (made,) = self.correction.faces(identity, [genes])
        return Finished(made.weights, self.key_of(identity, made.weights, settings_of(self.config)))

    def ahead(self, trial: Trial) -> list[Sketch]:
        """Return what may be drawn while a person is looking: next random faces, and the start after a reset."""
        state = self.load(trial)
        genes = list(self._strategy.ask_ahead(self._params(state), state).values())
        if self.config.search.reset == "redraw":
            again = self.begin(trial, state.attempt + 1)
            genes.extend(self._strategy.ask(self._params(again), again).genes)
        return self._sketches(trial, genes)

    def first(self, trial: Trial) -> list[Sketch]:
        """Return the initial faces of a trial that has not begun."""
        state = self.begin(trial, 0)
        return self._sketches(trial, list(self._strategy.ask(self._params(state), state).genes))

    @property
    def _strategy(self) -> Strategy:
        return strategy(self.config.search.strategy)

    def _params(self, state: State) -> SearchParams:
        return params_of(self.rig, self.config, state)

    def _faces(
        self, trial: Trial, generation: Generation, population: Population, places: tuple[int, ...]
    ) -> list[Face]:
        made = self.correction.faces(trial.identity, population.genes)
        settings = settings_of(self.config)
        return [
            Face(
                id=new_id(),
                generation_id=generation.id,
                slot=slot,
                place=places.index(slot) + 1,
                origin=population.origins[slot - 1],
                parents=list(population.parents[slot - 1]),
                identity=trial.identity,
                genes=pack_genes(population.genes[slot - 1]),
                weights=pack_weights(one.weights),
                portrait_key=self.key_of(trial.identity, one.weights, settings),
                **_collision(one),
            )
            for slot, one in enumerate(made, start=1)
        ]

    def _sketches(self, trial: Trial, genes: list[NDArray[np.float64]]) -> list[Sketch]:
        settings = settings_of(self.config)
        return [Sketch(trial.identity, one.weights, settings) for one in self.correction.faces(trial.identity, genes)]


def _collision(made: CorrectedFace) -> dict[str, Any]:
    """Return what collided, by the names of its columns."""
    found = made.collision
    return {
        "collided_lips": found.lips,
        "collided_teeth": found.teeth,
        "depth_before": found.before,
        "depth_after": found.after,
    }
