"""Who may sign in: keys that work once, passwords, sessions that end, and a throttle that opens again."""

from __future__ import annotations

from datetime import timedelta

import pytest

from server.services import clock
from server.services.errors import ForbiddenError, InvalidError, ThrottledError, UnauthorisedError
from server.services.people import accounts as module
from server.services.people.accounts import PAUSE, SETUP_HOURS, Accounts, SignedIn
from server.store.admin_tables import Throttle

NAME, EMAIL, PASSWORD = "Ines Example", "ines@example.org", "correct horse battery"


class Clock:
    """The present moment, which a test may move on."""

    def __init__(self):
        self.ahead = timedelta()

    def __call__(self):
        return clock.now() + self.ahead


@pytest.fixture
def time(monkeypatch):
    moving = Clock()
    monkeypatch.setattr(module, "now", moving)
    return moving


@pytest.fixture
def desk(house, time):
    return Accounts(house.journal.database, session_hours=12, login_attempts=3)


@pytest.fixture
def owner(desk):
    return desk.set_up(desk.new_setup_key(), NAME, EMAIL, PASSWORD)


def test_a_set_up_key_makes_one_account_and_then_there_are_no_more_keys(desk):
    assert desk.needs_setup()
    key = desk.new_setup_key()
    token = desk.set_up(f"  {key.lower()} ", f" {NAME} ", f" {EMAIL.upper()} ", PASSWORD)
    assert not desk.needs_setup()
    who = desk.who(token)
    assert (who.name, who.email, who.role) == (NAME, EMAIL, "owner")
    assert desk.new_setup_key() is None
    with pytest.raises(ForbiddenError):
        desk.set_up(key, NAME, "other@example.org", PASSWORD)


def test_only_the_newest_key_works_and_not_for_ever(desk, time):
    old, new = desk.new_setup_key(), desk.new_setup_key()
    for wrong in (old, "", "0000-0000-0000-0000"):
        with pytest.raises(ForbiddenError):
            desk.set_up(wrong, NAME, EMAIL, PASSWORD)
    time.ahead = timedelta(hours=SETUP_HOURS)
    with pytest.raises(ForbiddenError):
        desk.set_up(new, NAME, EMAIL, PASSWORD)
    assert desk.needs_setup()


@pytest.mark.parametrize(
    ("change", "field"),
    [
        ({"name": "  "}, "name"),
        ({"name": "x" * 201}, "name"),
        ({"email": "nobody"}, "email"),
        ({"email": "@example.org"}, "email"),
        ({"email": "ines@"}, "email"),
        ({"email": "in es@example.org"}, "email"),
        ({"password": "too short"}, "password"),
        ({"password": "x" * 1001}, "password"),
    ],
)
def test_a_wrong_field_is_named_and_costs_no_key(desk, change, field):
    key, good = desk.new_setup_key(), {"name": NAME, "email": EMAIL, "password": PASSWORD}
    with pytest.raises(InvalidError) as caught:
        desk.set_up(key, **{**good, **change})
    assert caught.value.field == field
    assert desk.who(desk.set_up(key, **good)).name == NAME


def test_a_password_opens_a_session_of_its_own(desk, owner):
    other = desk.sign_in(f" {EMAIL.title()} ", PASSWORD)
    assert other != owner
    assert desk.who(other).csrf != desk.who(owner).csrf
    assert desk.who(other).user == desk.who(owner).user


def test_sessions_end_one_by_one_and_after_their_hours(desk, owner, time):
    other = desk.sign_in(EMAIL, PASSWORD)
    desk.sign_out(other)
    assert desk.who(owner).email == EMAIL
    for token in (other, None, "", "guess"):
        with pytest.raises(UnauthorisedError):
            desk.who(token)
    third = desk.sign_in(EMAIL, PASSWORD)
    time.ahead = timedelta(hours=11, minutes=59)
    assert desk.who(third).email == EMAIL
    time.ahead = timedelta(hours=12, seconds=1)
    with pytest.raises(UnauthorisedError):
        desk.who(third)


@pytest.mark.usefixtures("owner")
@pytest.mark.parametrize("email", [EMAIL, "stranger@example.org"])
def test_wrong_passwords_close_an_address_for_a_while_whoever_it_belongs_to(desk, time, email):
    for _ in range(3):
        with pytest.raises(UnauthorisedError):
            desk.sign_in(email, "wrong horse battery")
    with pytest.raises(ThrottledError) as caught:
        desk.sign_in(email.upper(), PASSWORD)
    assert 0 < caught.value.retry_after <= PAUSE.total_seconds() + 1
    time.ahead = PAUSE + timedelta(seconds=1)
    with pytest.raises(UnauthorisedError):
        desk.sign_in(email, "wrong again, once more")
    if email == EMAIL:
        assert desk.who(desk.sign_in(email, PASSWORD)).email == EMAIL


@pytest.mark.usefixtures("owner")
def test_a_right_password_forgives_the_wrong_ones(desk):
    for _ in range(4):
        for _ in range(2):
            with pytest.raises(UnauthorisedError):
                desk.sign_in(EMAIL, "wrong horse battery")
        desk.sign_in(EMAIL, PASSWORD)


@pytest.mark.usefixtures("owner")
def test_wrong_passwords_for_many_addresses_close_all_of_them_for_a_while(desk, time, monkeypatch):
    monkeypatch.setattr(module, "MOST_FAILURES", 4)
    for number in range(4):
        with pytest.raises(UnauthorisedError):
            desk.sign_in(f"guess{number}@example.org", "wrong horse battery")
    with pytest.raises(ThrottledError):
        desk.sign_in(EMAIL, PASSWORD)
    time.ahead = PAUSE + timedelta(seconds=1)
    assert desk.who(desk.sign_in(EMAIL, PASSWORD)).email == EMAIL


def test_wrong_passwords_are_forgotten_when_they_count_no_more(desk, time):
    for ahead, email in ((timedelta(), "old@example.org"), (PAUSE, "new@example.org")):
        time.ahead = ahead
        with pytest.raises(UnauthorisedError):
            desk.sign_in(email, "wrong horse battery")
    assert [desk.sweep(), desk.sweep()] == [1, 0]
    with desk.database.read() as tx:
        assert tx.query(Throttle).one().key == clock.digest("new@example.org")


@pytest.mark.parametrize(
    ("name", "initials"),
    [("Ines Example", "IE"), ("ines maria example", "IE"), ("Ines", "I"), ("", "I"), ("Ines Ines", "I")],
)
def test_initials(name, initials):
    assert SignedIn("id", name, EMAIL, "owner", "csrf").initials == initials
