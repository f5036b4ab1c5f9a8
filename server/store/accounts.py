"""Queries on users, sessions, tokens, throttles and the audit trail."""

from __future__ import annotations

from typing import TYPE_CHECKING

from sqlalchemy import delete, func, select, update

from .admin_tables import ApiToken, SetupToken, Throttle, User, UserSession

if TYPE_CHECKING:
    from collections.abc import Sequence
    from datetime import datetime

    from .engine import Tx


def user_count(tx: Tx) -> int:
    """Return how many people may sign in."""
    return int(tx.scalar(select(func.count()).select_from(User)) or 0)


def user_by_email(tx: Tx, email: str) -> User | None:
    """Return the user of an e-mail address."""
    return tx.scalar(select(User).where(User.email == email))


def somebody(tx: Tx, user_id: str) -> User | None:
    """Return a user by id."""
    return tx.get(User, user_id)


def setup_token(tx: Tx, token_hash: str) -> SetupToken | None:
    """Return a set-up token, locked."""
    return tx.scalar(select(SetupToken).where(SetupToken.token_hash == token_hash).with_for_update())


def retire_setup_tokens(tx: Tx, at: datetime) -> None:
    """Make every unused set-up token useless."""
    tx.execute(update(SetupToken).where(SetupToken.used_at.is_(None)).values(used_at=at))


def session(tx: Tx, token_hash: str) -> tuple[UserSession, User] | None:
    """Return a session and its user."""
    row = tx.execute(
        select(UserSession, User).join(User, User.id == UserSession.user_id).where(UserSession.token_hash == token_hash)
    ).first()
    return None if row is None else (row[0], row[1])


def revoke_sessions(tx: Tx, user_id: str, at: datetime) -> None:
    """End every session of a user."""
    tx.execute(
        update(UserSession)
        .where(UserSession.user_id == user_id, UserSession.revoked_at.is_(None))
        .values(revoked_at=at)
    )


def api_token(tx: Tx, token_hash: str) -> ApiToken | None:
    """Return an API token by its hash."""
    return tx.scalar(select(ApiToken).where(ApiToken.token_hash == token_hash))


def api_token_by_id(tx: Tx, token_id: str) -> ApiToken | None:
    """Return an API token by its id."""
    return tx.get(ApiToken, token_id)


def live_api_tokens(tx: Tx, at: datetime) -> Sequence[ApiToken]:
    """Return the API tokens that work, the newest first."""
    return tx.scalars(
        select(ApiToken)
        .where(ApiToken.revoked_at.is_(None), ApiToken.expires_at > at)
        .order_by(ApiToken.created_at.desc())
    ).all()


def throttle(tx: Tx, key: str, *, lock: bool = False) -> Throttle | None:
    """Return the failed sign-ins of a key; with `lock`, nobody else counts until this transaction ends."""
    query = select(Throttle).where(Throttle.key == key)
    return tx.scalar(query.with_for_update() if lock else query)


def failures(tx: Tx, since: datetime) -> tuple[int, datetime | None]:
    """Return how many failed sign-ins began to count after a moment, of all keys, and when the first one did."""
    first = func.min(Throttle.since, type_=Throttle.since.type)
    row = tx.execute(select(func.coalesce(func.sum(Throttle.failures), 0), first).where(Throttle.since > since)).one()
    return int(row[0]), row[1]


def forget_throttles(tx: Tx, before: datetime) -> int:
    """Forget the failed sign-ins that began to count before a moment; return of how many keys."""
    gone = tx.scalars(delete(Throttle).where(Throttle.since <= before).returning(Throttle.key))
    return len(gone.all())
