"""The people who work here: invitations, roles, passwords, sessions."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import timedelta
from typing import TYPE_CHECKING

from ...store import accounts, people, runs
from ...store.admin_tables import Invitation, User
from ..clock import digest, new_id, new_token, now
from ..errors import ConflictError, ForbiddenError, NotFoundError
from .accounts import audit, checked_address, new_user
from .passwords import new_password, right_password
from .roles import checked_role

if TYPE_CHECKING:
    from collections.abc import Sequence
    from datetime import datetime

    from ...store.engine import Database, Tx

INVITATION_DAYS = 7


@dataclass(frozen=True, slots=True)
class Person:
    """Somebody with an account."""

    id: str
    name: str
    email: str
    role: str
    since: datetime
    disabled: bool


@dataclass(frozen=True, slots=True)
class Pending:
    """Somebody who was invited and has not come yet."""

    id: str
    email: str
    role: str
    expires_at: datetime


@dataclass(frozen=True, slots=True)
class SessionView:
    """A sign-in that works; `id` ends it."""

    id: str
    browser: str
    since: datetime
    seen_at: datetime | None


@dataclass(frozen=True)
class People:
    """Everybody with an account, and those who are to have one."""

    database: Database

    def all(self) -> list[Person]:
        """Return everybody, in the order in which they came."""
        with self.database.read() as tx:
            return [
                Person(row.id, row.name, row.email, row.role, row.created_at, row.disabled_at is not None)
                for row in people.users(tx)
            ]

    def pending(self) -> list[Pending]:
        """Return the invitations that work."""
        with self.database.read() as tx:
            return [Pending(row.id, row.email, row.role, row.expires_at) for row in people.live_invitations(tx, now())]

    def invite(self, email: str, role: str, author: str) -> str:
        """Return the key of an invitation, which is told once; an earlier one for the same address stops working.

        Raises:
            InvalidError: no e-mail address, or no role.
            ConflictError: somebody has an account with this address.
        """
        address, role = checked_address(email), checked_role(role)
        key = new_token()
        with self.database.write() as tx:
            if accounts.user_by_email(tx, address) is not None:
                raise ConflictError("Somebody has an account with this address.", field="email", got=address)
            people.revoke_invitations(tx, address, now())
            made = Invitation(
                id=new_id(),
                token_hash=digest(key),
                email=address,
                role=role,
                author_id=author,
                created_at=now(),
                expires_at=now() + timedelta(days=INVITATION_DAYS),
            )
            runs.add(tx, made)
            audit(tx, author, "invite", address, role=role)
        return key

    def invited(self, key: str) -> Pending:
        """Return what an invitation says.

        Raises:
            NotFoundError: it was used or taken back, or is too old.
        """
        with self.database.read() as tx:
            row = _live(tx, key)
            return Pending(row.id, row.email, row.role, row.expires_at)

    def accept(self, key: str, name: str, password: str) -> None:
        """Make the account of an invitation.

        Raises:
            NotFoundError: it was used or taken back, or is too old.
            InvalidError: a field is not acceptable.
            ConflictError: its address got an account meanwhile.
        """
        hashed = new_password(password)
        with self.database.write() as tx:
            invitation = _live(tx, key, lock=True)
            user = new_user(name, invitation.email, hashed, invitation.role)
            invitation.used_at = now()
            if not runs.add_once(tx, user):
                raise ConflictError("Somebody has an account with this e-mail address already. Sign in with it.")
            audit(tx, user.id, "accept invitation", user.email, role=user.role)

    def take_back(self, invitation_id: str, author: str) -> None:
        """Make an invitation useless.

        Raises:
            NotFoundError: no such invitation.
        """
        with self.database.write() as tx:
            found = people.invitation(tx, invitation_id)
            if found is None:
                raise NotFoundError("There is no such invitation.")
            found.revoked_at = found.revoked_at or now()
            audit(tx, author, "take back invitation", found.email)

    def change_role(self, user_id: str, role: str, author: str) -> None:
        """Give somebody another role.

        Raises:
            NotFoundError: nobody has this id.
            ConflictError: nobody would be left who may decide who works here.
        """
        role = checked_role(role)
        with self.database.write() as tx:
            owners = people.owners(tx)
            user = _found(tx, user_id, lock=True)
            before, user.role = user.role, role
            _keep_an_owner([*owners, user])
            audit(tx, author, "change role", user.email, before=before, after=role)

    def disable(self, user_id: str, author: str, *, disabled: bool = True) -> None:
        """Let somebody sign in no more, or again; their sessions end at once.

        Raises:
            NotFoundError: nobody has this id.
            ConflictError: nobody would be left who may decide who works here.
        """
        with self.database.write() as tx:
            owners = people.owners(tx)
            user = _found(tx, user_id, lock=True)
            user.disabled_at = now() if disabled else None
            _keep_an_owner([*owners, user])
            accounts.revoke_sessions(tx, user_id, now())
            audit(tx, author, "disable account" if disabled else "enable account", user.email)

    def change_password(self, user_id: str, old: str, new: str) -> None:
        """Change one's own password; every session ends.

        Raises:
            ForbiddenError: the old password is wrong.
            InvalidError: the new one is too short.
        """
        hashed = new_password(new)
        with self.database.read() as tx:
            stored = _found(tx, user_id).password_hash
        if not right_password(stored, old):
            raise ForbiddenError("The old password is not right.", field="old")
        with self.database.write() as tx:
            user = _found(tx, user_id, lock=True)
            user.password_hash = hashed
            accounts.revoke_sessions(tx, user_id, now())
            audit(tx, user_id, "change password", user.email)

    def sessions(self, user_id: str) -> list[SessionView]:
        """Return the sign-ins of somebody that work, the newest first."""
        with self.database.read() as tx:
            return [
                SessionView(row.token_hash, row.browser, row.created_at, row.seen_at)
                for row in people.live_sessions(tx, user_id, now())
            ]

    def end_session(self, user_id: str, session_id: str) -> None:
        """End one of one's own sign-ins.

        Raises:
            NotFoundError: no such session.
        """
        with self.database.write() as tx:
            found = accounts.session(tx, session_id)
            if found is None or found[1].id != user_id:
                raise NotFoundError("There is no such session.")
            found[0].revoked_at = found[0].revoked_at or now()
            audit(tx, user_id, "end session", found[1].email)


def _live(tx: Tx, key: str, *, lock: bool = False) -> Invitation:
    found = people.invitation_by_hash(tx, digest(key), lock=lock)
    if found is None or found.used_at or found.revoked_at or found.expires_at <= now():
        raise NotFoundError("This invitation was used or taken back, or is too old. Ask for a new one.", field="key")
    return found


def _found(tx: Tx, user_id: str, *, lock: bool = False) -> User:
    user = people.user(tx, user_id, lock=lock)
    if user is None:
        raise NotFoundError("Nobody has this account.")
    return user


def _keep_an_owner(owners: Sequence[User]) -> None:
    if not any(one.role == "owner" and one.disabled_at is None for one in owners):
        raise ConflictError("Somebody must stay who may decide who works here. Make another owner first.")
