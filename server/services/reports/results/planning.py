"""What to expect of a study's settings with each strategy, before anybody takes part: error, noise, participants."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from emogen_core.search.strategies import STRATEGIES
from emogen_core.simulation.evaluation.participants import EFFECTS, participants
from emogen_core.simulation.evaluation.threshold import saving

from ...config.stored import newest
from ...trials.evolve import may_end_early

if TYPE_CHECKING:
    from emogen_core.simulation.evaluation.dispersion import Dispersion
    from emogen_core.simulation.evaluation.threshold import Noise, Threshold

    from ...config import StudyConfig
    from ...participation.journal import Journal
    from .noise import NoiseOfSearch


@dataclass(frozen=True, slots=True)
class Need:
    """How many participants a group find a difference of mean faces; None where 10,000 are not enough.

    Attributes:
        distance: cosine distance between the mean faces in mind of two groups.
        alike: where everybody in a group means the same face, so that only the search varies.
        different: where people mean faces of their own, as simulated ones do.
    """

    distance: float
    alike: int | None
    different: int | None


@dataclass(frozen=True, slots=True)
class Expected:
    """One strategy with a study's settings.

    Attributes:
        strategy: its name in the registry.
        own: whether the study has it.
        noise: of its search; None while it is being simulated.
        needs: participants for several differences, of people with a noise of .1; empty until then.
        most: generations of a trial that goes on to its end, where trials may end early; else None.
    """

    strategy: str
    own: bool
    noise: Threshold | None
    needs: tuple[Need, ...]
    most: int | None

    @property
    def savings(self) -> tuple[tuple[str, float, float], ...]:
        """Of people who never err and of those with noise .1: generations seen, and percentage of choices saved."""
        if self.most is None or self.noise is None:
            return ()
        kinds = {"people who never err": self.noise.faithful, "a noise of .1": self.noise.noisy}
        return tuple((name, one.generations, saving(one.generations, self.most)) for name, one in kinds.items())


@dataclass(frozen=True)
class Planning:
    """Tells what to expect."""

    journal: Journal
    noise: NoiseOfSearch

    def of(self, study_id: str) -> list[Expected]:
        """Return what to expect of the settings of a study's newest version, its own strategy first.

        Raises:
            NotFoundError: no such study.
        """
        with self.journal.database.read() as tx:
            config = newest(tx, study_id)
        own = config.search.strategy
        return [self._expected(config, name) for name in sorted(STRATEGIES, key=lambda name: name != own)]

    def _expected(self, config: StudyConfig, name: str) -> Expected:
        own, search = name == config.search.strategy, config.search.model_copy(update={"strategy": name})
        noise = self.noise.of(config.model_copy(update={"search": search}))
        most = config.generations if own and may_end_early(config) else None
        return Expected(name, own, noise, _needs(noise.noisy) if noise else (), most)


def _needs(noise: Noise) -> tuple[Need, ...]:
    def people(dispersion: Dispersion, distance: float) -> int | None:
        return participants(dispersion, noise.kept, distance)

    return tuple(Need(one, people(noise.within, one), people(noise.among, one)) for one in EFFECTS)
