"""A study on a server that is reached through the real routes."""

import httpx2
import pytest

from emogen_client import Study
from tests.conftest import small_study
from tests.server.walker import Walker

ADDRESS = "http://testserver"


@pytest.fixture
def made(house, client):
    study = house.studies.create(small_study())
    walkers = [Walker(client, study.links[0]) for _ in range(3)]
    walkers[0].finish()
    walkers[1].finish(steps=4)
    return study.id, walkers


@pytest.fixture
def token(house):
    return house.tokens.create("analysis", ["export"])


@pytest.fixture
def study(made, client, token):
    return Study(ADDRESS, made[0], token, client=client)


@pytest.fixture
def cut(made, client, token):
    """The same study behind something that loses the last byte of every download, and says nothing of it."""

    def handle(request):
        reply = client.request(request.method, str(request.url), headers=request.headers)
        headers = {name: value for name, value in reply.headers.items() if name.startswith("emogen-")}
        whole = "/export" not in request.url.path and "/package" not in request.url.path
        return httpx2.Response(
            reply.status_code, content=reply.content if whole else reply.content[:-1], headers=headers
        )

    with httpx2.Client(transport=httpx2.MockTransport(handle)) as sending:
        yield Study(ADDRESS, made[0], token, client=sending)
