"""What can go wrong, drawn as one tree."""

from __future__ import annotations


class EmogenClientError(Exception):
    """Base of every error of this package."""


class RefusedError(EmogenClientError):
    """The server refused; `status` and `code` are for programs, the text is the server's sentence."""

    def __init__(self, status: int, code: str, message: str) -> None:
        super().__init__(message)
        self.status = status
        self.code = code


class IncompleteError(EmogenClientError):
    """Something is not what was sent: a download was interrupted, or a file was changed or lost since."""

    def __init__(self, what: str, expected: object, got: object) -> None:
        super().__init__(f"{what}: expected {expected}, got {got}. Load it again.")
        self.what = what


class UnreadableError(EmogenClientError):
    """A file is what was sent, but not what its name and the data dictionary say that it is."""

    def __init__(self, what: str, why: str) -> None:
        super().__init__(f"{what}: expected what the data dictionary says, got something unreadable: {why}")
        self.what = what


class FramesMissingError(EmogenClientError):
    """The library that makes the frames that were asked for is not installed."""

    def __init__(self, library: str) -> None:
        super().__init__(f"{library} is not installed: install the extra `client`, or ask for other frames.")
