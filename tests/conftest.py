"""A house with a small rig and a drawer that draws nothing, for every test of the server."""

from __future__ import annotations

import base64
import threading
from concurrent.futures import Future

import hypothesis
import numpy as np
import pytest
from starlette.testclient import TestClient

from emogen_core.face.space_file import load_bundled_space
from emogen_core.rendering.keys import portrait_key
from emogen_core.rendering.worn import WornHead
from emogen_core.rigs.wear import worn_name
from server.app import create_app
from server.services.config import Emotion, StudyConfig
from server.services.house import build_house
from server.services.participation import seating
from server.settings import Settings
from tests.rig_factory import small_rig
from tests.server.postgres import fresh, running

# A test must not fail because the machine is busy.
hypothesis.settings.register_profile("untimed", deadline=None)
hypothesis.settings.load_profile("untimed")

PIXEL = base64.b64decode("iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAAAAAA6fptVAAAACklEQVR4nGM4CQAAywDKWvQYfgAAAABJRU5ErkJggg==")


class FakeDrawer:
    """Answers every face with one grey pixel; counts, and can be held."""

    def __init__(self, rig):
        self.rig = rig
        self.drawn = []
        self.heads = {}
        self.hold = False
        self.waiting = []
        self.lock = threading.Lock()

    def key(self, identity, weights, settings):
        return portrait_key(self.rig.hash, "no look", "fake", identity, weights, settings)

    def submit(self, sketch, priority, head=None):
        future = Future()
        with self.lock:
            self.heads[sketch.identity] = head
            self.drawn.append((self.key(sketch.identity, sketch.weights, sketch.settings), priority))
            self.waiting.append(future)
        if not self.hold:
            self.release()
        return future

    def release(self):
        with self.lock:
            ready, self.waiting = self.waiting, []
        for future in ready:
            if future.set_running_or_notify_cancel():
                future.set_result(PIXEL)

    def close(self):
        pass


class FakeTailor:
    """Fits every head to the small rig in no time; counts, and can be held."""

    def __init__(self, rig):
        self.rig = rig
        self.space = load_bundled_space()
        self.millimetres = 2.0
        """How far its heads lie from the rig's own: processors differ a little in that."""
        self.fitted = []
        self.gate = threading.Event()
        self.gate.set()

    def fit(self, identity, *, moving=True):
        self.fitted.append((identity.name, moving))
        assert self.gate.wait(10)
        name = worn_name(identity, self.space) + ("" if moving else "-still")
        return WornHead(
            name, self.rig.neutrals["female"] + np.float32(self.millimetres), None, identity.appearance, "female"
        )


def small_study(**changes):
    plain = {
        "title": "Small study",
        "emotions": (Emotion(adjective="happy", noun="happiness"), Emotion(adjective="angry", noun="anger")),
        "identities": ("female",),
        "generations": 2,
        "search": {"activation": (2, 3), "random_genes": 3},
        "recruiter_parameters": ("PROLIFIC_PID",),
    }
    return StudyConfig.model_validate({**plain, **changes})


@pytest.fixture
def rig():
    return small_rig()


@pytest.fixture
def soon_sure(monkeypatch):
    """Whoever joins gets a seed with which a search that learns is soon sure, whatever the face.

    With it, and a walker who always takes the first two faces, the expected error after one choice is .33 and .13, and
    .05 after two; limits of tests are .5.
    """
    monkeypatch.setattr(seating, "new_seed", lambda: "34")


BOTH = pytest.mark.parametrize("backend", ["sqlite", "postgresql"])


@pytest.fixture(scope="session")
def postgres():
    with running() as place:
        yield place


@pytest.fixture
def backend():
    """Where the tests of a house keep their data; `BOTH` runs a test on each."""
    return "sqlite"


@pytest.fixture
def database_url(backend, request):
    return fresh(request.getfixturevalue("postgres")) if backend == "postgresql" else ""


@pytest.fixture
def settings(tmp_path, database_url):
    return Settings(data_dir=tmp_path / "var", base_url="http://testserver", database_url=database_url)


@pytest.fixture
def drawer(rig):
    return FakeDrawer(rig)


@pytest.fixture
def tailor(rig):
    return FakeTailor(rig)


@pytest.fixture
def house(settings, rig, drawer, tailor):
    made = build_house(settings, rig, drawer, tailor)
    yield made
    made.close()


@pytest.fixture
def study(house):
    return house.studies.create(small_study())


@pytest.fixture
def client(house):
    with TestClient(create_app(house), follow_redirects=False) as made:
        yield made
