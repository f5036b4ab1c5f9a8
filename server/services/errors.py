"""What a service may refuse, drawn as one tree; the routes turn each into a status and the one error shape."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, ClassVar

from ..store import engine

if TYPE_CHECKING:
    from collections.abc import Sequence


StorageError = engine.StorageError
"""The store cannot read or write at the moment; routes, which do not know the store, answer it as well."""


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


class NoStudyError(NotFoundError):
    """There is no study of this id."""

    def __init__(self, study_id: str) -> None:
        super().__init__("There is no such study.", field="study", got=study_id)


class InvalidError(ServiceError):
    """The content is not acceptable; nothing was stored. `problems` has all that is wrong, where that is known."""

    code = "invalid"
    problems: Sequence[Any] = ()


class DeviceError(InvalidError):
    """The study does not admit this device; `reason` is phone or small. The same link works on another one."""

    code = "device"

    def __init__(self, reason: str, expected: str, got: str) -> None:
        super().__init__(
            "This study cannot be done on this device. Open the same link on another one, or in a larger window.",
            field="viewport",
            expected=expected,
            got=got,
        )
        self.reason = reason


class UnauthorisedError(ServiceError):
    """Nobody is signed in, or the token is unknown, expired or revoked."""

    code = "unauthorised"


class ForbiddenError(ServiceError):
    """Known, but not allowed to do this."""

    code = "forbidden"


class ConflictError(ServiceError):
    """The request does not fit the state that things are in."""

    code = "conflict"


class FullError(ConflictError):
    """No place is left in the study, or none of the kind that was asked for."""

    code = "full"

    def __init__(self) -> None:
        super().__init__("This study has enough participants now. Thank you for your interest.")


class ClosedError(ConflictError):
    """Nobody can begin now: the study is a draft, paused or closed, or the link is closed."""

    code = "closed"
    _SENTENCES: ClassVar[dict[str, str]] = {
        "draft": "This study has not begun yet.",
        "paused": "This study is paused. Nobody can begin at the moment.",
        "closed": "This study is over. Thank you for your interest.",
        "link_closed": "This link is closed. Ask whoever sent it to you for another one.",
    }

    def __init__(self, standing: str) -> None:
        super().__init__(self._SENTENCES[standing])
        self.standing = standing


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
