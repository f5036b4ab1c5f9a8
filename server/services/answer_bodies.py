"""The answers that a participant's page may send, as schemas; see docs/participant-interface.md."""

from __future__ import annotations

import hashlib
import json
from typing import Annotated, Literal
from uuid import UUID  # pydantic reads it at run time

from pydantic import BaseModel, ConfigDict, Field, TypeAdapter

Milliseconds = Annotated[float, Field(ge=0, le=1e10, allow_inf_nan=False)]
Pixels = Annotated[float, Field(ge=0, le=100_000, allow_inf_nan=False)]
Identifier = Annotated[str, Field(pattern=r"^[A-Za-z0-9_-]{1,64}$")]


class _Body(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True)


class Timing(_Body):
    """Times of the page's own clock."""

    requested_ms: Milliseconds | None = None
    decoded_ms: Milliseconds | None = None
    onset_ms: Milliseconds | None = None
    chosen_ms: Milliseconds | None = None
    hidden_ms: Milliseconds | None = None


class Client(_Body):
    """What the participant saw the faces on."""

    viewport: tuple[Pixels, Pixels] | None = None
    pixel_ratio: Annotated[float, Field(gt=0, le=20, allow_inf_nan=False)] | None = None
    tile: tuple[Pixels, Pixels] | None = None
    input: Annotated[str, Field(pattern=r"^[a-z_-]{1,20}$")] | None = None


class _AnswerBody(_Body):
    id: UUID

    def fingerprint(self) -> str:
        """Return the hash by which a repeated answer is known."""
        plain = json.dumps(self.model_dump(mode="json"), sort_keys=True)
        return hashlib.sha256(plain.encode()).hexdigest()


class ConsentAnswer(_AnswerBody):
    """Yes or no to taking part."""

    kind: Literal["consent"]
    given: bool


class InstructionsAnswer(_AnswerBody):
    """The instructions were read."""

    kind: Literal["instructions"]


class ChoiceAnswer(_AnswerBody):
    """The chosen faces of a generation and the best of them."""

    kind: Literal["choice"]
    trial: Identifier
    attempt: int = Field(ge=0)
    generation: int = Field(ge=0)
    selected: Annotated[tuple[Identifier, ...], Field(max_length=100)]
    elite: Identifier
    timing: Timing = Timing()
    client: Client = Client()


class ResetAnswer(_AnswerBody):
    """Start this face again."""

    kind: Literal["reset"]
    trial: Identifier
    attempt: int = Field(ge=0)
    generation: int = Field(ge=0)


class RatingAnswer(_AnswerBody):
    """How the finished face is judged."""

    kind: Literal["rating"]
    trial: Identifier
    values: dict[Annotated[str, Field(max_length=40)], Annotated[int, Field(ge=1, le=7)]]


AnswerBody = Annotated[
    ConsentAnswer | InstructionsAnswer | ChoiceAnswer | ResetAnswer | RatingAnswer, Field(discriminator="kind")
]
ANSWER: TypeAdapter[AnswerBody] = TypeAdapter(AnswerBody)


class EventBody(_Body):
    """Something the page saw while a generation was on the screen."""

    id: UUID
    trial: Identifier
    attempt: int = Field(ge=0)
    generation: int = Field(ge=0)
    at_ms: Milliseconds
    type: Literal[
        "select", "deselect", "best", "undo", "enlarge", "enlarge_end", "first_view",
        "hidden", "visible", "blur", "focus", "onset",
    ]  # fmt: skip
    face: Identifier | None = None
    duration_ms: Milliseconds | None = None


class EventsBody(_Body):
    """A bundle of events."""

    events: Annotated[tuple[EventBody, ...], Field(max_length=1000)]


class StopBody(_Body):
    """Stop taking part; `erase` asks for the answers to be erased."""

    erase: bool = False
