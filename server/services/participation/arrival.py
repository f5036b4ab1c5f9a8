"""What somebody who opens a link brings along, and what the link has for them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

from ..config import StudyConfig  # a dataclass field

if TYPE_CHECKING:
    from .devices import Device

Standing = Literal["open", "running", "taken", "full", "draft", "paused", "closed", "link_closed"]


@dataclass(frozen=True, slots=True)
class Browser:
    """What a browser brings along beside the link.

    Attributes:
        place: the token that the entry page offered.
        known: the token that a cookie of this link holds.
        languages: wanted languages, the best first.
        device: what the page measured, if it could.
        user_agent: name and version of the browser; kept only where the study says so.
    """

    place: str | None = None
    known: str | None = None
    languages: tuple[str, ...] = ()
    device: Device | None = None
    user_agent: str = ""


@dataclass(frozen=True, slots=True)
class Joined:
    """A place that was taken; the token is told once.

    `proof` is for the browser that takes a place under an id that others may know: with it, it may erase.
    """

    token: str
    participation: str
    proof: str | None = None

    @property
    def address(self) -> str:
        """Where the participant goes on."""
        return f"/p/{self.token}"


@dataclass(frozen=True, slots=True)
class Entry:
    """What a link has for somebody.

    Attributes:
        study: the study.
        config: its newest version.
        standing: open: a place can be had. running, taken: this person has begun, has finished. full, and what keeps
            everybody from beginning: draft, paused, closed, link_closed.
        place: the token that a start from this page would have: pressing the button twice takes one place.
        language: the language of the page.
        languages: those to choose from.
        address: where this person goes on, or finds their code.
        anew: whether this person may also begin again from the start.
        code: what the recruiter is told of somebody who met a full study.
        redirect: where they are sent back to.
    """

    study: str
    config: StudyConfig
    standing: Standing
    place: str
    language: str
    languages: tuple[str, ...]
    address: str | None = None
    anew: bool = False
    code: str | None = None
    redirect: str | None = None

    @property
    def outcome(self) -> str | None:
        """The outcome of somebody who comes to a full study."""
        return "full" if self.standing == "full" else None

    @property
    def open(self) -> bool:
        """Whether somebody can begin or go on here."""
        return self.standing in {"open", "running"}
