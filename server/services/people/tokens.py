"""Keys to the REST interface: hashed, scoped, expiring, revocable."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import timedelta
from typing import TYPE_CHECKING, Literal

from ...store import accounts, people, runs, studies
from ...store.admin_tables import ApiToken
from ..clock import digest, new_id, new_token, now
from ..errors import ForbiddenError, NoStudyError, NotFoundError, UnauthorisedError
from .accounts import audit
from .roles import require

if TYPE_CHECKING:
    from collections.abc import Sequence
    from datetime import datetime

    from ...store.admin_tables import User
    from ...store.engine import Database

Scope = Literal["export", "simulate"]
PREFIX = "emg_"


@dataclass(frozen=True, slots=True)
class TokenView:
    """A key as it is listed; the key itself is told once, when it is made."""

    id: str
    label: str
    scopes: tuple[str, ...]
    study: str | None
    author: str
    author_id: str | None
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
        """Return a new key; it is stored as a hash and cannot be shown again.

        Raises:
            NotFoundError: it is for a study that there is not.
        """
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
            if study is not None and studies.study(tx, study) is None:
                raise NoStudyError(study)
            runs.add(tx, made)
            audit(tx, user, "create token", made.id, label=made.label, scopes=made.scopes)
        return secret

    def check(self, secret: str | None, scope: Scope, study: str) -> None:
        """Refuse a key that does not open this study for this.

        Raises:
            UnauthorisedError: unknown, expired or revoked, or whoever made it does not work here any more.
            ForbiddenError: for something else.
        """
        bound = self.opened(secret, scope)
        if bound not in {None, study}:
            raise ForbiddenError("This token is for another study.", field="study", got=study)

    def opened(self, secret: str | None, scope: Scope) -> str | None:
        """Return the one study that a key opens for this; None is for all of them.

        Raises:
            UnauthorisedError: unknown, expired or revoked, or whoever made it does not work here any more.
            ForbiddenError: for something else.
        """
        with self.database.read() as tx:
            found = accounts.api_token(tx, digest(secret)) if secret else None
            author = accounts.somebody(tx, found.user_id) if found and found.user_id else None
        if found is None or found.revoked_at is not None or found.expires_at <= now():
            raise UnauthorisedError("Send a valid token: Authorization: Bearer emg_...")
        if author is not None:
            _check_author(author, scope)
        if scope not in found.scopes:
            raise ForbiddenError(
                "This token is not for that.", field="scope", expected=scope, got=", ".join(found.scopes)
            )
        return found.study_id

    def revoke(self, token_id: str, user: str | None = None, *, own: bool = False) -> None:
        """Make a key useless from now on.

        Raises:
            NotFoundError: no such key.
            ForbiddenError: `own` only, and somebody else made it.
        """
        with self.database.write() as tx:
            found = accounts.api_token_by_id(tx, token_id)
            if found is None:
                raise NotFoundError("There is no such token.")
            if own and found.user_id != user:
                raise ForbiddenError("Somebody else made this token. Ask them, or an experimenter.")
            found.revoked_at = found.revoked_at or now()
            audit(tx, user, "revoke token", token_id)

    def all(self) -> list[TokenView]:
        """Return the keys that work now."""
        with self.database.read() as tx:
            names = {user.id: user.name for user in people.users(tx)}
            return [
                TokenView(
                    row.id,
                    row.label,
                    tuple(row.scopes),
                    row.study_id,
                    names.get(row.user_id or "", ""),
                    row.user_id,
                    row.expires_at,
                )
                for row in accounts.live_api_tokens(tx, now())
            ]


def _check_author(author: User, scope: Scope) -> None:
    """Refuse a key of somebody who left, or who may not do any more what it does."""
    if author.disabled_at is not None:
        raise UnauthorisedError("Whoever made this token does not work here any more. Ask for another one.")
    if scope == "simulate":
        require(author.role, "work")
