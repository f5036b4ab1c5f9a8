"""The one place that looks at the clock and at the system's source of secrets."""

from __future__ import annotations

import hashlib
import secrets
import uuid
from contextlib import contextmanager
from datetime import UTC, datetime
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

# No vowels and no look-alikes: codes are read aloud and typed, and must not spell words.
_CODE_LETTERS = "23456789BCDFGHJKMNPQRSTVWXZ"


def now() -> datetime:
    """Return the present moment in UTC."""
    return _told()


def local(moment: datetime) -> datetime:
    """Return a moment in the time zone of this machine, for pages that show the time of day (TZ sets it)."""
    return moment.astimezone()


@contextmanager
def told_by(clock: Callable[[], datetime]) -> Iterator[None]:
    """Let another clock tell the time to all services while the block runs: for rehearsals and tests."""
    global _told  # noqa: PLW0603 - one clock for the whole process is the point
    before, _told = _told, clock
    try:
        yield
    finally:
        _told = before


def _system() -> datetime:
    return datetime.now(UTC)


_told: Callable[[], datetime] = _system


def new_id() -> str:
    """Return a random identifier that tells nothing about what it names."""
    return str(uuid.uuid4())


def new_token() -> str:
    """Return 192 random bits for an address or a key."""
    return secrets.token_urlsafe(24)


def new_seed() -> str:
    """Return 128 random bits as decimal text, the way seeds are stored."""
    return str(secrets.randbits(128))


def new_code(groups: int = 3) -> str:
    """Return a code for people, such as `7PQX-M4TD-2KVR`."""
    return "-".join("".join(secrets.choice(_CODE_LETTERS) for _ in range(4)) for _ in range(groups))


def digest(secret: str) -> str:
    """Return what is stored of a token; tokens are long and random, so a plain hash is enough."""
    return hashlib.sha256(secret.encode()).hexdigest()
