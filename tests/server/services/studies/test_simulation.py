"""Simulated participants look for faces within the study's reach, and what they did is kept when one of them fails."""

import asyncio

import httpx2
import pytest

from server.app import create_app
from server.services.errors import ConflictError
from server.services.studies import simulation
from server.services.studies.simulation import Report, Simulation, checked
from server.services.trials.evolution import params_of
from tests.conftest import small_study
from tests.rig_factory import small_rig


class Failing(httpx2.AsyncClient):
    """Refuses the answers of all but the first participant."""

    first = None

    async def post(self, url, **options):
        if url.endswith("/answers"):
            self.first = self.first or url
            if url != self.first:
                return httpx2.Response(409, text="no more")
        return await super().post(url, **options)


def send(house, study, client_type, report, count):
    token = house.tokens.create("test", ["simulate"])

    async def run():
        async with client_type(transport=httpx2.ASGITransport(create_app(house)), base_url="http://test") as client:
            await Simulation(client, study.links[0], token, 1, house.journal.rig).run(count, report)

    asyncio.run(run())


def test_what_was_done_is_kept_when_somebody_fails(house, study, monkeypatch):
    monkeypatch.setattr(simulation, "AT_ONCE", 1)
    report = Report(1, 2)
    with pytest.raises(ConflictError, match="409: no more"):
        send(house, study, Failing, report, 2)
    assert report.finished == 1
    assert report.trials
    assert {trial.participant for trial in report.trials} == {0}
    assert report.plain()["mean_final_cosine_distance"] > 0


def test_the_report_is_in_the_order_of_the_participants_whoever_is_first(house, study):
    report = Report(1, 3)
    send(house, study, httpx2.AsyncClient, report, 3)
    told = [trial["participant"] for trial in report.plain()["trials"]]
    assert told == sorted(told)
    assert set(told) == {0, 1, 2}
    assert report.finished == 3


def test_nobody_looks_for_a_face_that_the_search_cannot_reach(house, app_ready, monkeypatch):
    asked = []
    target = simulation.random_target
    monkeypatch.setattr(simulation, "random_target", lambda params, rng: asked.append(params) or target(params, rng))
    study = house.studies.create(
        small_study(search={"gaze": False, "excluded_genes": [house.journal.rig.gene_names[0]]})
    )
    house.simulations.send(study.id, 1, 3, None)
    house.simulations.settle()
    assert house.simulations.of(study.id).problem is None
    reach = params_of(house.journal.rig, house.life.config(study.id))
    assert 0 not in reach.active
    assert asked
    assert {params.active for params in asked} == {reach.active}


def test_faces_of_another_rig_are_not_judged(house, study, client):
    rig = small_rig(8, 7)

    async def run():
        transport, token = httpx2.ASGITransport(create_app(house)), house.tokens.create("test", ["simulate"])
        async with httpx2.AsyncClient(transport=transport, base_url="http://test") as far:
            await Simulation(far, study.links[0], token, 1, rig).run(1)

    told = f"of the rig {house.journal.rig.hash[:12]}: expected {rig.hash[:12]}. Name the rig file"
    with pytest.raises(ConflictError, match=told):
        asyncio.run(run())


def test_another_program_at_the_address_is_said_so():
    with pytest.raises(ConflictError, match="Expected an answer of an Emogen server, got: '<p>Hello'"):
        checked(httpx2.Response(200, text="<p>Hello"))


@pytest.fixture
def app_ready(house):
    return create_app(house)
