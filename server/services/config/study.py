"""The study as a whole, and what must fit together in it."""

from __future__ import annotations

import hashlib
import json
from typing import TYPE_CHECKING, Annotated, Any, Literal, Self

from pydantic import Field, ValidationError, model_validator

from emogen_core.face.model_identity import known_as

from .base import Language, Line, Part, misfit, moved, option, together
from .blocks import Block, Categorise, Evolve, Order, Rate
from .conditions import FIXED, Condition, in_condition
from .parts import Completion, Devices, Emotion, Head, Portrait, Question, Texts, Translation
from .search import BREEDING, ENDING, Search

if TYPE_CHECKING:
    from collections.abc import Iterator


class StudyConfig(Part):
    """A study. Frozen: a change makes a new version with another hash."""

    title: Line = option(..., "Title", "What participants and you call the study.")
    language: Language = option("en", "Language", "The language of the texts here.")
    translations: dict[Language, Translation] = option(
        dict, "Further languages", "The study's own words in other languages; participants choose.", later=True
    )
    texts: Texts = option(Texts(), "Texts", "What the study says about itself.")
    emotions: Annotated[tuple[Emotion, ...], Field(min_length=1, max_length=20)] = option(
        ...,
        "Emotions",
        "What participants picture; one face for each.",
        paper="happy, sad, angry and fearful",
    )
    identities: Annotated[tuple[Head, ...], Field(min_length=1, max_length=20)] = option(
        ("female",), "Heads", "The person whose expression evolves: a preset, MODEL:HEAD, or an identity document."
    )
    head_assignment: Literal["between", "within"] = option(
        "between", "Heads differ", "between: people, each sees one head. within: every block is done with each head.",
        later=True,
    )  # fmt: skip
    children: bool = option(False, "Children", "Whether heads below 18 years are allowed.", later=True)
    generations: int = option(
        10, "Generations per face", "G: the best face of this generation is the measurement.", paper="10",
        ge=1, le=30,
    )  # fmt: skip
    minimum: int = option(1, "Fewest faces", "A choice must have at least so many faces.", ge=1, le=10)
    maximum: int = option(10, "Most faces", "A choice may have so many faces.", ge=1, le=10)
    search: Search = option(Search(), "Search", "How the next ten faces are made.")
    practice: Emotion | None = option(
        Emotion(adjective="surprised", noun="surprise"),
        "Practice",
        "The emotion that is practised for one generation; not one of the study. Empty: no practice.",
    )
    counterbalancing: Order = option(
        "latin", "Order of emotions", "latin: a balanced Latin square. random. fixed: as they stand above."
    )
    ratings: tuple[Question, ...] = option(
        ("intensity", "satisfaction"), "Questions after each face", "About the finished face, on a scale from 1 to 7."
    )
    none_is_close: bool = option(
        False, "None is close", "Whether a participant may say that none of the ten comes close.", later=True
    )
    blocks: Annotated[tuple[Block, ...], Field(max_length=40)] = option(
        (), "Blocks", "What participants do, in this order. Empty: one evolve block with all emotions.", later=True
    )
    conditions: Annotated[tuple[Condition, ...], Field(max_length=20)] = option(
        (), "Conditions", "Groups of people for whom something differs.", later=True
    )
    assignment: Literal["balanced", "random"] = option(
        "balanced", "Assignment", "balanced: to the cell with the fewest people. random: drawn.", later=True
    )
    quota: int | None = option(
        None, "Participants wanted", "The study is full when so many places are taken. Empty: no limit.", later=True,
        ge=1, le=1_000_000,
    )  # fmt: skip
    lease_minutes: int = option(
        30, "Minutes a place is kept", "After the last answer; then the place is given to somebody else.", later=True,
        ge=5, le=10_080,
    )  # fmt: skip
    devices: Devices = option(Devices(), "Devices", "What participants may take part on.", later=True)
    completion: Completion = option(Completion(), "Completion", "Codes and addresses for each outcome.")
    recruiter_parameters: tuple[Annotated[str, Field(pattern=r"^[A-Za-z0-9_]{1,64}$")], ...] = option(
        (), "Recruiter parameters", "Parameters of the link that are kept; the first one names the person.",
        max_length=20,
    )  # fmt: skip
    user_agent: bool = option(False, "Browser", "Whether name and version of the browser are kept.", later=True)
    places: Literal["random", "fixed"] = option(
        "random", "Order on the screen", "random: shuffled every generation. fixed: by slot.", later=True
    )
    pause_ms: int = option(
        0, "Empty screen between generations", "In milliseconds, before the next ten faces appear.", later=True,
        ge=0, le=10_000,
    )  # fmt: skip
    surround: Literal["light", "dark"] = option("light", "Surround", "The grey around the faces.")
    portrait: Portrait = option(Portrait(), "Portraits", "Size of the pictures.")

    @model_validator(mode="after")
    def _fits_together(self) -> Self:
        checks = (_numbers, _search, _emotions, _blocks, _languages)
        found = [one for check in checks for one in check(self)]
        # Every condition would only repeat what is wrong with the study itself.
        found = found or list(_conditions(self))
        if found:
            raise together(found)
        return self

    def hash(self) -> str:
        """Return the SHA-256 that goes into every row of data."""
        return hashlib.sha256(json.dumps(self.canonical(), sort_keys=True).encode()).hexdigest()

    @property
    def heads(self) -> tuple[str, ...]:
        """The heads by the names under which the data has them; documents have to be signed."""
        return tuple(head if isinstance(head, str) else known_as(head) for head in self.identities)

    @property
    def documents(self) -> dict[str, dict[str, Any]]:
        """The identity documents by the names under which the data has their heads."""
        return {known_as(head): head for head in self.identities if isinstance(head, dict)}

    @property
    def steps(self) -> tuple[Block, ...]:
        """The blocks; the one evolve block where the study names none."""
        return self.blocks or (Evolve(kind="evolve", name="evolve"),)

    @property
    def whole(self) -> tuple[StudyConfig, ...]:
        """The study as people in its conditions have it; itself where there are none."""
        return tuple(self.in_condition(one.name) for one in self.conditions) or (self,)

    def emotion(self, adjective: str) -> Emotion:
        """Return an emotion of the study, or the practised one."""
        known = [*self.emotions, *([self.practice] if self.practice else [])]
        return next(emotion for emotion in known if emotion.adjective == adjective)

    def in_condition(self, name: str) -> StudyConfig:
        """Return the study that somebody in a condition takes part in; itself where there are no conditions.

        Raises:
            KeyError: no such condition.
        """
        if not self.conditions:
            return self
        found = {condition.name: condition for condition in self.conditions}[name]
        return StudyConfig.model_validate(in_condition(self, found))


def _numbers(study: StudyConfig) -> Iterator[ValidationError]:
    if study.minimum > study.maximum:
        yield misfit("minimum", expected=f"at most the maximum {study.maximum}", got=study.minimum)
    if len(set(study.ratings)) != len(study.ratings):
        yield misfit("ratings", expected="each question once", got=", ".join(study.ratings))


def _search(study: StudyConfig) -> Iterator[ValidationError]:
    """Refuse options that would have no effect, and a least that is above the most."""
    search, paper = study.search, study.search.strategy == "emogen"
    for name in ENDING if paper else BREEDING:
        usual, got = Search.model_fields[name].default, getattr(search, name)
        if got != usual:
            told = "nothing" if usual is None else usual
            expected = f"{told}, since it has no effect on the strategy {search.strategy}"
            yield misfit("search", name, expected=expected, got=got)
    if not paper and search.stop_at is not None and search.least_generations > study.generations:
        expected = f"at most the generations per face, {study.generations}"
        yield misfit("search", "least_generations", expected=expected, got=search.least_generations)


def _emotions(study: StudyConfig) -> Iterator[ValidationError]:
    words = [emotion.adjective for emotion in study.emotions]
    for place, word in enumerate(words):
        if word in words[:place]:
            yield misfit("emotions", place, "adjective", expected="different adjectives", got=word)
    if study.practice is not None and study.practice.adjective in words:
        word = study.practice.adjective
        yield misfit("practice", "adjective", expected="an emotion that is not in the study", got=word)


def _blocks(study: StudyConfig) -> Iterator[ValidationError]:
    words = [emotion.adjective for emotion in study.emotions]
    evolved: list[str] = []
    names: set[str] = set()
    for place, block in enumerate(study.blocks):
        at = ("blocks", place)
        if block.name in names:
            yield misfit(*at, "name", expected="different names", got=block.name)
        names.add(block.name)
        if isinstance(block, Evolve):
            yield from _known((*at, "emotions"), block.emotions, words)
            yield from _known((*at, "retest_of"), filter(None, [block.retest_of]), evolved)
            evolved.append(block.name)
        elif isinstance(block, (Rate, Categorise)):
            yield from _known((*at, "faces", "of"), filter(None, [block.faces.of]), evolved)
            yield from _faces((*at, "faces"), block, evolved)


def _faces(at: tuple[str | int, ...], block: Rate | Categorise, evolved: list[str]) -> Iterator[ValidationError]:
    sources = block.faces.sources
    if len(set(sources)) != len(sources):
        yield misfit(*at, "sources", expected="each source once", got=", ".join(sources))
    if not evolved and set(sources) & {"own", "others", "means"}:
        yield misfit(*at, "sources", expected="an evolve block before it", got=", ".join(sources))
    if ("named" in sources) != bool(block.faces.named):
        yield misfit(*at, "named", expected="faces if and only if 'named' is a source", got=len(block.faces.named))


def _conditions(study: StudyConfig) -> Iterator[ValidationError]:
    names = [condition.name for condition in study.conditions]
    for place, condition in enumerate(study.conditions):
        if condition.name in names[:place]:
            yield misfit("conditions", place, "name", expected="different names", got=condition.name)
        fixed = FIXED & set(condition.changes)
        for field in sorted(fixed):
            yield misfit(
                "conditions", place, "changes", field,
                expected="a field that may differ between conditions", got=condition.changes[field],
            )  # fmt: skip
        if fixed:
            continue
        try:
            study.in_condition(condition.name)
        except ValidationError as error:
            yield moved(error, "conditions", place, "changes")


def _languages(study: StudyConfig) -> Iterator[ValidationError]:
    if study.language in study.translations:
        yield misfit(
            "translations", study.language, expected="languages other than the study's own", got=study.language
        )
    words = [emotion.adjective for emotion in (*study.emotions, *filter(None, [study.practice]))]
    for language, translation in study.translations.items():
        yield from _known(("translations", language, "emotions"), translation.emotions, words)


def _known(where: tuple[str | int, ...], got: Any, known: Any) -> Iterator[ValidationError]:
    for one in got:
        if one not in known:
            yield misfit(*where, expected=f"one of {', '.join(known) or 'none yet'}", got=one)
