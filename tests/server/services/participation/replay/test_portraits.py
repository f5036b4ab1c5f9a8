"""Portraits of recorded faces are those that were shown."""

import pytest

from emogen_client import Export
from server.services.participation.replay.exported import ExportReplay
from server.services.participation.replay.portraits import AHEAD, Album
from tests.conftest import small_study
from tests.server.services.participation.replay.exports import exported
from tests.server.walker import Walker


@pytest.fixture
def people(house, client, tmp_path):
    study = house.studies.create(small_study(generations=3))
    Walker(client, study.links[0]).finish()
    folder = exported(house, study, tmp_path / "export")
    return list(ExportReplay(Export(folder), house.journal.wardrobe).participations())


@pytest.mark.parametrize("which", ["finished", "best", "all"])
def test_every_wanted_face_is_drawn_once_from_its_weights(house, people, which):
    drawn = []

    class Drawer:
        def submit(self, sketch, _priority, _head):
            drawn.append(sketch)
            return house.portraits.sketched(sketch)

    pictures = list(Album(Drawer(), house.journal.wardrobe).pictures(people, which))
    (person,) = people
    trials = [trial for trial, shown in person.trials if shown]
    generations = sum(len(shown) for _, shown in person.trials)
    assert len(pictures) == {"finished": len(trials), "best": generations, "all": 10 * generations}[which]
    assert len({name for name, _ in pictures}) == len(pictures) == len(drawn)
    assert all(name.startswith(person.participation) and name.endswith(".png") for name, _ in pictures)
    assert which != "all" or len(pictures) > AHEAD, "more than are asked for ahead"
    keys = {house.portraits.key(one.identity, one.weights, one.settings) for one in drawn}
    faces = [face for _, shown in person.trials for _, ten, _ in shown for face in ten]
    assert which != "all" or len(keys) == len({(face.identity, face.weights) for face in faces})


def test_estimates_are_drawn_where_the_search_has_some(house, client, people, tmp_path):
    study = house.studies.create(small_study(search={"strategy": "preference", "activation": (2, 3)}))
    Walker(client, study.links[0]).finish()
    export = Export(exported(house, study, tmp_path / "learned"))
    drawn = []

    class Drawer:
        def submit(self, sketch, _priority, _head):
            drawn.append(house.portraits.key(sketch.identity, sketch.weights, sketch.settings))
            return house.portraits.sketched(sketch)

    album = Album(Drawer(), house.journal.wardrobe)
    assert list(album.pictures(people, "estimates")) == []
    names = [
        name for name, _ in album.pictures(ExportReplay(export, house.journal.wardrobe).participations(), "estimates")
    ]
    rows = export.arrow("estimates").to_pylist()
    assert drawn == [row["portrait_key"] for row in rows]
    assert names == [f"{rows[0]['participation']}/{position:02d}-estimate.png" for position in range(3)]
