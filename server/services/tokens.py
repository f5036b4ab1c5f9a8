"""Keys to the REST interface: hashed, scoped, expiring, revocable."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import timedelta
from typing import TYPE_CHECKING, Literal

from ..store import accounts, runs
from ..store.admin_tables import ApiToken
from .accounts import audit
from .clock import digest, new_id, new_token, now
from .errors import ForbiddenError, NotFoundError, UnauthorisedError

if TYPE_CHECKING:
    from collections.abc import Sequence
    from datetime import datetime

    from ..store.engine import Database

Scope = Literal["export", "simulate"]
PREFIX = "emg_"


@dataclass(frozen=True, slots=True)
class TokenView:
    """A key as it is listed; the key itself is told once, when it is made."""

    id: str
    label: str
    scopes: tuple[str, ...]
    study: str | None
    expires_at: datetime


@dataclass(frozen=True)
class Tokens:
    """The keys of this server."""

    database: Database

    def create(
        self,
        label: str,
        scopes: Sequence[Scope],
        *,
        study: str | None = None,
        days: float = 90,
        user: str | None = None,
    ) -> str:
        """Return a new key; it is stored as a hash and cannot be shown again."""
        secret = PREFIX + new_token()
        made = ApiToken(
            id=new_id(),
            token_hash=digest(secret),
            label=label.strip()[:200] or "Token",
            scopes=list(scopes),
            study_id=study,
            user_id=user,
            created_at=now(),
            expires_at=now() + timedelta(days=days),
        )
        with self.database.write() as tx:
            runs.add(tx, made)
            audit(tx, user, "create token", made.id, label=made.label, scopes=made.scopes)
        return secret

    def check(self, secret: str | None, scope: Scope, study: str | None = None) -> None:
        """Refuse a key that does not open this.

        Raises:
            UnauthorisedError: unknown, expired or revoked.
            ForbiddenError: for something else.
        """
        with self.database.read() as tx:
            found = accounts.api_token(tx, digest(secret)) if secret else None
        if found is None or found.revoked_at is not None or found.expires_at <= now():
            raise UnauthorisedError("Send a valid token: Authorization: Bearer emg_...")
        if scope not in found.scopes:
            raise ForbiddenError("This token is not for that.", field="scope", expected=scope, got=found.scopes)
        if found.study_id is not None and found.study_id != study:
            raise ForbiddenError("This token is for another study.", field="study", got=study)

    def revoke(self, token_id: str, user: str | None = None) -> None:
        """Make a key useless from now on.

        Raises:
            NotFoundError: no such key.
        """
        with self.database.write() as tx:
            found = accounts.api_token_by_id(tx, token_id)
            if found is None:
                raise NotFoundError("There is no such token.")
            found.revoked_at = found.revoked_at or now()
            audit(tx, user, "revoke token", token_id)

    def all(self) -> list[TokenView]:
        """Return the keys that work now."""
        with self.database.read() as tx:
            return [
                TokenView(row.id, row.label, tuple(row.scopes), row.study_id, row.expires_at)
                for row in accounts.live_api_tokens(tx, now())
            ]
