"""Results: what is counted, what is left out, and what is not told from few."""

import threading
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

from emogen_core.similarity.cosine import cosine_distance
from server.services.errors import InvalidError, NotFoundError
from server.services.faces.sketch import unpack_genes, unpack_weights
from server.services.reports.results.data import Filters
from server.services.reports.results.results import StudyResults
from server.store.runs_tables import Face, Participation, Trial
from tests.conftest import BOTH, PIXEL, small_study
from tests.server.walker import Walker, respond

CONDITIONS = [{"name": "one"}, {"name": "two", "changes": {"maximum": 3}}]
CHECK = {"kind": "attention", "name": "check", "text": "Choose red.", "options": ["red", "blue"], "right": "red"}
READ = {"kind": "categorise", "name": "read", "faces": {"sources": ["own"]}}
BLOCKS = [{"kind": "evolve", "name": "first"}, CHECK, READ, {"kind": "evolve", "name": "again", "retest_of": "first"}]


def finish(client, study, *, right=True, count=2):
    walker = Walker(client, study.links[0])
    while (state := walker.state())["step"] not in {"debrief", "ended"}:
        if state["step"] == "attention":
            name = state["item"]["questions"][0]["name"]
            walker.answer(**respond(state["item"], **{name: "red" if right else "blue"}))
        else:
            walker.step(state, count)
    return walker


def people(client, study, number):
    return [finish(client, study, count=1 + index % 3) for index in range(number)]


@pytest.fixture
def study(house):
    return house.studies.create(small_study(conditions=CONDITIONS))


def told(house, study, **filters):
    return house.results.of(study.id, Filters(**filters))


def finished(house, study, emotion, condition=None):
    with house.database.read() as tx:
        query = (
            tx.query(Face)
            .join(Trial, Trial.final_face_id == Face.id)
            .join(Participation, Participation.id == Trial.participation_id)
        )
        query = query.filter(Participation.study_id == study.id, Trial.emotion == emotion)
        return query.filter(Participation.condition == condition).all() if condition else query.all()


def test_an_empty_study_has_results(house, study):
    found = told(house, study)
    assert (found.numbers.participants, found.numbers.faces, found.numbers.versions) == (0, 0, None)
    assert (found.numbers.cells, found.numbers.plane, found.numbers.curves) == ((), None, ())


@BOTH
def test_mean_faces_are_means_of_the_controls_then_corrected(house, client, study):
    people(client, study, 12)
    numbers = told(house, study).numbers
    assert (numbers.participants, numbers.faces, numbers.versions) == (12, 24, (1, 1))
    assert numbers.conditions == (("one", 6), ("two", 6))
    assert [emotion for emotion, _ in numbers.emotions] == ["happy", "angry"]
    faces = finished(house, study, "happy", "two")
    mean = np.mean([unpack_genes(face.genes) for face in faces], axis=0)
    (expected,) = house.journal.correction.faces("female", [mean])
    cell = numbers.cell("happy", "two")
    assert (cell.faces, cell.people) == (6, 6)
    assert (cell.weights == expected.weights).all()
    apart = cosine_distance(np.array([unpack_weights(face.weights) for face in faces]), expected.weights)
    assert cell.spread == pytest.approx(apart.mean())
    assert cell.rated.mean == 4
    assert numbers.cell("happy", "").faces == 12
    assert house.results.face(study.id, Filters(), "happy", "two").result() == PIXEL
    with pytest.raises(NotFoundError):
        house.results.face(study.id, Filters(), "happy", "three")


def test_lines_curves_and_the_map(house, client, study):
    people(client, study, 10)
    told(house, study)
    house.noise.settle()
    found = told(house, study)
    line = found.numbers.lines[0]
    assert line.faces == 10
    assert 0 <= line.settled <= 1
    assert line.median >= 0
    assert line.difference.between == ("one", "two")
    groups = [
        [unpack_weights(face.weights) for face in finished(house, study, "happy", name)] for name in ("one", "two")
    ]
    means = [np.mean(group, axis=0) for group in groups]
    assert line.difference.apart == pytest.approx(cosine_distance(*means))
    assert 0 < line.difference.p <= line.difference.q <= 1
    curve = found.numbers.curves[0]
    assert [point[0] for point in curve.points] == [0, 1], "the last generation is the finished face"
    assert all(low <= mean <= high for _, mean, low, high in curve.points)
    assert 0 < found.numbers.plane <= 1
    assert {name: len(places) for name, places in found.numbers.places.items()} == {"happy": 10, "angry": 10}
    total = np.sum([np.array(middle) * 10 for middle in found.numbers.middles.values()], axis=0)
    assert total == pytest.approx([0, 0], abs=1e-9), "the map is centred"


def test_few_faces_tell_no_intervals(house, client, study):
    people(client, study, 2)
    numbers = told(house, study).numbers
    assert numbers.cell("happy", "one").weights is not None
    assert numbers.cell("happy", "one").spread is None
    line = numbers.lines[0]
    assert (line.strength.mean, line.strength.low) == (4, None)
    assert (line.settled, line.median, numbers.plane) == (None, None, None)
    assert line.difference is None or line.difference.p is None
    assert all(low is None for curve in numbers.curves for _, _, low, _ in curve.points)


@BOTH
def test_programs_and_pilots_count_only_when_asked_for(house, client, study):
    people(client, study, 3)
    with house.database.write() as tx:
        tx.query(Participation).filter_by(number=1).one().simulated = True
        tx.query(Participation).filter_by(number=2).one().pilot = True
    counted = {who: told(house, study, who=who) for who in ("people", "pilot", "simulated", "all")}
    assert {who: one.numbers.participants for who, one in counted.items()} == {
        "people": 1, "pilot": 1, "simulated": 1, "all": 3,
    }  # fmt: skip
    assert counted["people"].options.others == 2


@BOTH
def test_who_is_not_complete_erased_or_previewing_is_not_counted(house, client, study):
    people(client, study, 3)
    Walker(client, study.links[0]).finish(steps=9)
    house.withdrawals.erase(study.id, 0, None)
    with house.database.write() as tx:
        tx.query(Participation).filter_by(number=1).one().preview = True
    assert told(house, study).numbers.participants == 1


def test_filters_by_head_condition_and_version(house, client):
    study = house.studies.create(small_study(conditions=CONDITIONS, identities=("female", "male")))
    people(client, study, 8)
    config = house.life.config(study.id).model_copy(update={"title": "Second version"})
    house.life.save(study.id, config, None)
    people(client, study, 4)
    options = told(house, study).options
    assert options.heads == ("female", "male")
    assert options.conditions == ("one", "two")
    assert options.versions == (1, 2)
    assert told(house, study, since=2).numbers.participants == 4
    assert told(house, study).numbers.versions == (1, 2)
    by_head = [told(house, study, head=head) for head in options.heads]
    assert sum(one.numbers.participants for one in by_head) == 12
    assert {one.cell.identity for one in by_head[1].numbers.cells} == {"male"}
    assert told(house, study, condition="one").numbers.conditions == (("one", 6),)
    assert told(house, study, head="nobody").numbers.faces == 0
    for wrong in ({"who": "odd"}, {"flagged": "odd"}):
        with pytest.raises(InvalidError):
            told(house, study, **wrong)
    with pytest.raises(NotFoundError):
        house.results.of("none", Filters())


@BOTH
def test_failed_checks_are_left_out_by_default_and_names_are_counted(house, client):
    study = house.studies.create(small_study(blocks=BLOCKS, generations=1))
    for right in (True, True, False):
        finish(client, study, right=right)
    found = told(house, study)
    assert (found.options.flagged, found.numbers.participants) == (1, 2)
    assert told(house, study, flagged="keep").numbers.participants == 3
    (table,) = found.numbers.confusions
    assert (table.source, table.rows) == ("own", ("happy", "angry"))
    assert [sum(row) for row in table.counts] == [2, 2]
    assert sum(row[table.columns.index("happy")] for row in table.counts) == 4, "everybody says happy"
    assert found.options.blocks == ("first", "again")
    assert told(house, study, block="again").numbers.faces == 4
    assert told(house, study).numbers.faces == 4


def test_results_are_kept_until_somebody_finishes_or_goes(house, client, study, monkeypatch):
    people(client, study, 1)
    told(house, study)
    house.noise.settle()
    first = told(house, study)
    assert told(house, study) is first
    Walker(client, study.links[0]).finish(steps=3)
    assert told(house, study) is first, "somebody who has not finished changes nothing"
    finish(client, study)
    second = told(house, study)
    assert second.numbers.participants == 2
    house.withdrawals.erase(study.id, 0, None)
    assert told(house, study).numbers.participants == 1


def test_faces_of_another_face_model_are_left_out_and_told(house, client, study):
    people(client, study, 2)
    with house.database.write() as tx:
        from server.store.studies_tables import RigRecord

        rig = tx.query(RigRecord).one()
        tx.add(RigRecord(hash="old", name="old", genes=rig.genes, shapes=rig.shapes, first_used_at=rig.first_used_at))
        tx.flush()
        tx.query(Participation).filter_by(number=0).one().rig_hash = "old"
    found = told(house, study)
    assert (found.numbers.faces, found.data.foreign) == (2, 2)


def test_who_looks_at_one_study_waits_for_no_other_and_what_two_want_is_counted_once(house, study, monkeypatch):
    other = house.studies.create(small_study())
    counted, held, going = [], threading.Event(), threading.Event()
    count = StudyResults._count

    def slow(self, study_id, *rest):
        counted.append(study_id)
        if study_id == study.id:
            going.set()
            assert held.wait(20)
        return count(self, study_id, *rest)

    monkeypatch.setattr(StudyResults, "_count", slow)
    with ThreadPoolExecutor(2) as pool:
        first = pool.submit(house.results.of, study.id, Filters())
        assert going.wait(20)
        second = pool.submit(house.results.of, study.id, Filters())
        assert house.results.of(other.id, Filters()).counted_at
        assert not first.done()
        held.set()
        assert first.result(20) is second.result(20)
    assert counted == [study.id, other.id]


def test_a_count_that_failed_is_told_and_tried_again(house, study, monkeypatch):
    monkeypatch.setattr(StudyResults, "_count", lambda *_: 1 / 0)
    with pytest.raises(ZeroDivisionError):
        house.results.of(study.id, Filters())
    monkeypatch.undo()
    assert house.results.of(study.id, Filters()).counted_at


def test_of_results_that_changed_only_the_newest_are_kept_and_only_a_few(house, client, study):
    for _ in range(2):
        Walker(client, study.links[0]).finish()
        house.results.of(study.id, Filters())
    assert len(house.results._kept) == 1
    for number in range(12):
        house.results.of(study.id, Filters(condition=f"c{number}"))
    assert len(house.results._kept) == 8
