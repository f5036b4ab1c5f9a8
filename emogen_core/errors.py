"""What can go wrong in the core, drawn as one tree."""

from __future__ import annotations


class EmogenError(Exception):
    """Base of every error that this package raises on purpose."""


class InvalidInputError(EmogenError, ValueError):
    """An argument is not what the function needs; the message says what was expected and what was got."""


class IdentityError(InvalidInputError):
    """An identity document is not one, contradicts itself, or may not be used; the message names the field."""


class WorkerError(EmogenError):
    """A process that shares the work was ended from outside, or cannot be reached; the message says what to do."""


class RigFileError(EmogenError):
    """A rig or look file is damaged, foreign or of another version."""


class RenderingError(EmogenError):
    """A face could not be drawn."""


class MissingGLError(RenderingError):
    """This machine offers no OpenGL; the message is one sentence with what to install."""


LONGEST = 400
"""Letters of a wrong value that a message repeats."""


def expected(what: str, got: object) -> str:
    """Return the sentence that every message of this package uses for bad input."""
    told = repr(got)
    return f"expected {what}, got {told if len(told) <= LONGEST else told[:LONGEST] + '...'}"
