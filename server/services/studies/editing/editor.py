"""The study editor: a form is opened, changed, compared and saved as the next version; nothing typed is lost."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import TYPE_CHECKING

from ...config.difference import changes
from ...errors import ConflictError, InvalidError, NotFoundError, ServiceError
from ..life import found_in
from .actions import act
from .compounds import Rows
from .form import StudyForm
from .given import Given
from .wrong import Wrong

if TYPE_CHECKING:
    from collections.abc import Mapping

    from ...config import StudyConfig
    from ...config.difference import Change
    from ...faces.heads import Described, Heads
    from ..life import StudyLife, VersionLine
    from .form import Reading, Shown
    from .given import Fields
    from .node import Node

NOTES = frozenset({"csrf", "base", "do", "end", "shown", "emotion"})
"""Fields of the page itself, which say nothing of the study."""


@dataclass(frozen=True, slots=True)
class Desk:
    """What the page of the editor shows. `base` is the version that was changed, `focus` where the eye should be."""

    fields: Fields
    saved: Fields
    shown: Shown
    base: int
    latest: VersionLine
    focus: str = ""
    restored: int | None = None
    notes: Mapping[str, str] = field(default_factory=dict)

    @property
    def heads(self) -> tuple[Node, ...]:
        """The heads of the form."""
        nodes = (node for card in self.shown.cards for node in card.nodes if node.name == "identities")
        return tuple(head for node in nodes for head in node.children)

    @property
    def wrong(self) -> tuple[Wrong, ...]:
        """What is wrong with the form."""
        return self.shown.wrong


@dataclass(frozen=True, slots=True)
class Face:
    """The head whose portrait stands beside the form: a preset, a head of the saved version, or one in the making."""

    name: str
    letter: str
    preset: str = ""
    row: int | None = None
    emotions: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Review:
    """What saving would change, and what somebody else has changed meanwhile."""

    desk: Desk
    own: tuple[Change, ...]
    theirs: tuple[Change, ...] = ()


class RefusedError(InvalidError):
    """The form is not a study yet; `desk` shows it with what is wrong."""

    def __init__(self, desk: Desk) -> None:
        super().__init__("There is a problem.", field="form")
        self.desk = desk


class NewerError(ConflictError):
    """Somebody else has saved a version meanwhile; `review` shows both changes."""

    def __init__(self, review: Review) -> None:
        super().__init__(f"Version {review.desk.latest.number} was saved meanwhile.", field="version")
        self.review = review


@dataclass(frozen=True)
class Editor:
    """Edits studies through their form."""

    life: StudyLife
    heads: Heads

    @cached_property
    def form(self) -> StudyForm:
        """The form of a study."""
        return StudyForm(self.heads)

    def open(self, study_id: str, number: int | None = None) -> Desk:
        """Return the form of the newest version; with a number, what an older one said, to be saved anew.

        Raises:
            NotFoundError: no such study or version.
        """
        desk = self._desk(study_id, None, None)
        if number is None or number == desk.latest.number:
            return desk
        fields = self.form.fields(self.life.config(study_id, number))
        return replace(desk, fields=fields, shown=self.form.show(fields, desk.saved), restored=number)

    def typed(self, study_id: str, fields: Fields, command: str = "") -> Desk:
        """Return the form as it is typed, after a button inside it was pressed if there is a command.

        Raises:
            NotFoundError: no such study.
            InvalidError: there is no such button, or it cannot do what it should.
        """
        return self._desk(study_id, fields, None, command)

    def refused(self, study_id: str, fields: Fields, error: ServiceError) -> Desk:
        """Return the form as it is typed, with what somebody else had to say against it."""
        desk = self._desk(study_id, fields, None)
        wrong = Wrong("editor", error.message)
        return replace(desk, shown=replace(desk.shown, wrong=(wrong,)))

    def review(self, study_id: str, fields: Fields) -> Review:
        """Return what saving a form would change.

        Raises:
            NotFoundError: no such study.
            RefusedError: it is not a study.
        """
        config = self._config(study_id, fields)
        desk = self._desk(study_id, fields, None)
        base, latest = (self.life.config(study_id, number) for number in (desk.base, desk.latest.number))
        return Review(desk, changes(base, config), changes(base, latest))

    def face(self, desk: Desk) -> Face:
        """Return the head whose portrait stands beside a form: the one that was opened last, or the first."""
        heads = desk.heads
        if not heads:
            return Face("", "", emotions=self.heads.emotions)
        wanted = desk.focus if desk.focus.startswith("identities.") else desk.notes.get("shown", "")
        place = next((place for place, node in enumerate(heads) if node.name == wanted), 0)
        node, letter = heads[place], letter_of(place)
        value, saved = node.extra["value"], desk.saved.get(f"{node.name}.document")
        if isinstance(value, str):
            known = value if value in self.heads.named else ""
            return Face(node.name, letter, preset=known, emotions=self.heads.emotions_of(known))
        same = saved == desk.fields.get(f"{node.name}.document") and not node.changed
        model = node.extra.get("model")
        emotions = self.heads.desk.emotions(model) if model else self.heads.emotions
        return Face(node.name, letter, row=int(node.key) if same else None, emotions=emotions)

    def typed_head(self, fields: Fields, name: str) -> Described | str:
        """Return a head as it is typed: its name, or what a document describes.

        Raises:
            InvalidError: it is no head.
        """
        shape = self.form.shape.members["identities"]
        given = Given(fields)
        value = shape.item.read(given, name) if isinstance(shape, Rows) else ""
        for problem in given.problems.values():
            raise InvalidError(problem.sentence, field=problem.field, expected=problem.expected, got=problem.got)
        return value if isinstance(value, str) else self.heads.described(value)

    def head(self, study_id: str, number: int | None, row: int) -> Described:
        """Return a head of a saved version.

        Raises:
            NotFoundError: no such study, version or head.
        """
        heads = self.life.config(study_id, number).identities
        if not 0 <= row < len(heads):
            raise NotFoundError("There is no such head.", field="row", got=row)
        value = heads[row]
        return self.heads.start(value) if isinstance(value, str) else self.heads.described(value)

    def save(self, study_id: str, fields: Fields, user: str | None) -> int:
        """Save a form as the next version; return its number.

        Raises:
            NotFoundError: no such study.
            RefusedError: it is not a study, or does not fit the face model.
            NewerError: somebody else has saved a version since the form was made.
        """
        config = self._config(study_id, fields)
        try:
            return self.life.save(study_id, config, user, _base(fields))
        except ConflictError as error:
            raise NewerError(self.review(study_id, fields)) from error

    def _config(self, study_id: str, fields: Fields) -> StudyConfig:
        """Return the study that a form stands for, checked against the face model as well."""
        reading = self.form.read(_study(fields))
        if not reading.right:
            reading = replace(reading, problems=(*reading.problems, *self.life.beyond(reading.plain)))
            raise RefusedError(self._desk(study_id, fields, reading))
        try:
            return self.life.checked(reading.config)
        except InvalidError as error:
            reading = replace(reading, problems=found_in(error))
            raise RefusedError(self._desk(study_id, fields, reading)) from error

    def _desk(self, study_id: str, fields: Fields | None, reading: Reading | None, command: str = "") -> Desk:
        latest = self.life.history(study_id)[0]
        base = latest.number if fields is None else min(_base(fields) or latest.number, latest.number)
        form = self.form
        saved = form.fields(self.life.config(study_id, base))
        focus, typed = "", saved if fields is None else _study(fields)
        if command:
            typed, focus = act(form, typed, command)
        notes = {name: values[-1] for name, values in (fields or {}).items() if name in NOTES and values}
        return Desk(typed, saved, form.show(typed, saved, reading), base, latest, focus, notes=notes)


def letter_of(place: int) -> str:
    """Return what a head is called in the form."""
    return chr(ord("A") + place) if place < 26 else str(place + 1)


def _study(fields: Fields) -> Fields:
    return {name: values for name, values in fields.items() if name.split(".")[0] not in NOTES}


def _base(fields: Fields) -> int | None:
    text = (fields.get("base") or [""])[-1]
    return int(text) if text.isdecimal() and len(text) < 9 else None
