"""Two requests at once on PostgreSQL, where writes do not queue: what one of them holds, the other waits for."""

import pytest
from starlette.testclient import TestClient

from server.app import create_app
from server.services.clock import now
from server.services.errors import ConflictError, UnauthorisedError
from server.services.participation.arrival import Browser, Joined
from server.services.participation.previews import KEPT
from server.services.studies.studies import DEMO_ID
from server.services.trials.answer_bodies import ANSWER
from server.store import keys, roster, runs
from server.store.admin_tables import Throttle
from server.store.studies_tables import RigRecord
from tests.conftest import small_study
from tests.server.racing import race
from tests.server.walker import Walker

pytestmark = pytest.mark.parametrize("backend", ["postgresql"])
PASSWORD = "correct horse battery"


@pytest.fixture
def owners(house):
    house.accounts.set_up(house.accounts.new_setup_key(), "Ines", "ines@example.org", PASSWORD)
    (first,) = house.people.all()
    house.people.accept(house.people.invite("bo@example.org", "owner", first.id), "Bo", PASSWORD)
    return [one.id for one in house.people.all()]


@pytest.mark.parametrize("leave", ["change_role", "disable"])
def test_two_last_owners_cannot_both_go(house, owners, leave):
    def going(one):
        if leave == "disable":
            return lambda: house.people.disable(one, one)
        return lambda: house.people.change_role(one, "analyst", one)

    first, second = race(house.database, going(owners[0]), going(owners[1]))
    assert first is None
    assert isinstance(second, ConflictError)
    assert [one.id for one in house.people.all() if one.role == "owner" and not one.disabled] == [owners[1]]


def test_two_who_join_at_once_get_two_numbers_and_two_cells(house):
    study = house.studies.create(small_study(identities=("female", "male"), quota=2))
    joined = race(house.database, *[lambda: house.joining.join(study.links[0])] * 2)
    assert all(isinstance(one, Joined) for one in joined), joined
    with house.database.read() as tx:
        rows = [runs.participation(tx, one.participation) for one in joined]
        assert [row.number for row in rows] == [0, 1]
        assert sorted(row.head for row in rows) == ["female", "male"]
        assert tx.query(RigRecord).count() == 1


def test_one_button_pressed_twice_takes_one_place(house, study):
    place = house.joining.entry(study.links[0]).place
    first, second = race(
        house.database, *[lambda: house.joining.join(study.links[0], browser=Browser(place=place))] * 2
    )
    assert first == second
    with house.database.read() as tx:
        assert runs.joined(tx, study.id) == 1


def test_two_studies_register_one_rig(house):
    links = [house.studies.create(small_study()).links[0] for _ in range(2)]
    joined = race(house.database, *[lambda link=link: house.joining.join(link) for link in links])
    assert all(isinstance(one, Joined) for one in joined), joined
    with house.database.read() as tx:
        assert tx.query(RigRecord).count() == 1


def test_two_processes_that_start_make_one_demonstration(house):
    first, second = race(house.database, house.studies.ensure_one, house.studies.ensure_one)
    assert (first.id, second) == (DEMO_ID, None)
    assert [one.id for one in house.studies.all()] == [DEMO_ID]


def test_two_who_ask_for_a_demonstration_get_one_each(house):
    made = race(house.database, house.studies.demo, house.studies.demo)
    assert [one.id == DEMO_ID for one in made] == [True, False]


def test_two_wrong_passwords_at_once_count_twice(house):
    tried = race(house.database, *[lambda: house.accounts.sign_in("ines@example.org", "wrong")] * 2)
    assert [type(one) for one in tried] == [UnauthorisedError] * 2
    with house.database.read() as tx:
        assert [row.failures for row in tx.query(Throttle)] == [2]


def test_two_processes_agree_on_a_secret(house):
    def asked(value):
        def ask():
            with house.database.write() as tx:
                return keys.shared(tx, "test", value, now())

        return ask

    assert race(house.database, asked("one"), asked("other")) == ("one", "one")


def test_a_preview_that_is_being_answered_is_not_swept_from_under_its_page(house, study):
    joined = house.previews.begin(study.id, "u1")
    with house.database.write() as tx:
        runs.participation(tx, joined.participation).arrived_at -= 2 * KEPT
    consent = ANSWER.validate_python({"kind": "consent", "given": True, "id": "0" * 32})
    answered, swept = race(house.database, lambda: house.answers.take(joined.token, consent), house.previews.sweep)
    assert (answered["step"], swept) == ("instructions", 0)
    assert house.previews.sweep() == 1


def test_the_last_preview_of_a_rig_goes_while_somebody_joins_with_it(house, study):
    preview = house.previews.begin(study.id, "u1")
    _, joined = race(
        house.database, lambda: house.previews.end(preview.token), lambda: house.joining.join(study.links[0])
    )
    assert isinstance(joined, Joined)


@pytest.mark.parametrize("withdraws_first", [True, False])
def test_withdrawal_and_an_answer_at_once_leave_a_tombstone(house, study, withdraws_first):
    with TestClient(create_app(house)) as client:
        walker = Walker(client, study.links[0])
        body = ANSWER.validate_python(walker.body(walker.start()))
    token = walker.address.rsplit("/", 1)[1]

    def withdraw():
        return house.withdrawals.erase(study.id, 0, None)

    def answer():
        return house.answers.take(token, body)

    both = (withdraw, answer) if withdraws_first else (answer, withdraw)
    outcomes = race(house.database, *both)
    assert sum(isinstance(one, Exception) for one in outcomes) == int(withdraws_first), outcomes
    with house.database.read() as tx:
        row, _ = roster.person(tx, study.id, 0)
        assert (row.outcome, row.step, row.recruiter, row.device) == ("erased", "ended", {}, {})
        assert roster.number_of_answers(tx, row.id) == 0
        assert not runs.trials(tx, row.id)
