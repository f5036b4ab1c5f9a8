"""Emotions, texts and translations, portraits, devices, and what a participant is sent back with."""

from __future__ import annotations

import json
from typing import Annotated, Any, Literal

from pydantic import Field, PlainValidator

from emogen_core.face.identity import DOCUMENT_BYTES

from .base import Line, OptionalLine, Part, Prose, option

Outcome = Literal["complete", "no_consent", "screened_out", "failed_checks", "full", "stopped"]
Question = Literal["intensity", "satisfaction"]
Address = Annotated[str, Field(pattern=r"^https://", max_length=500)]
Adjective = Annotated[str, Field(max_length=200)]


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


class Emotion(Part):
    """An emotion as the study names it: `angry` to look, `anger` to have."""

    adjective: Line = option(..., "Adjective", "The word in the data, and in 'How angry is this face?'.")
    noun: Line = option(..., "Noun", "The word in 'Which faces look most like anger to you?'.")


class Texts(Part):
    """What the study says about itself; the pages leave out what is empty."""

    organisation: OptionalLine = option("", "Organisation", "Who carries the study out.")
    contact_name: OptionalLine = option("", "Contact person", "Whom a participant may ask.")
    contact: OptionalLine = option("", "Contact address", "E-mail address or telephone number of the contact.")
    ethics: Prose = option("", "Ethics approval", "Who approved the study, and under which number.")
    minutes: int = option(0, "Minutes", "How long it takes. 0: not said.", ge=0, le=600)
    payment: OptionalLine = option("", "Payment", "What a participant receives.")
    device: OptionalLine = option("", "Device", "What to take part on, in the study's own words.")
    erase_until: OptionalLine = option("", "Erasable until", "Until when answers can be erased.")
    about: Prose = option("", "About the study", "What a participant is told at the end.")
    purpose: Prose = option("", "Purpose", "What a participant is told before consent.", later=True)
    consents: tuple[Line, ...] = option(
        (), "Consent statements", "Statements to agree to, each with its own box, in the place of the usual ones.",
        later=True, max_length=12,
    )  # fmt: skip


class Translation(Part):
    """The study's own words in one more language; what is empty stays in the study's language."""

    title: OptionalLine = option("", "Title", "The study's title.")
    texts: Texts = option(Texts(), "Texts", "What the study says about itself.")
    emotions: dict[Adjective, Emotion] = option(
        dict, "Emotions", "The words of each emotion, by the adjective that the study has for it."
    )
    words: dict[Annotated[str, Field(max_length=500)], Prose] = option(
        dict, "Other words", "Questions and answers of blocks, by the words that the study has for them."
    )


class Portrait(Part):
    """Size of a portrait in pixels; 5:6."""

    width: int = option(400, "Width of a portrait", "In pixels; the height is six fifths of it.", ge=100, le=1000)

    @property
    def height(self) -> int:
        """Six fifths of the width."""
        return round(self.width * 6 / 5)


LEAST_WIDTH, LEAST_HEIGHT = 320, 300
"""Sides of a screen, in CSS pixels, that every device counts as having."""


class Devices(Part):
    """What a participant may take part on; checked before a place is taken."""

    phones: bool = option(True, "Phones", "Whether phones, and screens of at most 640 px, may take part.")
    least_width: int = option(
        LEAST_WIDTH,
        "Narrowest screen",
        f"In CSS pixels. A smaller window is asked to be made larger but never refused, since a zoomed page has fewer"
        f" pixels. {LEAST_WIDTH}: every screen.",
        ge=LEAST_WIDTH,
        le=4000,
    )
    least_height: int = option(
        LEAST_HEIGHT,
        "Lowest screen",
        f"In CSS pixels, as above. {LEAST_HEIGHT}: every screen.",
        ge=LEAST_HEIGHT,
        le=4000,
    )
    face_degrees: float | None = option(
        None,
        "Height of a picture in degrees",
        "Asks the participant to hold a bank card to the screen and how far away it is, and shows each picture of a"
        " face at this visual angle where the window allows it. Empty: as large as the window allows.",
        ge=1,
        le=30,
    )


class Completion(Part):
    """Codes and addresses a participant is sent back with; without a code everybody gets their own."""

    codes: dict[Outcome, Line] = option(dict, "Codes", "One code for each outcome.")
    redirects: dict[Outcome, Address] = option(
        dict,
        "Addresses",
        "Where a participant is sent for each outcome; {code} and {RECRUITER_PARAMETER} are filled in. The host has"
        " to be one of EMOGEN_REDIRECT_HOSTS.",
    )
