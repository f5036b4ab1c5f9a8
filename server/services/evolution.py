"""The search of one trial, between the core (genes, slots) and the store (faces, places on screen)."""

from __future__ import annotations

import json
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from emogen_core.errors import InvalidInputError
from emogen_core.rendering.protocol import SURROUND_DARK, SURROUND_LIGHT, RenderSettings
from emogen_core.search import Choice, Population, SearchParams, State, Strategy, place_order, strategy
from emogen_core.search.params import search_params

from ..store.runs_tables import Face, Generation
from .clock import new_id, now
from .errors import InvalidError

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from numpy.typing import NDArray

    from emogen_core.face.rig import Rig

    from ..store.runs_tables import Trial
    from .config import StudyConfig
    from .correction import Correction


@dataclass(frozen=True, slots=True)
class Sketch:
    """A face that may be drawn: everything that its portrait depends on."""

    identity: str
    weights: NDArray[np.float32]
    settings: RenderSettings


def params_of(rig: Rig, config: StudyConfig) -> SearchParams:
    """Return the search that a study asks for on a rig.

    Raises:
        InvalidError: the study's options do not fit the rig.
    """
    search = config.search
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
            mutations=search.mutations,
            random_genes=search.random_genes,
            random_faces=search.random_faces,
            activation=search.activation,
            initialisation=search.initialisation,
            fixed_population=search.fixed_population,
            reset=search.reset,
        )
    except InvalidInputError as error:
        raise InvalidError(f"The study does not fit the face model: {error}.", field="search") from error


def settings_of(config: StudyConfig) -> RenderSettings:
    """Return size and background of a study's portraits."""
    background = SURROUND_LIGHT if config.surround == "light" else SURROUND_DARK
    return RenderSettings(config.portrait.width, config.portrait.height, background)


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
        return self._strategy.init(self._params, int(trial.seed), attempt)

    def load(self, trial: Trial) -> State:
        """Return the state that a trial was left in."""
        return State.from_json(json.loads(trial.state or "{}"))

    def dump(self, state: State) -> str:
        """Return a state as it is stored."""
        return json.dumps(state.to_json())

    def tell(self, trial: Trial, selected: Iterable[int], elite: int) -> State:
        """Return the state after a choice of slots."""
        return self._strategy.tell(self._params, self.load(trial), Choice(tuple(sorted(selected)), elite))

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
        population = self._strategy.ask(self._params, state)
        places = place_order(state.seed, state.attempt, state.generation)
        return generation, self._faces(trial, generation, population, places)

    def correct(self, trial: Trial, state: State) -> None:
        """Correct the ten faces that `state` asks for; they are remembered."""
        self.correction.faces(trial.identity, self._strategy.ask(self._params, state).genes)

    def ahead(self, trial: Trial) -> list[Sketch]:
        """Return what may be drawn while a person is looking: next random faces, and the start after a reset."""
        state = self.load(trial)
        genes = list(self._strategy.ask_ahead(self._params, state).values())
        if self.config.search.reset == "redraw":
            again = self._strategy.init(self._params, state.seed, state.attempt + 1)
            genes.extend(self._strategy.ask(self._params, again).genes)
        return self._sketches(trial, genes)

    def first(self, trial: Trial) -> list[Sketch]:
        """Return the initial faces of a trial that has not begun."""
        return self._sketches(trial, list(self._strategy.ask(self._params, self.begin(trial, 0)).genes))

    @property
    def _strategy(self) -> Strategy:
        return strategy(self.config.search.strategy)

    @property
    def _params(self) -> SearchParams:
        return params_of(self.rig, self.config)

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
                collided_lips=one.collision.lips,
                collided_teeth=one.collision.teeth,
                depth_before=one.collision.before,
                depth_after=one.collision.after,
            )
            for slot, one in enumerate(made, start=1)
        ]

    def _sketches(self, trial: Trial, genes: list[NDArray[np.float64]]) -> list[Sketch]:
        settings = settings_of(self.config)
        return [Sketch(trial.identity, one.weights, settings) for one in self.correction.faces(trial.identity, genes)]


def pack_genes(genes: NDArray[np.float64]) -> bytes:
    """Return genes as stored: float64, little-endian, so that a replay can be compared bit for bit."""
    return genes.astype("<f8").tobytes()


def pack_weights(weights: NDArray[np.float32]) -> bytes:
    """Return weights as stored: float32, little-endian."""
    return weights.astype("<f4").tobytes()


def unpack_genes(data: bytes) -> NDArray[np.float64]:
    """Return stored genes."""
    return np.frombuffer(data, "<f8").astype(np.float64)


def unpack_weights(data: bytes) -> NDArray[np.float32]:
    """Return stored weights."""
    return np.frombuffer(data, "<f4").astype(np.float32)
