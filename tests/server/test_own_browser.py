"""A recruiter's id leads back to a participation from anywhere, but only its own browser can erase it."""

import pytest
from starlette.testclient import TestClient

from server.app import create_app
from tests.conftest import BOTH, small_study
from tests.server.walker import Walker

ERASE = 'name="erase" value="true"'


@pytest.fixture
def stranger(house):
    with TestClient(create_app(house), follow_redirects=False) as made:
        yield made


def erased(client, address, form=False):
    if form:
        client.post(f"{address}/stop/form", data={"erase": "true"})
    else:
        client.post(f"{address}/stop", json={"erase": True})
    return client.get(f"{address}/state").json().get("completion", {}).get("outcome") == "erased"


@BOTH
@pytest.mark.parametrize("form", [False, True])
def test_who_knows_the_id_goes_on_but_erases_nothing(client, stranger, study, form):
    own = Walker(client, study.links[0], PROLIFIC_PID="5f3c")
    own.start()
    other = Walker(stranger, study.links[0], PROLIFIC_PID="5f3c")
    assert other.address == own.address
    assert other.state()["step"] == "practice"
    assert [ERASE in one.get(own.address).text for one in (client, stranger)] == [True, False]
    assert not erased(stranger, own.address, form)
    refused = stranger.post(f"{own.address}/stop", json={"erase": True})
    assert (refused.status_code, refused.json()["error"]["code"]) == (403, "forbidden")
    assert erased(client, own.address, form)


def test_the_proof_is_of_one_participation_and_is_shown_to_it_alone(client, study):
    Walker(client, study.links[0], PROLIFIC_PID="a")
    (cookie,) = (one for one in client.cookies.jar if one.name == "emogen_own")
    assert cookie.path.startswith("/p/")
    assert cookie.has_nonstandard_attr("HttpOnly")
    client.cookies.clear()
    other = Walker(client, study.links[0], PROLIFIC_PID="b")
    other.start()
    client.cookies.clear()
    client.cookies.set("emogen_own", cookie.value)
    assert not erased(client, other.address)


def test_a_first_reply_that_was_lost_costs_no_proof(client, study):
    Walker(client, study.links[0], PROLIFIC_PID="a")
    client.cookies.clear()
    again = Walker(client, study.links[0], PROLIFIC_PID="a")
    again.start()
    assert erased(client, again.address)


def test_an_address_that_is_a_secret_itself_needs_no_proof(client, stranger, house, study):
    walker = Walker(client, study.links[0])
    walker.start()
    assert ERASE in stranger.get(walker.address).text
    assert erased(stranger, walker.address)
    unnamed = house.studies.create(small_study(recruiter_parameters=()))
    walker = Walker(client, unnamed.links[0], PROLIFIC_PID="a")
    assert erased(stranger, walker.address)
    assert "emogen_own" not in client.cookies
