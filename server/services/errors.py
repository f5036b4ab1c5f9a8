"""What a service may refuse, drawn as one tree; the routes turn each into a status and the one error shape."""

from __future__ import annotations

from typing import Any


class ServiceError(Exception):
    """Base of every refusal: a code for programs, a sentence for people that says what to do next."""

    code = "error"

    def __init__(self, message: str, *, field: str | None = None, expected: object = None, got: object = None) -> None:
        super().__init__(message)
        self.message = message
        self.field = field
        self.expected = expected
        self.got = got

    def body(self) -> dict[str, Any]:
        """Return the one shape of an error."""
        told = {"field": self.field, "expected": self.expected, "got": self.got}
        filled = {name: str(value)[:200] for name, value in told.items() if value is not None}
        return {"error": {"code": self.code, "message": self.message, **filled}}


class NotFoundError(ServiceError):
    """There is no such thing, or not for this caller."""

    code = "not_found"


class InvalidError(ServiceError):
    """The content is not acceptable; nothing was stored."""

    code = "invalid"


class UnauthorisedError(ServiceError):
    """Nobody is signed in, or the token is unknown, expired or revoked."""

    code = "unauthorised"


class ForbiddenError(ServiceError):
    """Known, but not allowed to do this."""

    code = "forbidden"


class ConflictError(ServiceError):
    """The request does not fit the state that things are in."""

    code = "conflict"


class RenewedError(ConflictError):
    """The face model was exchanged since a participation began, so it cannot go on."""

    code = "renewed"


class AnswerConflictError(ConflictError):
    """An answer with this id and another content was stored before."""

    code = "answer_conflict"


class StaleStepError(ConflictError):
    """The answer is not for the current step; the current state comes with the refusal."""

    code = "stale_step"

    def __init__(self, message: str, *, state: dict[str, Any], **details: Any) -> None:
        super().__init__(message, **details)
        self.state = state

    def body(self) -> dict[str, Any]:
        """Return the one shape of an error, and the state to go on from."""
        return {**super().body(), "state": self.state}


class ThrottledError(ServiceError):
    """Too many tries; `retry_after` seconds to wait."""

    code = "throttled"

    def __init__(self, message: str, retry_after: int) -> None:
        super().__init__(message)
        self.retry_after = retry_after


class UnavailableError(ServiceError):
    """Not now; `retry_after` seconds to wait."""

    code = "unavailable"

    def __init__(self, message: str, retry_after: int = 1) -> None:
        super().__init__(message)
        self.retry_after = retry_after
