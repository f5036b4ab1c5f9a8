"""A study with one whole participation, one that stopped, and one that is erased."""

import pytest

from tests.conftest import small_study
from tests.server.walker import Walker


@pytest.fixture
def people(house, client):
    study = house.studies.create(small_study())
    made = [Walker(client, study.links[0], PROLIFIC_PID=f"p{number}") for number in range(3)]
    made[0].finish()
    made[1].finish(steps=4)
    made[2].finish(steps=5)
    client.post(f"{made[2].address}/stop", json={"erase": True})
    return study, made
