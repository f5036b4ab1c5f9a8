"""A study with a head of its own: made on the page's terms, taken part in over HTTP, drawn, exported, replayed."""

from __future__ import annotations

import io

import numpy as np
import pytest
from PIL import Image
from starlette.testclient import TestClient

from emogen_core.face.appearance import Appearance
from emogen_core.face.space_file import load_bundled_space
from server.app import create_app
from server.services.config import parse_config
from server.services.opening import open_house
from server.settings import Settings
from tests.browser.stage import drawing
from tests.server.exported import lines
from tests.server.walker import Walker

HEAD = {
    "format": "emogen-identity",
    "version": 1,
    "name": "Somebody",
    "head": {"sex": 1, "age": 58, "ancestry": {"asian": 0.5, "caucasian": 0.5}, "details": {"nose-width": 0.6}},
    "appearance": Appearance(skin_depth=0.6, grey=0.8).to_document(),
}
STUDY = {
    "title": "One head of our own",
    "emotions": [{"adjective": "angry", "noun": "anger"}],
    "identities": [HEAD],
    "generations": 2,
    "practice": None,
    "portrait": {"width": 120},
}


@pytest.fixture(scope="module")
def settings(tmp_path_factory):
    return Settings(
        data_dir=tmp_path_factory.mktemp("custom"), renderer=drawing(), render_workers=1, base_url="http://testserver"
    )


@pytest.fixture(scope="module")
def made(settings):
    """The study, taken part in once, and the portrait of its first face."""
    house = open_house(settings)
    with TestClient(create_app(house), follow_redirects=False) as client:
        study = house.studies.create(parse_config(STUDY))
        walker = Walker(client, study.links[0])
        state = walker.start()
        portrait = client.get(state["trial"]["faces"][0]["portrait"])
        assert portrait.status_code == 200, portrait.text
        assert walker.finish()["step"] == "debrief"
    house.close()
    return study, state["trial"]["faces"][0]["portrait"], portrait.content


def test_the_record_names_the_head_and_the_configuration_holds_it(settings, made):
    study, _, _ = made
    house = open_house(settings, drawing=False)
    (version,) = house.exports.configurations(study.id)
    (document,) = version["config"]["identities"]
    name = f"custom-{document['hash'][:12]}"
    for table, column in (("participations", "condition"), ("trials", "identity"), ("faces", "identity")):
        rows = lines(house, study.id, table)
        assert {row[column] for row in rows} == {name}
        assert {row["config_hash"] for row in rows} == {version["config_hash"]}
    assert document["space"] == load_bundled_space().hash
    house.close()


def test_another_process_replays_it_bit_for_bit(settings, made):
    house = open_house(settings, drawing=False)
    replayed = house.replay.study(made[0].id)
    house.close()
    assert (replayed.difference, replayed.generations) == (None, 3)


def test_another_process_draws_the_same_bytes_from_the_database(settings, made):
    _, address, portrait = made
    for file in settings.data_dir.glob("portraits/*/*.png"):
        file.unlink()
    house = open_house(settings)
    with TestClient(create_app(house)) as client:
        again = client.get(address)
    house.close()
    assert again.content == portrait
    with Image.open(io.BytesIO(portrait)) as picture:
        assert picture.size == (120, 144)
        assert np.asarray(picture.convert("L")).std() > 20
