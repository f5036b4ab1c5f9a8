"""How somebody takes a place in a study."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ..store import runs, studies
from ..store.runs_tables import Participation, Trial
from ..store.studies_tables import RigRecord
from .clock import digest, new_code, new_id, new_seed, new_token, now
from .config import StudyConfig
from .errors import ConflictError, InvalidError, NotFoundError
from .evolution import algorithm_of
from .order import identity_for, trial_order

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from emogen_core.face.rig import Rig

    from ..store.engine import Tx
    from ..store.studies_tables import Link, Study, StudyVersion
    from .journal import Journal

OPEN = frozenset({"recruiting", "pilot"})


@dataclass(frozen=True, slots=True)
class Joined:
    """A place that was taken; the token is told once."""

    token: str
    participation: str

    @property
    def address(self) -> str:
        """Where the participant goes on."""
        return f"/p/{self.token}"


@dataclass(frozen=True, slots=True)
class Entry:
    """What a link leads to."""

    study: str
    config: StudyConfig
    open: bool
    place: str
    """The token that a start from this page would have: pressing the button twice takes one place."""


@dataclass(frozen=True)
class Joining:
    """Links and the places behind them."""

    journal: Journal

    def entry(self, link_id: str) -> Entry:
        """Return what a link leads to; nothing changes.

        Raises:
            NotFoundError: no such link.
        """
        with self.journal.database.read() as tx:
            _, study, version = _behind(tx, link_id)
            return Entry(study.id, StudyConfig.model_validate(version.config), study.status in OPEN, new_token())

    def join(
        self,
        link_id: str,
        recruiter: Mapping[str, str] | None = None,
        *,
        place: str | None = None,
        simulated: bool = False,
        seed: str | None = None,
    ) -> Joined:
        """Take a place; with the `place` of an entry page, the same one however often it is asked for.

        Args:
            link_id: the link's last part.
            recruiter: parameters that came with it; those that the study names are kept.
            place: the token that the entry page offered.
            simulated: marks the participation as simulated; `seed` then makes its trials repeatable.
            seed: decimal text.

        Raises:
            NotFoundError: no such link.
            ConflictError: the study takes nobody now.
            InvalidError: the place or the seed is not one.
        """
        token = _checked_place(place) or new_token()
        with self.journal.database.write() as tx:
            link, study, version = _behind(tx, link_id, lock=True)
            taken = runs.participation_by_token(tx, digest(token))
            if taken is not None:
                return Joined(token, taken.id)
            if study.status not in OPEN:
                raise ConflictError("This study takes no participants at the moment. Thank you for your interest.")
            config = StudyConfig.model_validate(version.config)
            register_rig(tx, self.journal.rig)
            participation = _participation(link, study, version, token)
            participation.rig_hash = self.journal.rig.hash
            participation.algorithm = algorithm_of(config)
            participation.number = runs.joined(tx, study.id)
            participation.simulated = simulated
            participation.seed = _checked_seed(seed) or participation.seed
            participation.recruiter = _kept(config, recruiter or {})
            trials = _plan(config, participation)
            runs.add(tx, participation)
            runs.add_all(tx, trials)
        return Joined(token, participation.id)


def register_rig(tx: Tx, rig: Rig) -> None:
    """Store the names that give this rig's vectors their meaning, once."""
    if studies.rig(tx, rig.hash) is None:
        record = RigRecord(
            hash=rig.hash,
            name=rig.name,
            genes=list(rig.gene_names),
            shapes=list(rig.shape_names),
            first_used_at=now(),
        )
        runs.add(tx, record)


def _behind(tx: Tx, link_id: str, *, lock: bool = False) -> tuple[Link, Study, StudyVersion]:
    link = studies.link(tx, link_id)
    study = None if link is None or link.closed_at else studies.study(tx, link.study_id, lock=lock)
    version = None if study is None else studies.latest_version(tx, study.id)
    if link is None or study is None or version is None:
        raise NotFoundError("This link leads to no study. Check that it was copied as a whole.")
    return link, study, version


def _participation(link: Link, study: Study, version: StudyVersion, token: str) -> Participation:
    return Participation(
        id=new_id(),
        study_id=study.id,
        version_id=version.id,
        link_id=link.id,
        token_hash=digest(token),
        config_hash=version.config_hash,
        pilot=study.status == "pilot",
        seed=new_seed(),
        step="consent",
        position=0,
        withdrawal_code=new_code(),
        arrived_at=now(),
    )


def _plan(config: StudyConfig, participation: Participation) -> list[Trial]:
    """Return the trials of a participation, the practised one first."""
    identity = identity_for(config, participation.number)
    words = trial_order(config, participation.number, int(participation.seed))
    participation.condition = identity
    participation.trial_order = list(words)
    practised = [config.practice.adjective] if config.practice else []
    seeds = _seeds(participation)
    return [
        Trial(
            id=new_id(),
            participation_id=participation.id,
            position=position,
            kind="evolve",
            practice=position < len(practised),
            emotion=word,
            identity=identity,
            seed=seeds(position),
            attempt=0,
            generation=0,
        )
        for position, word in enumerate([*practised, *words])
    ]


def _seeds(participation: Participation) -> Callable[[int], str]:
    """Return the seed of each trial: 128 bits that follow from the participation's own."""

    def seed(position: int) -> str:
        words = np.random.SeedSequence(int(participation.seed), spawn_key=(position,)).generate_state(4)
        return str(int.from_bytes(words.astype("<u4").tobytes(), "little"))

    return seed


def _checked_place(place: str | None) -> str | None:
    if place is not None and not (len(place) == len(new_token()) and re.fullmatch(r"[\w-]+", place, re.ASCII)):
        raise InvalidError(
            "This start page is not complete. Load it again.", field="place", expected="32 letters, digits, - or _"
        )
    return place


def _checked_seed(seed: str | None) -> str | None:
    if seed is not None and not (seed.isascii() and seed.isdigit() and len(seed) <= 39):
        raise InvalidError("The seed is not a number.", field="seed", expected="up to 39 decimal digits", got=seed)
    return seed


def _kept(config: StudyConfig, recruiter: Mapping[str, str]) -> dict[str, str]:
    return {name: recruiter[name][:200] for name in config.recruiter_parameters if name in recruiter}
