"""Who may sign in: a one-time set-up key instead of a default account, Argon2 passwords, sessions, a throttle."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import timedelta
from typing import TYPE_CHECKING

from ...store import accounts, runs
from ...store.admin_tables import AuditEntry, SetupToken, Throttle, User, UserSession
from ..clock import digest, new_code, new_id, new_token, now
from ..errors import ForbiddenError, InvalidError, ThrottledError, UnauthorisedError
from .passwords import new_password, right_password

if TYPE_CHECKING:
    from datetime import datetime

    from ...store.engine import Database, Tx

SETUP_HOURS = 24
PAUSE = timedelta(minutes=15)
MOST_FAILURES = 1000
"""Wrong passwords for all addresses together within such a pause, after which every sign-in has to wait."""
SEEN = timedelta(minutes=5)
"""How old the record of a session's last use may be, so that not every page is a write."""


@dataclass(frozen=True, slots=True)
class SignedIn:
    """Somebody who is signed in."""

    user: str
    name: str
    email: str
    role: str
    csrf: str

    @property
    def initials(self) -> str:
        """First letters of first and last name."""
        words = self.name.split() or [self.email]
        return "".join(word[0] for word in dict.fromkeys((words[0], words[-1]))).upper()


@dataclass(frozen=True)
class Accounts:
    """Users and their sessions."""

    database: Database
    session_hours: int
    login_attempts: int

    def new_setup_key(self) -> str | None:
        """Return a fresh set-up key while nobody has an account; earlier keys stop working."""
        key = new_code(4)
        with self.database.write() as tx:
            if accounts.user_count(tx):
                return None
            accounts.retire_setup_tokens(tx, now())
            runs.add(tx, SetupToken(token_hash=digest(key), created_at=now()))
        return key

    def needs_setup(self) -> bool:
        """Return whether nobody has an account yet."""
        with self.database.read() as tx:
            return accounts.user_count(tx) == 0

    def set_up(self, key: str, name: str, email: str, password: str) -> str:
        """Make the owner's account and return the token of their first session.

        Raises:
            ForbiddenError: the key is wrong, used, or older than a day.
            InvalidError: a field is not acceptable.
        """
        hashed = new_password(password)
        with self.database.write() as tx:
            token = accounts.setup_token(tx, digest(key.strip().upper()))
            fresh = (
                token is not None and token.used_at is None and now() - token.created_at < timedelta(hours=SETUP_HOURS)
            )
            if token is None or not fresh or accounts.user_count(tx):
                raise ForbiddenError(
                    "This set-up key does not work: it was used or is too old. Restart the server for a new one.",
                    field="key",
                )
            token.used_at = now()
            user = new_user(name, email, hashed, "owner")
            runs.add(tx, user)
            audit(tx, user.id, "set up", user.email)
            return self._begin(tx, user)

    def sign_in(self, email: str, password: str, browser: str = "") -> str:
        """Return the token of a new session; `browser` tells it from others in the list of sign-ins.

        Raises:
            ThrottledError: too many wrong passwords for this address, or for all together.
            UnauthorisedError: address or password is wrong.
        """
        key = digest(email.strip().lower())
        self._check_throttle(key)
        with self.database.read() as tx:
            user = accounts.user_by_email(tx, email.strip().lower())
        right = right_password(user.password_hash if user else None, password)
        with self.database.write() as tx:
            if user is None or not right or user.disabled_at is not None:
                _count_failure(tx, key)
            else:
                _forget_failures(tx, key)
                audit(tx, user.id, "sign in", user.email)
                return self._begin(tx, user, browser)
        raise UnauthorisedError("The e-mail address or the password is not right.", field="password")

    def who(self, token: str | None) -> SignedIn:
        """Return who a session belongs to.

        Raises:
            UnauthorisedError: nobody is signed in.
        """
        with self.database.read() as tx:
            found = accounts.session(tx, digest(token)) if token else None
        if found is None or found[0].revoked_at is not None or found[0].expires_at <= now():
            raise UnauthorisedError("Sign in to go on.")
        session, user = found
        if session.seen_at is None or now() - session.seen_at > SEEN:
            self._seen(session.token_hash)
        return SignedIn(user.id, user.name, user.email, user.role, session.csrf)

    def session_id(self, token: str) -> str:
        """Return what a session is called in the list of sign-ins."""
        return digest(token)

    def sign_out(self, token: str) -> None:
        """End a session."""
        with self.database.write() as tx:
            found = accounts.session(tx, digest(token))
            if found is not None:
                found[0].revoked_at = found[0].revoked_at or now()
                audit(tx, found[1].id, "sign out", found[1].email)

    def _seen(self, token_hash: str) -> None:
        with self.database.write() as tx:
            found = accounts.session(tx, token_hash)
            if found is not None:
                found[0].seen_at = now()

    def _begin(self, tx: Tx, user: User, browser: str = "") -> str:
        token = new_token()
        session = UserSession(
            token_hash=digest(token),
            user_id=user.id,
            csrf=new_token(),
            browser=browser[:200],
            created_at=now(),
            expires_at=now() + timedelta(hours=self.session_hours),
        )
        runs.add(tx, session)
        return token

    def _check_throttle(self, key: str) -> None:
        with self.database.read() as tx:
            found = accounts.throttle(tx, key)
            failures, first = accounts.failures(tx, now() - PAUSE)
        if found is not None and found.failures >= self.login_attempts:
            _pause_from(found.since)
        if first is not None and failures >= MOST_FAILURES:
            _pause_from(first)

    def sweep(self) -> int:
        """Forget wrong passwords that count no more; return for how many addresses."""
        with self.database.write() as tx:
            return accounts.forget_throttles(tx, now() - PAUSE)


def audit(tx: Tx, user: str | None, action: str, subject: str, **detail: object) -> None:
    """Write down who did what."""
    runs.add(tx, AuditEntry(id=new_id(), at=now(), user_id=user, action=action, subject=subject, detail=detail))


def new_user(name: str, email: str, hashed: str, role: str) -> User:
    """Return the row of a new account.

    Raises:
        InvalidError: a field is not acceptable.
    """
    if not name.strip() or len(name) > 200:
        raise InvalidError("Enter your name.", field="name", expected="1 to 200 characters")
    address = checked_address(email)
    return User(id=new_id(), email=address, name=name.strip(), role=role, password_hash=hashed, created_at=now())


def checked_address(email: str) -> str:
    """Return an e-mail address as it is stored.

    Raises:
        InvalidError: it is none.
    """
    address = email.strip().lower()
    if "@" not in address[1:-1] or len(address) > 254 or any(letter.isspace() for letter in address):
        raise InvalidError("Enter an e-mail address such as name@example.org.", field="email", got=address)
    return address


def _pause_from(since: datetime) -> None:
    left = (since + PAUSE - now()).total_seconds()
    if left > 0:
        raise ThrottledError(f"Too many wrong passwords. Try again in {int(left // 60) + 1} minutes.", int(left) + 1)


def _count_failure(tx: Tx, key: str) -> None:
    found = accounts.throttle(tx, key, lock=True)
    if found is None and not runs.add_once(tx, Throttle(key=key, failures=1, since=now())):
        found = accounts.throttle(tx, key, lock=True)
    if found is None:
        return
    if _over(found.since):
        found.failures, found.since = 1, now()
    else:
        found.failures, found.since = found.failures + 1, now()


def _forget_failures(tx: Tx, key: str) -> None:
    found = accounts.throttle(tx, key, lock=True)
    if found is not None:
        found.failures = 0


def _over(since: datetime) -> bool:
    return now() - since >= PAUSE
