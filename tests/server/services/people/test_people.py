"""Invitations, roles, passwords and sign-ins, and that somebody always stays who may decide."""

from datetime import timedelta

import pytest

from server.services.clock import now
from server.services.errors import ConflictError, ForbiddenError, InvalidError, NotFoundError, UnauthorisedError
from server.services.people import people as people_module
from server.services.people.people import People
from server.services.people.roles import RIGHTS, require
from tests.conftest import BOTH

pytestmark = BOTH
PASSWORD = "correct horse battery"


@pytest.fixture
def people(house):
    return People(house.database)


@pytest.fixture
def owner(house, people):
    house.accounts.set_up(house.accounts.new_setup_key(), "Ines Marchetti", "ines@example.org", PASSWORD)
    return people.all()[0].id


def joined(people, owner, email="bo@example.org", role="analyst"):
    people.accept(people.invite(email, role, owner), "Bo", PASSWORD)
    return next(one.id for one in people.all() if one.email == email)


def test_an_invitation_makes_one_account_with_its_role(people, owner, house):
    key = people.invite(" Bo@Example.org", "analyst", owner)
    assert people.invited(key).email == "bo@example.org"
    people.accept(key, "Bo", PASSWORD)
    assert [(one.email, one.role) for one in people.all()] == [
        ("ines@example.org", "owner"),
        ("bo@example.org", "analyst"),
    ]
    assert people.pending() == []
    assert house.accounts.who(house.accounts.sign_in("bo@example.org", PASSWORD)).role == "analyst"
    for call in (lambda: people.accept(key, "Eve", PASSWORD), lambda: people.invited(key)):
        with pytest.raises(NotFoundError):
            call()
    with pytest.raises(ConflictError):
        people.invite("bo@example.org", "owner", owner)


def test_invitations_end(people, owner, monkeypatch):
    first, second = people.invite("bo@example.org", "analyst", owner), people.invite("bo@example.org", "owner", owner)
    with pytest.raises(NotFoundError):
        people.invited(first)
    people.take_back(people.pending()[0].id, owner)
    with pytest.raises(NotFoundError):
        people.invited(second)
    third = people.invite("bo@example.org", "analyst", owner)
    monkeypatch.setattr(people_module, "now", lambda: now() + timedelta(days=8))
    with pytest.raises(NotFoundError):
        people.accept(third, "Bo", PASSWORD)


def test_of_two_invitations_for_one_address_one_makes_the_account(people, owner, monkeypatch):
    monkeypatch.setattr(people_module.people, "revoke_invitations", lambda *_: None)  # as when both are made at once
    first, second = (people.invite("bo@example.org", "analyst", owner) for _ in range(2))
    people.accept(first, "Bo", PASSWORD)
    with pytest.raises(ConflictError, match="account with this e-mail address"):
        people.accept(second, "Bo", PASSWORD)
    assert [one.email for one in people.all()] == ["ines@example.org", "bo@example.org"]


@pytest.mark.parametrize(("email", "role"), [("bo", "owner"), ("bo@example.org", "king"), ("bo@example.org", "")])
def test_wrong_invitations_are_refused(people, owner, email, role):
    with pytest.raises(InvalidError):
        people.invite(email, role, owner)
    assert people.pending() == []


def test_an_account_that_is_disabled_ends_at_once(people, owner, house):
    bo = joined(people, owner)
    token = house.accounts.sign_in("bo@example.org", PASSWORD)
    people.disable(bo, owner)
    with pytest.raises(UnauthorisedError):
        house.accounts.who(token)
    with pytest.raises(UnauthorisedError):
        house.accounts.sign_in("bo@example.org", PASSWORD)
    people.disable(bo, owner, disabled=False)
    assert house.accounts.who(house.accounts.sign_in("bo@example.org", PASSWORD)).user == bo


def test_an_owner_always_stays(people, owner):
    bo = joined(people, owner)
    for call in (lambda: people.change_role(owner, "analyst", owner), lambda: people.disable(owner, owner)):
        with pytest.raises(ConflictError):
            call()
    assert people.all()[0].role == "owner"
    people.change_role(bo, "owner", owner)
    people.change_role(owner, "analyst", bo)
    assert [one.role for one in people.all()] == ["analyst", "owner"]


def test_a_new_password_ends_every_session(people, owner, house):
    token = house.accounts.sign_in("ines@example.org", PASSWORD)
    with pytest.raises(ForbiddenError):
        people.change_password(owner, "wrong", "another long password")
    with pytest.raises(InvalidError):
        people.change_password(owner, PASSWORD, "short")
    assert house.accounts.who(token).user == owner
    people.change_password(owner, PASSWORD, "another long password")
    with pytest.raises(UnauthorisedError):
        house.accounts.who(token)
    assert house.accounts.sign_in("ines@example.org", "another long password")


def test_sign_ins_are_listed_and_ended_one_by_one(people, owner, house):
    bo = joined(people, owner)
    here = house.accounts.sign_in("ines@example.org", PASSWORD, "Firefox")
    there = house.accounts.sign_in("ines@example.org", PASSWORD, "Chrome")
    (session,) = [one for one in people.sessions(owner) if one.browser == "Chrome"]
    with pytest.raises(NotFoundError):
        people.end_session(bo, session.id)
    people.end_session(owner, session.id)
    assert house.accounts.who(here).user == owner
    with pytest.raises(UnauthorisedError):
        house.accounts.who(there)


def test_each_role_has_the_rights_of_the_one_below(backend):
    assert RIGHTS["analyst"] < RIGHTS["experimenter"] < RIGHTS["owner"]
    require("experimenter", "work")
    with pytest.raises(ForbiddenError, match="experimenter or owner"):
        require("analyst", "work")
