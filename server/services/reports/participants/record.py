"""One participation to look at: who it was, its trials, and of the one that is shown everything that happened."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

from ....store import roster, runs
from ...config.stored import own_config
from ...errors import NotFoundError
from ...naming import name_of
from ..results.noise import settling_of
from .roster import Entry, entry
from .strip import Strip, strip_of

if TYPE_CHECKING:
    from collections.abc import Sequence

    from ....store.engine import Tx
    from ....store.runs_tables import Participation, Response, Stimulus, Trial
    from ...config import StudyConfig
    from ...participation.journal import Journal
    from ..results.noise import NoiseOfSearch, Settling


@dataclass(frozen=True, slots=True)
class Tab:
    """A trial that can be shown."""

    position: int
    label: str
    shown: bool


@dataclass(frozen=True, slots=True)
class ItemView:
    """One item of a trial without generations: the face that was judged, and the answers."""

    number: int
    portrait: str | None
    source: str
    meant: str
    answers: Sequence[tuple[str, str, str]]
    """Question, answer, the right answer where there is one."""
    right: bool | None
    seconds: float | None


@dataclass(frozen=True, slots=True)
class Person:
    """What the page of one participant shows."""

    id: str
    entry: Entry
    config_hash: str
    same_rig: bool
    answers: int
    before: int | None
    after: int | None
    tabs: Sequence[Tab]
    trial: str
    kind: str
    noun: str
    strip: Strip | None
    items: Sequence[ItemView]
    settling: Settling | None
    """How simulated people settle in this search, once it is known."""

    @property
    def others(self) -> list[tuple[str, int]]:
        """Names and numbers of the participants before and after."""
        return [(name_of(number), number) for number in (self.before, self.after) if number is not None]


@dataclass(frozen=True)
class Records:
    """Reads participations for those who run the study."""

    journal: Journal
    noise: NoiseOfSearch

    def person(self, study_id: str, number: int, position: int | None = None) -> Person:
        """Return one participant, with a trial; the first that counts unless one is named.

        Raises:
            NotFoundError: no such participant or trial.
        """
        with self.journal.database.read() as tx:
            person, config = self._person(tx, study_id, number, position)
        if person.strip is None or not person.strip.distances:
            return person
        return replace(person, settling=settling_of(self.noise.of(config)))

    def _person(self, tx: Tx, study_id: str, number: int, position: int | None) -> tuple[Person, StudyConfig]:
        row, version = _found(tx, study_id, number)
        config = own_config(tx, row)
        begun = [trial for trial in runs.trials(tx, row.id) if trial.started_at is not None]
        trial = _wanted(begun, position)
        before, after = roster.neighbours(tx, study_id, number)
        evolved = trial is not None and trial.kind == "evolve"
        person = Person(
            id=row.id,
            entry=entry(row, version),
            config_hash=row.config_hash,
            same_rig=row.rig_hash == self.journal.rig_of(config).hash,
            answers=roster.number_of_answers(tx, row.id),
            before=before,
            after=after,
            tabs=_tabs(begun, trial, config),
            trial=trial.id if trial else "",
            kind=trial.kind if trial else "",
            noun=_noun(config, trial.emotion) if trial else "",
            strip=strip_of(tx, trial) if trial and evolved else None,
            items=_items(tx, trial) if trial and not evolved else (),
            settling=None,
        )
        return person, config

    def id_of(self, study_id: str, number: int) -> str:
        """Return the id of a participant.

        Raises:
            NotFoundError: no such participant.
        """
        with self.journal.database.read() as tx:
            return _found(tx, study_id, number)[0].id


def _found(tx: Tx, study_id: str, number: int) -> tuple[Participation, int]:
    found = roster.person(tx, study_id, number)
    if found is None:
        raise NotFoundError("This study has no such participant.", field="number", got=number)
    return found


def _wanted(trials: Sequence[Trial], position: int | None) -> Trial | None:
    """Return the trial at a position; without one the first that counts, if anything has begun."""
    if position is None:
        return next((trial for trial in trials if not trial.practice), trials[0] if trials else None)
    for trial in trials:
        if trial.position == position:
            return trial
    raise NotFoundError("This participant has no such trial, or has not begun it.", field="trial", got=position)


def _tabs(trials: Sequence[Trial], shown: Trial | None, config: StudyConfig) -> list[Tab]:
    labels = [_label(trial, config) for trial in trials]
    return [
        Tab(
            trial.position,
            f"{label}, {trial.block if trial.kind == 'evolve' else trial.identity}"
            if labels.count(label) > 1
            else label,
            trial is shown,
        )
        for trial, label in zip(trials, labels, strict=True)
    ]


def _label(trial: Trial, config: StudyConfig) -> str:
    if trial.practice:
        return "Practice"
    words = _noun(config, trial.emotion) if trial.kind == "evolve" else trial.block
    several = trial.identity and config.head_assignment == "within" and len(config.identities) > 1
    return f"{words.capitalize()} on {trial.identity}" if several else words.capitalize()


def _noun(config: StudyConfig, emotion: str) -> str:
    known = [*config.emotions, *filter(None, [config.practice])]
    return next((one.noun for one in known if one.adjective == emotion), emotion)


def _items(tx: Tx, trial: Trial) -> list[ItemView]:
    shown = {one.item: one for one in runs.stimuli(tx, trial.id)}
    answered: dict[int, list[Response]] = {}
    for row in roster.responses(tx, trial.id):
        answered.setdefault(row.item, []).append(row)
    return [_item(item, shown.get(item), answered.get(item, [])) for item in sorted({*shown, *answered})]


def _item(item: int, face: Stimulus | None, rows: Sequence[Response]) -> ItemView:
    times = [row.answered_ms - row.onset_ms for row in rows if row.answered_ms is not None and row.onset_ms is not None]
    return ItemView(
        number=item + 1,
        portrait=face.portrait_key if face else None,
        source=face.source if face else "",
        meant=face.emotion if face else "",
        answers=[(_spelled(row.question), _words(row.value), _words(row.expected or [])) for row in rows],
        right=_right(rows),
        seconds=max(times) / 1000 if times else None,
    )


def _right(rows: Sequence[Response]) -> bool | None:
    """Return whether every answer that can be right is; nothing where none can."""
    judged = [row for row in rows if row.expected is not None]
    return all(row.value == row.expected for row in judged) if judged else None


def _words(values: Sequence[Any]) -> str:
    return ", ".join(_spelled(str(value)) for value in values)


def _spelled(name: str) -> str:
    return name.replace("_", " ")
