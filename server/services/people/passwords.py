"""Passwords as Argon2 hashes. One takes 64 MB and tens of milliseconds, so few are made at once and few may wait."""

from __future__ import annotations

import secrets
import threading
from contextlib import contextmanager
from typing import TYPE_CHECKING

from argon2 import PasswordHasher
from argon2.exceptions import VerificationError

from ..errors import InvalidError, ThrottledError

if TYPE_CHECKING:
    from collections.abc import Iterator

SHORTEST_PASSWORD = 12
AT_ONCE = 2
WAITING = 20
"""Who comes when so many wait already is sent away: a flood of sign-ins takes neither all memory nor all threads."""
RETRY_SECONDS = 5

_hasher = PasswordHasher()
_turns = threading.BoundedSemaphore(AT_ONCE)
_room = threading.BoundedSemaphore(AT_ONCE + WAITING)
# Checked when nobody has the e-mail address, so that the time taken does not tell who has an account.
_NOBODY = _hasher.hash(secrets.token_hex(16))


def new_password(password: str) -> str:
    """Return the hash of a new password.

    Raises:
        InvalidError: it is too short or too long.
        ThrottledError: too many passwords are being looked at just now.
    """
    if not SHORTEST_PASSWORD <= len(password) <= 1000:
        raise InvalidError(
            f"Enter a password of at least {SHORTEST_PASSWORD} characters.",
            field="password",
            expected=f"at least {SHORTEST_PASSWORD} characters",
            got=f"{len(password)}",
        )
    with _turn():
        return _hasher.hash(password)


def right_password(hashed: str | None, password: str) -> bool:
    """Return whether a password is the one that was hashed; without a hash it takes as long and is not.

    Raises:
        ThrottledError: too many passwords are being looked at just now.
    """
    with _turn():
        try:
            return _hasher.verify(hashed or _NOBODY, password) and hashed is not None
        except VerificationError:
            return False


@contextmanager
def _turn() -> Iterator[None]:
    if not _room.acquire(blocking=False):
        raise ThrottledError("Many people are signing in just now. Try again in a few seconds.", RETRY_SECONDS)
    try:
        with _turns:
            yield
    finally:
        _room.release()
