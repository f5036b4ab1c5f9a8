"""What a study is: its configuration as a schema whose errors name the field, the value and what is allowed."""

from __future__ import annotations

import hashlib
import json
from typing import Annotated, Any, Literal, Self

from pydantic import (
    BaseModel,
    ConfigDict,
    Field,
    PlainValidator,
    StringConstraints,
    ValidationError,
    model_validator,
)

from emogen_core.face.identity import DOCUMENT_BYTES, worn_as

from .errors import InvalidError

Name = Annotated[str, StringConstraints(pattern=r"^[a-z][a-z0-9_]{0,39}$")]
Line = Annotated[str, StringConstraints(min_length=1, max_length=200)]
Prose = Annotated[str, StringConstraints(max_length=20_000)]
Probability = Annotated[float, Field(ge=0, lt=1)]
Question = Literal["intensity", "satisfaction"]
Outcome = Literal["complete", "no_consent", "screened_out", "failed_checks"]


def _head(value: object) -> str | dict[str, Any]:
    if isinstance(value, str) and 1 <= len(value) <= 200:
        return value
    if not isinstance(value, dict) or not all(isinstance(name, str) for name in value):
        raise ValueError(f"expected the name of a head or an identity document, got {value!r:.100}")
    try:
        size = len(json.dumps(value, allow_nan=False))
    except (TypeError, ValueError, RecursionError) as error:
        raise ValueError(f"expected plain JSON with finite numbers, got {error}") from error
    if size > DOCUMENT_BYTES:
        raise ValueError(f"expected at most {DOCUMENT_BYTES} bytes, got {size}")
    return value


Head = Annotated[str | dict[str, Any], PlainValidator(_head)]
"""A head of the face model by its name, or an identity document: docs/identities.md."""


class _Part(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True)


class Emotion(_Part):
    """An emotion as the study names it: `angry` to look, `anger` to have."""

    adjective: Line
    noun: Line


class Texts(_Part):
    """What the study says about itself; the pages leave out what is empty."""

    organisation: Line | Literal[""] = ""
    contact_name: Line | Literal[""] = ""
    contact: Line | Literal[""] = ""
    ethics: Prose = ""
    minutes: int = Field(default=0, ge=0, le=600, description="0: not said")
    payment: Line | Literal[""] = ""
    device: Line | Literal[""] = ""
    erase_until: Line | Literal[""] = ""
    about: Prose = ""


class Search(_Part):
    """Options of the search (EmoGen 2021, section III); the defaults are the paper's."""

    strategy: Literal["emogen"] = "emogen"
    mutations: int = Field(default=2, ge=0, le=20, description="m: gene indices drawn a bred face")
    random_genes: int = Field(default=6, ge=1, le=50, description="x: genes drawn a random face")
    random_faces: int = Field(default=4, ge=0, le=7)
    activation: tuple[int, int] = (3, 8)
    initialisation: Literal["protocol", "fixed"] = "protocol"
    fixed_population: tuple[tuple[Probability, ...], ...] = ()
    reset: Literal["keep", "redraw", "off"] = "keep"
    gaze: bool = Field(default=True, description="whether genes that turn the eyes take part")
    lids: bool = Field(default=True, description="whether genes that close the eyes take part")
    lateral: bool = Field(default=False, description="whether genes that move jaw and mouth sideways take part")
    excluded_genes: tuple[Annotated[str, Field(max_length=100)], ...] = ()


class Portrait(_Part):
    """Size of a portrait in pixels; 5:6."""

    width: int = Field(default=400, ge=100, le=1000)

    @property
    def height(self) -> int:
        """Six fifths of the width."""
        return round(self.width * 6 / 5)


class Completion(_Part):
    """Codes and addresses a participant is sent back with; without a code everybody gets their own."""

    codes: dict[Outcome, Line] = Field(default_factory=dict)
    redirects: dict[Outcome, Annotated[str, Field(pattern=r"^https://", max_length=500)]] = Field(default_factory=dict)


class StudyConfig(_Part):
    """A study. Frozen: a change makes a new version with another hash."""

    title: Line
    language: Annotated[str, StringConstraints(pattern=r"^[a-z]{2,3}(-[A-Za-z0-9]{2,8})*$")] = "en"
    texts: Texts = Texts()
    emotions: Annotated[tuple[Emotion, ...], Field(min_length=1, max_length=20)]
    identities: Annotated[tuple[Head, ...], Field(min_length=1, max_length=20)] = ("female",)
    children: bool = Field(default=False, description="whether documents of heads below 18 are allowed")
    generations: int = Field(default=10, ge=1, le=30, description="G: the trial ends with the best of this one")
    minimum: int = Field(default=1, ge=1, le=10)
    maximum: int = Field(default=10, ge=1, le=10)
    search: Search = Search()
    practice: Emotion | None = Emotion(adjective="surprised", noun="surprise")
    counterbalancing: Literal["latin", "random", "fixed"] = "latin"
    ratings: tuple[Question, ...] = ("intensity", "satisfaction")
    completion: Completion = Completion()
    recruiter_parameters: tuple[Annotated[str, Field(pattern=r"^[A-Za-z0-9_]{1,64}$")], ...] = ()
    surround: Literal["light", "dark"] = "light"
    portrait: Portrait = Portrait()

    @model_validator(mode="after")
    def _fits_together(self) -> Self:
        if self.minimum > self.maximum:
            raise ValueError(f"minimum: expected at most the maximum {self.maximum}, got {self.minimum}")
        words = [emotion.adjective for emotion in self.emotions]
        if len(set(words)) != len(words):
            raise ValueError(f"emotions: expected different adjectives, got {words}")
        if self.practice is not None and self.practice.adjective in words:
            raise ValueError(f"practice: expected an emotion that is not in the study, got {self.practice.adjective!r}")
        return self

    def canonical(self) -> dict[str, Any]:
        """Return plain data; the same study gives the same data."""
        data = self.model_dump(mode="json")
        # Studies that are older than a field keep their hash.
        return {name: value for name, value in data.items() if name not in _LATER or value != _LATER[name]}

    def hash(self) -> str:
        """Return the SHA-256 that goes into every row of data."""
        return hashlib.sha256(json.dumps(self.canonical(), sort_keys=True).encode()).hexdigest()

    @property
    def heads(self) -> tuple[str, ...]:
        """The heads by the names under which the data has them; documents have to be signed."""
        return tuple(head if isinstance(head, str) else worn_as(head["hash"]) for head in self.identities)

    @property
    def documents(self) -> dict[str, dict[str, Any]]:
        """The identity documents by the names under which the data has their heads."""
        return {worn_as(head["hash"]): head for head in self.identities if isinstance(head, dict)}

    def emotion(self, adjective: str) -> Emotion:
        """Return an emotion of the study, or the practised one."""
        known = [*self.emotions, *([self.practice] if self.practice else [])]
        return next(emotion for emotion in known if emotion.adjective == adjective)


_LATER = {"children": False}


def parse_config(data: Any) -> StudyConfig:
    """Return a study from plain data.

    Raises:
        InvalidError: names the first field at fault, what was expected and what was got.
    """
    try:
        return StudyConfig.model_validate(data)
    except ValidationError as error:
        first = error.errors(include_url=False)[0]
        where = ".".join(str(part) for part in first["loc"]) or "study"
        raise InvalidError(
            f"The study cannot be used: {where}: {first['msg']}.",
            field=where,
            expected=first["msg"],
            got=repr(first["input"]),
        ) from error


DEMO = StudyConfig(
    title="Picturing four emotions",
    texts=Texts(minutes=15, about="The faces you made show how you picture these four emotions."),
    emotions=(
        Emotion(adjective="happy", noun="happiness"),
        Emotion(adjective="sad", noun="sadness"),
        Emotion(adjective="angry", noun="anger"),
        Emotion(adjective="fearful", noun="fear"),
    ),
    identities=("female", "male"),
    recruiter_parameters=("PROLIFIC_PID", "STUDY_ID", "SESSION_ID"),
)
