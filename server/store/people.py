"""Queries on the people who work here, their invitations and sign-ins."""

from __future__ import annotations

from typing import TYPE_CHECKING

from sqlalchemy import select, tuple_, update

from .admin_tables import ApiToken, AuditEntry, Invitation, User, UserSession
from .runs_tables import Participation

if TYPE_CHECKING:
    from collections.abc import Collection, Sequence
    from datetime import datetime

    from .engine import Tx


def users(tx: Tx) -> Sequence[User]:
    """Return everybody with an account, in the order in which they came."""
    return tx.scalars(select(User).order_by(User.created_at, User.id)).all()


def user(tx: Tx, user_id: str, *, lock: bool = False) -> User | None:
    """Return somebody; with `lock`, nobody else changes them until this transaction ends."""
    query = select(User).where(User.id == user_id)
    return tx.scalar(query.with_for_update() if lock else query)


def owners(tx: Tx) -> Sequence[User]:
    """Return who may decide who works here, locked, in one order for all, until this transaction ends."""
    query = select(User).where(User.role == "owner", User.disabled_at.is_(None))
    return tx.scalars(query.order_by(User.id).with_for_update()).all()


def invitation(tx: Tx, invitation_id: str) -> Invitation | None:
    """Return an invitation."""
    return tx.get(Invitation, invitation_id)


def invitation_by_hash(tx: Tx, token_hash: str, *, lock: bool = False) -> Invitation | None:
    """Return the invitation of a key; with `lock`, nobody else uses it until this transaction ends."""
    query = select(Invitation).where(Invitation.token_hash == token_hash)
    return tx.scalar(query.with_for_update() if lock else query)


def live_invitations(tx: Tx, at: datetime) -> Sequence[Invitation]:
    """Return the invitations that work, the newest first."""
    query = select(Invitation).where(
        Invitation.used_at.is_(None), Invitation.revoked_at.is_(None), Invitation.expires_at > at
    )
    return tx.scalars(query.order_by(Invitation.created_at.desc())).all()


def revoke_invitations(tx: Tx, email: str, at: datetime) -> None:
    """Make all open invitations of an address useless."""
    query = update(Invitation).where(
        Invitation.email == email, Invitation.used_at.is_(None), Invitation.revoked_at.is_(None)
    )
    tx.execute(query.values(revoked_at=at))


def live_sessions(tx: Tx, user_id: str, at: datetime) -> Sequence[UserSession]:
    """Return the sign-ins of somebody that work, the newest first."""
    query = select(UserSession).where(
        UserSession.user_id == user_id, UserSession.revoked_at.is_(None), UserSession.expires_at > at
    )
    return tx.scalars(query.order_by(UserSession.created_at.desc())).all()


def audit_entries(tx: Tx, before: str | None, limit: int, subject: str | None) -> Sequence[AuditEntry]:
    """Return entries of the trail, the newest first, from behind the one with the id `before`."""
    query = select(AuditEntry).order_by(AuditEntry.at.desc(), AuditEntry.id.desc()).limit(limit)
    last = tx.get(AuditEntry, before) if before else None
    if last is not None:
        query = query.where(tuple_(AuditEntry.at, AuditEntry.id) < tuple_(last.at, last.id))
    return tx.scalars(query if subject is None else query.where(AuditEntry.subject == subject)).all()


def called(tx: Tx, subjects: Collection[str]) -> dict[str, str]:
    """Return what subjects of the trail are called: tokens by their names, participants by their numbers."""
    tokens = tx.execute(select(ApiToken.id, ApiToken.label).where(ApiToken.id.in_(subjects)))
    runs = tx.execute(select(Participation.id, Participation.number).where(Participation.id.in_(subjects)))
    return {**{row[0]: row[1] for row in tokens}, **{row[0]: f"P-{row[1]:04}" for row in runs}}
