"""What is looked at before people are let in."""

import pytest

from server.services.errors import NotFoundError
from tests.conftest import BOTH, small_study
from tests.server.walker import Walker

SAID = {"contact": "a@example.org", "contact_name": "Dr A", "ethics": "Board 7", "purpose": "Faces.", "minutes": 9}


def open_points(house, study, status="recruiting"):
    return {check.name for check in house.starting.outlook(study, status).checks if not check.good}


def test_every_gap_is_named_and_nothing_else(house):
    bare = house.studies.create(small_study(), "draft").id
    assert open_points(house, bare) == {
        "Contact", "Ethics approval", "Purpose", "Time it takes", "Participants wanted", "Way back to the recruiter",
        "Tried out",
    }  # fmt: skip
    whole = small_study(texts=SAID, quota=20, completion={"codes": {"complete": "C0FFEE"}})
    made = house.studies.create(whole, "pilot")
    assert open_points(house, made.id) == {"Tried out"}
    spoken = small_study(texts=SAID, quota=20, translations={"de": {"title": "Gesichter"}}, recruiter_parameters=())
    assert open_points(house, house.studies.create(spoken, "draft").id) == {"Language de", "Tried out"}


def test_a_place_on_this_computer_only_and_a_study_without_links(house, study):
    house.life.close_link(study.id, study.links[0], None)
    assert "Links" in open_points(house, study.id)
    local = type(house.starting)(house.database, "http://localhost:8000")
    assert any(check.name == "Address" and not check.good for check in local.outlook(study.id, "recruiting").checks)


@BOTH
def test_who_is_in_it_and_who_has_tried_it(client, house, study):
    pilot = house.studies.create(small_study(recruiter_parameters=()), "pilot")
    Walker(client, pilot.links[0]).finish()
    client.cookies.clear()
    Walker(client, pilot.links[0]).start()
    outlook = house.starting.outlook(pilot.id, "recruiting")
    assert (outlook.here, "Tried out" in open_points(house, pilot.id)) == (1, False)
    assert house.starting.outlook(pilot.id, "closed").checks == ()
    with pytest.raises(NotFoundError):
        house.starting.outlook("nothing", "closed")
