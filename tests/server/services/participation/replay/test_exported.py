"""An export replays from its own files, and every tampering with it is found, also where the manifest was mended."""

import json

import pytest

from emogen_client import IncompleteError
from server.services.errors import InvalidError, NotFoundError
from tests.conftest import BOTH, small_study
from tests.server.services.participation.replay.exports import exported, replayed, tampered
from tests.server.walker import Walker

WHOLE, BEGUN_TWICE = 1 + 2 * 4, 1 + 2 + 2


@pytest.fixture
def study(house, client):
    made = house.studies.create(small_study(generations=3))
    Walker(client, made.links[0]).finish()
    walker = Walker(client, made.links[0])
    state = walker.finish(steps=4)
    walker.post(walker.body(state, kind="reset"))
    walker.finish(steps=1)
    erased = Walker(client, made.links[0])
    erased.finish(steps=4)
    client.post(f"{erased.address}/stop", json={"erase": True})
    return made


@BOTH
def test_everything_that_is_left_replays_from_every_format(house, study, tmp_path):
    counts = set()
    for form in ("csv", "jsonl", "parquet", "psych-ds"):
        found = replayed(house, exported(house, study, tmp_path / form, form))
        assert found.difference is None, form
        counts.add(found.generations)
    assert counts == {house.replay.study(study.id).generations}
    assert counts.pop() > WHOLE


def on(**wanted):
    """Return which rows have these values."""
    return lambda row: all(row[name] == value for name, value in wanted.items())


def changed(where, **values):
    """Change the first row that fits."""

    def change(rows):
        next(row for row in rows if where(row)).update(values)

    return change


def dropped(where):
    def change(rows):
        rows.remove(next(row for row in rows if where(row)))

    return change


def swapped_best(rows):
    """Another of the chosen faces becomes the best one."""
    row = next(row for row in rows if len(row["selected"]) > 1)
    row["elite"] = next(one for one in row["selected"] if one != row["elite"])


THERE = on(erased_at=None)
LATE = on(practice=False, generation=2, slot=5)


@pytest.mark.parametrize(
    ("tampering", "found"),
    [
        (("faces", changed(LATE, gene_g1=0.5)), ("genes", 5)),
        (("faces", changed(LATE, weight_c01=0.5)), ("weights", 5)),
        (("faces", changed(LATE, origin="invented")), ("origin", 5)),
        (("faces", changed(LATE, parents=[1, 1, 1])), ("parents", 5)),
        (("faces", changed(lambda row: row["elite"] is False, elite=True)), ("marks", None)),
        (("faces", dropped(LATE)), ("generation", None)),
        (("generations", dropped(on(practice=False, generation=1))), ("generation", None)),
        (("choices", swapped_best), ("marks", None)),
        (("choices", changed(on(practice=False), elite="nobody")), ("marks", None)),
        (("trials", changed(on(practice=False), seed="12345")), ("seed", None)),
        (("trials", changed(lambda row: row["final_face"], final_face="another")), ("final_face", None)),
        (("participations", changed(THERE, seed="99")), ("seed", None)),
        (
            ("participations", changed(lambda row: row["erased_at"] is None, config_hash="0" * 64)),
            ("config_hash", None),
        ),
    ],
)
def test_tampering_is_found(house, study, tmp_path, tampering, found):
    folder = exported(house, study, tmp_path / "whole")
    difference = replayed(house, tampered(folder, *tampering)).difference
    assert difference.what == found[0]
    assert difference.expected != difference.got
    assert found[1] is None or difference.slot == found[1]


def test_a_choice_that_was_changed_with_its_marks_breaks_what_followed_from_it(house, study, tmp_path):
    folder = exported(house, study, tmp_path / "whole")
    trial = next(row["trial"] for row in map(json.loads, lines(folder, "choices")) if not row["practice"])
    here = on(trial=trial, attempt=0, generation=0)
    chosen = {}

    def choose(rows):
        row = next(row for row in rows if here(row))
        chosen.update(old=row["elite"], new=next(one for one in row["selected"] if one != row["elite"]))
        row["elite"] = chosen["new"]

    def mark(rows):
        for row in rows:
            if here(row):
                row["elite"] = row["face"] == chosen["new"]

    other = tampered(tampered(folder, "choices", choose), "faces", mark)
    difference = replayed(house, other).difference
    assert (difference.trial, difference.generation) == (trial, 1)


def lines(folder, table):
    (path,) = (path for path in folder.rglob("*.jsonl") if table in path.name)
    return path.read_text().splitlines()


def test_a_changed_configuration_is_found(house, study, tmp_path):
    folder = exported(house, study, tmp_path / "whole")

    def change(versions):
        versions[0]["config"]["search"]["mutations"] = 3

    assert replayed(house, tampered(folder, "configurations.json", change)).difference.what == "configuration"

    def spoil(versions):
        versions[0]["config"]["generations"] = -1

    with pytest.raises(InvalidError, match="generations"):
        replayed(house, tampered(folder, "configurations.json", spoil))


def test_a_file_that_is_not_the_one_of_the_manifest_is_refused(house, study, tmp_path):
    folder = exported(house, study, tmp_path / "whole")
    (path,) = (path for path in folder.rglob("*.jsonl") if "faces" in path.name)
    path.write_bytes(path.read_bytes()[:-2])
    with pytest.raises(IncompleteError, match="SHA-256"):
        replayed(house, folder)


def test_another_face_model_is_told(house, study, tmp_path):
    folder = exported(house, study, tmp_path / "whole")
    other = tampered(folder, "participations", changed(THERE, rig_hash="1" * 64))
    with pytest.raises(NotFoundError, match="another face model"):
        replayed(house, other)
