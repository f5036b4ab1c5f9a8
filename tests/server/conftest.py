"""A house with a day of people in it, made once; each test has a copy, and its clock stands at the end of the day."""

import os
import re
import shutil
import time
from datetime import UTC, datetime

import pytest
from starlette.testclient import TestClient

from server.app import create_app
from server.services.clock import told_by
from server.services.house import build_house
from server.settings import Settings
from tests.browser.populated import populate, study_for
from tests.conftest import FakeDrawer, FakeTailor
from tests.rig_factory import small_rig
from tests.server.analysis.recorded import export

END = datetime(2026, 3, 22, 14, 7, 31, tzinfo=UTC)
PEOPLE = 36


def opened(folder):
    rig = small_rig()
    return build_house(Settings(data_dir=folder, base_url="http://testserver"), rig, FakeDrawer(rig), FakeTailor(rig))


@pytest.fixture(scope="session")
def day_folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("day")
    house = opened(folder)
    made = populate(house, END, people=PEOPLE, config=study_for(house.journal.rig, generations=1), events=False)
    house.close()
    return folder, made


@pytest.fixture
def utc():
    """Pages say times of day in the zone of the machine: here it is UTC everywhere."""
    before = os.environ.get("TZ")
    os.environ["TZ"] = "UTC"
    time.tzset()
    yield
    if before is None:
        del os.environ["TZ"]
    else:
        os.environ["TZ"] = before
    time.tzset()


@pytest.fixture
def day(day_folder):
    return day_folder[1]


@pytest.fixture
def full(day_folder, tmp_path, utc):
    """The house of that day."""
    shutil.copytree(day_folder[0], tmp_path / "day")
    made = opened(tmp_path / "day")
    with told_by(lambda: END):
        yield made
    made.close()


@pytest.fixture
def full_client(full):
    with TestClient(create_app(full), follow_redirects=False) as made:
        yield made


@pytest.fixture
def full_owner(full, full_client):
    return _owner(full, full_client)


@pytest.fixture
def house_owner(house, client):
    return _owner(house, client)


def _owner(house, client):
    page = client.get("/admin/setup")
    form = {"key": house.accounts.new_setup_key(), "name": "Ines Marchetti", "email": "i@example.org"}
    secrets = {
        "csrf": re.search(r'name="csrf" value="([^"]+)"', page.text)[1],
        "password": "four unrelated quiet words",
    }
    assert client.post("/admin/setup", data={**form, **secrets}).status_code == 303
    return client


@pytest.fixture(scope="session")
def analysed(tmp_path_factory):
    """A folder with an export of simulated people as `csv` and `jsonl`."""
    data = tmp_path_factory.mktemp("analysed")
    export(data)
    return data
