"""Recorded trials beside what configuration, seeds and choices give again, bit for bit."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

from emogen_core.search import Choice, State, strategy

from ...faces.correction import Correction
from ...trials.evolution import SLOTS, Evolution, params_of
from ...trials.evolve import last_generation
from ..plan import trial_seed
from .alike import MADE, different
from .planned import unplanned
from .recorded import Difference, Replayed

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from emogen_core.face.rig import Rig

    from ....store.runs_tables import ChoiceRecord, Face, Generation, Trial
    from ...config import StudyConfig
    from ...faces.wardrobe import Wardrobe
    from .recorded import Recorded, Shown

    Found = tuple[int | None, str, str, str]
    """Slot, what, expected, got."""


@dataclass(frozen=True)
class Comparison:
    """Makes recorded faces again on a rig."""

    rig: Rig
    wardrobe: Wardrobe

    def of(self, recorded: Recorded) -> Replayed:
        """Return how much of a participation is made again, up to the first difference.

        Raises:
            ConflictError: a head that it saw cannot be fitted any more.
        """
        difference = unplanned(recorded)
        if difference is not None:
            return Replayed(0, difference)
        self.wardrobe.know(recorded.config)
        for head in sorted({trial.identity for trial, _ in recorded.trials} - {""}):
            self.wardrobe.wait(head)
        count = 0
        for trial, shown in recorded.trials:
            for difference in self._trial(recorded, trial, shown):
                count += difference is None or difference.generation is not None
                if difference is not None:
                    return Replayed(count, difference)
        return Replayed(count, None)

    @cached_property
    def _correction(self) -> Correction:
        return Correction(self.wardrobe.rig)

    def _trial(self, recorded: Recorded, trial: Trial, shown: Shown) -> Iterator[Difference | None]:
        """Yield for every generation what is different in it, and what is in the trial before and after them."""
        yield from _amiss(trial, "seed", trial_seed(int(recorded.seed), trial.position), trial.seed)
        yield from self._generations(recorded, trial, shown)
        yield from _ending(recorded, trial, shown)

    def _generations(self, recorded: Recorded, trial: Trial, shown: Shown) -> Iterator[Difference | None]:
        config, last = recorded.config, None
        search, state = strategy(config.search.strategy), None
        for generation, faces, choice in shown:
            if state is None or generation.attempt != state.attempt:
                state = search.init(params_of(self.rig, config), int(trial.seed), generation.attempt)
            found = self._compare(trial, config, state, (generation, faces)) or _not_offered(faces, choice)
            place = trial.participation_id, trial.id, generation.attempt, generation.number
            yield Difference(*place, *found) if found else None
            last = self._evolution(config).last_early(trial, state)
            if choice is not None:
                state = search.tell(params_of(self.rig, config, state), state, _told(faces, choice))
        yield from _amiss(trial, "last_generation", _or_none(last), _or_none(trial.last_generation))
        yield from self._estimate(recorded, trial, state)

    def _estimate(self, recorded: Recorded, trial: Trial, state: State | None) -> Iterator[Difference]:
        """Yield what is wrong with the face that the search itself took for the one in mind when all was answered."""
        config, got = recorded.config, recorded.estimates.get(trial.id)
        made = None
        if state is not None and state.generation > last_generation(config, trial):
            made = self._evolution(config).estimate(trial, state)
        yield from _amiss(trial, "estimate", "one" if made else "none", "one" if got else "none")
        if made and got:
            found = different(self.rig, made, got, ("identity", *MADE))
            yield from _amiss(trial, f"estimate, {found[0]}", *found[1:]) if found else ()

    def _evolution(self, config: StudyConfig) -> Evolution:
        return Evolution(self.rig, config, self._correction, lambda *_: "")

    def _compare(
        self, trial: Trial, config: StudyConfig, state: State, recorded: tuple[Generation, Sequence[Face]]
    ) -> Found | None:
        generation, faces = recorded
        if generation.number != state.generation or len(faces) != SLOTS:
            return None, "generation", f"{state.generation}", f"{generation.number} with {len(faces)} faces"
        evolution = self._evolution(config)
        _, again = evolution.offer(trial, state)
        places = evolution.places(state)
        for face, made in zip(faces, again, strict=True):
            found = different(self.rig, made, face, ("slot", "identity", "origin", "parents", *MADE))
            if found:
                return face.slot, *found
            if places[face.place - 1] != face.slot:
                return face.slot, "place", f"{places.index(face.slot) + 1}", f"{face.place}"
        return None


def _ending(recorded: Recorded, trial: Trial, shown: Shown) -> Iterator[Difference]:
    """Yield what is wrong with where a trial stands: a finished one ends with the best face of its last generation."""
    if trial.kind != "evolve":
        return
    generation, _, choice = shown[-1] if shown else (None, (), None)
    if generation is not None:
        yield from _amiss(trial, "attempts", str(generation.attempt), str(trial.attempt))
        yield from _amiss(trial, "generations", str(generation.number), str(trial.generation))
    last = generation is not None and generation.number == last_generation(recorded.config, trial)
    best = choice.elite_face_id if choice is not None and last else "none"
    yield from _amiss(trial, "final_face", best, trial.final_face_id or "none")
    if recorded.complete and best == "none":
        yield from _amiss(trial, "final_face", "one, since the participation is complete", "none")


def _or_none(number: int | None) -> str:
    return "none" if number is None else str(number)


def _amiss(trial: Trial, what: str, expected: str, got: str) -> Iterator[Difference]:
    if expected != got:
        yield Difference(trial.participation_id, trial.id, None, None, None, what, expected, got)


def _not_offered(faces: Sequence[Face], choice: ChoiceRecord | None) -> Found | None:
    """Return what a choice names that was not there."""
    named = {*choice.selected, choice.elite_face_id} if choice else set()
    strange = named - {face.id for face in faces}
    return (None, "choice", "faces of this generation", ", ".join(sorted(strange))) if strange else None


def _told(faces: Sequence[Face], choice: ChoiceRecord) -> Choice:
    slots = {face.id: face.slot for face in faces}
    return Choice(tuple(sorted(slots[face] for face in choice.selected)), slots[choice.elite_face_id])
