"""The answers that a participant's page may send, as schemas; see docs/participant-interface.md."""

from __future__ import annotations

import hashlib
import json
from typing import Annotated, Literal, Self
from uuid import UUID  # pydantic reads it at run time

from pydantic import BaseModel, ConfigDict, Field, TypeAdapter, model_validator

Milliseconds = Annotated[float, Field(ge=0, le=1e10, allow_inf_nan=False)]
Pixels = Annotated[float, Field(ge=0, le=100_000, allow_inf_nan=False)]
Identifier = Annotated[str, Field(pattern=r"^[A-Za-z0-9_-]{1,64}$")]


Text = Annotated[str, Field(max_length=4000, pattern=r"^[^\x00]*$")]
"""What somebody writes; NUL is no letter, and no database keeps it."""
ResponseValue = (
    int | Annotated[float, Field(allow_inf_nan=False)] | Text | Annotated[list[Text], Field(max_length=50)] | None
)


class _Body(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True)


class Timing(_Body):
    """Times of the page's own clock."""

    requested_ms: Milliseconds | None = None
    decoded_ms: Milliseconds | None = None
    onset_ms: Milliseconds | None = None
    chosen_ms: Milliseconds | None = None
    hidden_ms: Milliseconds | None = None


class ChoiceTiming(Timing):
    """Times of a choice; `drawn_ms` is what the server said about the face that it drew longest."""

    drawn_ms: Milliseconds | None = None


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
        # Without defaults: a field that comes later does not change the hash of an answer that waits on a device.
        plain = json.dumps(self.model_dump(mode="json", exclude_defaults=True), sort_keys=True)
        return hashlib.sha256(plain.encode()).hexdigest()


class ConsentAnswer(_AnswerBody):
    """Yes or no to taking part."""

    kind: Literal["consent"]
    given: bool


class CalibrationAnswer(_AnswerBody):
    """CSS pixels a millimetre of the screen and the distance of the eyes; neither where nothing was measured."""

    kind: Literal["calibration"]
    px_per_mm: Annotated[float, Field(ge=0.5, le=50, allow_inf_nan=False)] | None = None
    distance_mm: Annotated[float, Field(ge=100, le=5000, allow_inf_nan=False)] | None = None

    @model_validator(mode="after")
    def _both_or_neither(self) -> Self:
        if (self.px_per_mm is None) != (self.distance_mm is None):
            raise ValueError("expected px_per_mm and distance_mm, or neither")
        return self


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
    timing: ChoiceTiming = ChoiceTiming()
    client: Client = Client()
    none_is_close: bool | None = None


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


class ResponseAnswer(_AnswerBody):
    """The answers to one item of a trial without generations."""

    kind: Literal["response"]
    trial: Identifier
    item: int = Field(ge=0)
    values: Annotated[dict[Annotated[str, Field(max_length=40)], ResponseValue], Field(max_length=100)]
    timing: Timing = Timing()


AnswerBody = Annotated[
    ConsentAnswer | CalibrationAnswer | InstructionsAnswer | ChoiceAnswer | ResetAnswer | RatingAnswer | ResponseAnswer,
    Field(discriminator="kind"),
]
ANSWER: TypeAdapter[AnswerBody] = TypeAdapter(AnswerBody)


def trial_of(body: AnswerBody) -> str | None:
    """Return the trial that an answer is for, if it is for one."""
    return None if isinstance(body, (ConsentAnswer, CalibrationAnswer, InstructionsAnswer)) else body.trial


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
