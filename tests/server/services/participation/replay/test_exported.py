"""An export replays from its own files, and every tampering with it is found, also where the manifest was mended."""

import json
import re

import pytest

from emogen_client import IncompleteError
from server.services.errors import InvalidError, NotFoundError
from server.services.reports.tables.package import write_folder
from server.services.reports.tables.selection import Filters
from server.services.reports.tables.sound_export import SoundExport
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
THERE_TOO = on(simulated=False)
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
        (("trials", changed(on(practice=False), position=7)), ("position", None)),
        (("trials", changed(on(practice=False), kind="rate")), ("kind", None)),
        (("trials", changed(on(practice=False), identity="male")), ("identity", None)),
        (("trials", changed(lambda row: row["final_face"], attempts=1)), ("attempts", None)),
        (("trials", changed(lambda row: row["final_face"], generations=2)), ("generations", None)),
        (("trials", changed(lambda row: row["final_face"], final_face=None)), ("final_face", None)),
        (("faces", changed(LATE, identity="male")), ("identity", 5)),
        (("participations", changed(THERE, order_row=1)), ("trial_order", None)),
        (("participations", changed(THERE, order_row=None, trial_order=["happy", "happy"])), ("trial_order", None)),
        (("participations", changed(THERE, trial_order=["happy", "happy"])), ("trial_order", None)),
        (("participations", changed(THERE, head="")), ("head", None)),
        (
            ("participations", changed(on(outcome=None, erased_at=None), outcome="complete")),
            ("positions", None),
        ),
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


def test_a_trial_that_is_told_as_another_emotion_everywhere_is_found(house, study, tmp_path):
    folder = exported(house, study, tmp_path / "whole")
    trial = next(row for row in map(json.loads, lines(folder, "trials")) if row["final_face"] and not row["practice"])

    def rename(rows):
        for row in rows:
            if row["trial"] == trial["trial"]:
                row["emotion"] = "jealous"

    for table in ("trials", "generations", "faces", "choices", "events", "ratings"):
        folder = tampered(folder, table, rename)
    difference = replayed(house, folder).difference
    assert (difference.trial, difference.what) == (trial["trial"], "emotion")
    assert (difference.expected, difference.got) == (trial["emotion"], "jealous")


CONTRADICTIONS = [
    ("choices", lambda rows: rows.append(rows[-1]), "choices: expected every row once, got trial"),
    ("faces", lambda rows: rows.append({**rows[0], "slot": 2}), "faces: expected every row once, got face"),
    (
        "generations", lambda rows: rows.append({**rows[0], "generation_id": "new"}),
        "generations: expected every row once, got trial",
    ),
    ("participations", lambda rows: rows.append(rows[0]), "participations: expected every row once"),
    ("choices", changed(on(practice=True), practice=False), "expected practice True as in trials, for trial"),
    ("faces", changed(on(emotion="angry"), emotion="sad"), "expected emotion angry as in trials, for trial"),
    ("trials", changed(THERE_TOO, pilot=True), "expected pilot False as in participations, for participation"),
    ("choices", changed(THERE_TOO, trial="none"), "rows of the trials in trials, got one of none"),
    ("ratings", changed(THERE_TOO, value=99), "ratings: expected value 1 to 7, got 99"),
    ("faces", changed(LATE, gene_g1=1.5), "faces: expected gene_g1 0 to 1, got 1.5"),
    (
        "participations", changed(on(outcome="complete"), erased_at="2026-01-01T00:00:00.000Z"),
        "expected rows of the participations in participations, got one of",
    ),
]  # fmt: skip


def test_an_export_that_contradicts_itself_is_refused(house, study, tmp_path):
    folder = exported(house, study, tmp_path / "whole")
    for table, change, message in CONTRADICTIONS:
        export = SoundExport(tampered(folder, table, change))
        with pytest.raises(InvalidError, match=f"contradicts itself.*{re.escape(message)}"):
            for name in export.tables:
                export.arrow(name)
    whole = SoundExport(folder)
    assert all(whole.arrow(name).num_columns for name in whole.tables)


def test_the_end_of_a_trial_that_is_cut_off_is_found(house, study, tmp_path):
    folder = exported(house, study, tmp_path / "whole")
    trial = next(row for row in map(json.loads, lines(folder, "trials")) if row["final_face"] and not row["practice"])

    def cut(rows):
        rows[:] = [row for row in rows if row["trial"] != trial["trial"] or row["generation"] < trial["generations"]]

    def shorten(rows):
        row = next(row for row in rows if row["trial"] == trial["trial"])
        row.update(generations=row["generations"] - 1, final_face=None)

    for table in ("generations", "faces", "choices", "events"):
        folder = tampered(folder, table, cut)
    difference = replayed(house, tampered(folder, "trials", shorten)).difference
    assert (difference.trial, difference.what) == (trial["trial"], "final_face")
    assert difference.expected == "one, since the participation is complete"


def test_a_trial_of_a_complete_participation_that_was_left_out_is_found(house, study, tmp_path):
    folder = exported(house, study, tmp_path / "whole")
    rows = [json.loads(line) for line in lines(folder, "trials")]
    whole = next(row["participation"] for row in map(json.loads, lines(folder, "participations")) if row["outcome"])
    last = max((row for row in rows if row["participation"] == whole), key=lambda row: row["position"])

    def leave_out(rows):
        rows[:] = [row for row in rows if row["trial"] != last["trial"]]

    for table in ("trials", "generations", "faces", "choices", "events", "ratings"):
        folder = tampered(folder, table, leave_out)
    difference = replayed(house, folder).difference
    assert (difference.participation, difference.what) == (whole, "positions")
    assert difference.expected == "0, 1, 2"
    assert difference.got == "0, 1"


def test_an_export_of_one_emotion_replays_as_far_as_it_goes(house, study, tmp_path):
    folder = tmp_path / "one"
    folder.mkdir()
    package = house.exports.package(study.id, "jsonl", Filters(emotion="angry"))
    assert list(write_folder(package.entries(), folder))
    found = replayed(house, folder)
    assert found.difference is None
    assert 0 < found.generations < house.replay.study(study.id).generations


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


@pytest.fixture
def learned(house, client):
    """A study whose search weighs all answers."""
    made = house.studies.create(small_study(search={"strategy": "preference", "activation": (2, 3)}))
    Walker(client, made.links[0]).finish()
    Walker(client, made.links[0]).finish(steps=4)
    return made


@pytest.mark.parametrize(
    ("change", "what"),
    [
        (changed(on(practice=False), gene_g1=0.5), "estimate, genes"),
        (changed(on(practice=False), weight_c01=0.5), "estimate, weights"),
        (changed(on(practice=False), identity="male"), "estimate, identity"),
        (dropped(on(practice=False)), "estimate"),
    ],
)
def test_estimates_replay_and_a_changed_one_is_found(house, learned, tmp_path, change, what):
    folder = exported(house, learned, tmp_path / "whole")
    found = replayed(house, folder)
    assert (found.difference, found.generations) == (None, house.replay.study(learned.id).generations)
    trial = next(row["trial"] for row in map(json.loads, lines(folder, "estimates")) if not row["practice"])
    difference = replayed(house, tampered(folder, "estimates", change)).difference
    assert (difference.trial, difference.what) == (trial, what)
    assert difference.expected != difference.got


def test_an_export_from_before_there_were_estimates_replays(house, study, learned, tmp_path):
    def without(study):
        folder = exported(house, study, tmp_path / study.id)
        (folder / "estimates.jsonl").unlink()
        manifest = json.loads((folder / "manifest.json").read_text())
        manifest["files"] = [file for file in manifest["files"] if file.get("table") != "estimates"]
        (folder / "manifest.json").write_text(json.dumps(manifest))
        return replayed(house, folder).difference

    assert without(study) is None
    assert without(learned).what == "estimate"


def test_trials_that_ended_early_replay_and_what_is_said_of_their_end_is_checked(house, client, soon_sure, tmp_path):
    search = {"strategy": "preference", "activation": (2, 3), "stop_at": 0.5, "least_generations": 1}
    study = house.studies.create(small_study(generations=4, search=search))
    Walker(client, study.links[0]).finish()
    Walker(client, study.links[0]).finish(steps=4)
    folder = exported(house, study, tmp_path / "whole")
    found = replayed(house, folder)
    assert (found.difference, found.generations) == (None, house.replay.study(study.id).generations)
    for said, what in ((False, "last_generation"), (None, "last_generation")):
        other = tampered(folder, "trials", changed(on(practice=False), ended_early=said))
        difference = replayed(house, other).difference
        assert (difference.what, difference.expected, difference.got) == (what, "1", "none")


def test_an_export_from_before_trials_could_end_early_replays(house, learned, tmp_path):
    folder = exported(house, learned, tmp_path / "whole")

    def undone(rows):
        assert not any(row.pop("ended_early") for row in rows)

    def undocumented(told):
        told["trials"]["columns"] = [one for one in told["trials"]["columns"] if one["name"] != "ended_early"]

    before = tampered(tampered(folder, "trials", undone), "dictionary.json", undocumented)
    assert replayed(house, before).difference is None
