"""One look at a study: right counts, one transaction for all who watch, nobody counted who is not a person."""

import threading
from concurrent.futures import ThreadPoolExecutor
from datetime import timedelta

import pytest
from sqlalchemy import event, select  # noqa: TID251

from server.services.clock import told_by
from server.services.errors import NotFoundError, UnavailableError
from server.services.reports.monitor import monitor as rules
from server.services.reports.monitor.monitor import View
from server.store.runs_tables import ChoiceRecord, Generation, Participation, Trial
from tests.conftest import small_study
from tests.server.conftest import END, PEOPLE
from tests.server.walker import Walker


@pytest.fixture
def statements(full):
    said = []
    event.listen(full.database.engine, "before_cursor_execute", lambda *told: said.append(told[2]))
    return said


def rows(full):
    with full.database.read() as tx:
        return tx.scalars(select(Participation)).all()


def test_a_look_counts_what_the_rows_say(full, day):
    look = full.monitor.look(day.study, View("all"))
    found = rows(full)
    running = [row for row in found if row.outcome is None]
    assert look.arrived == len(found) == PEOPLE
    assert look.figures.here == sum(row.lease_until > END for row in running)
    assert look.figures.left == sum(row.lease_until <= END for row in running) + sum(
        row.outcome == "stopped" for row in found
    )
    assert look.figures.complete == sum(row.outcome == "complete" for row in found)
    assert look.figures.withdrew == 1
    assert sum(look.arrivals.arrived) == PEOPLE
    assert sum(look.arrivals.complete) == look.figures.complete
    assert look.moment == END


def test_those_in_the_study_are_listed_with_where_they_are(full, day):
    look = full.monitor.look(day.study, View("today", everyone=True))
    here = {row.number: row for row in rows(full) if row.outcome is None and row.lease_until > END}
    assert [person.number for person in look.people] == sorted(here, reverse=True)
    for person in look.people:
        row = here[person.number]
        assert person.away == (END - row.last_answer_at >= timedelta(minutes=5))
        assert 0 <= person.done <= person.sets == 4
        assert person.group == f"{row.condition}, {row.head}"
        assert int(person.done) in {max(row.position - 1, 0), max(row.position - 1, 0) + 1}
    assert any(person.away for person in look.people)
    assert len(full.monitor.look(day.study, View("today")).people) == min(len(here), rules.ROWS)


def test_who_is_at_the_last_page_of_a_face_that_ends_early_is_nearly_done_with_it(house, client, soon_sure):
    search = {"strategy": "preference", "activation": (2, 3), "stop_at": 0.5, "least_generations": 1}
    study = house.studies.create(small_study(generations=9, search=search))
    walker = Walker(client, study.links[0])

    def done():
        (person,) = house.monitor.look(study.id, View("all")).people
        return person.done

    walker.finish(steps=3)
    assert done() == 0
    state = walker.step(walker.state())
    assert state["trial"]["final"]
    assert done() == 1 / 2, "one of two pages, not of ten"
    walker.step(state)
    assert done() == 1


def test_times_are_those_of_the_choices(full, day):
    times = full.monitor.look(day.study, View("all")).times
    query = select(ChoiceRecord).join(Generation, Generation.id == ChoiceRecord.generation_id).join(Trial)
    with full.database.read() as tx:
        choices = tx.scalars(query.where(Trial.practice.is_(False))).all()
    assert times.wait.count == len(choices)
    assert sum(one.whole.count for one in times.waits[:3]) == len(choices)
    assert times.waits[3].whole.count == len(choices)
    assert times.waits[2].whole.median > times.waits[0].whole.median, "phones wait longer"


def test_a_sample_is_taken_of_many_people_and_told(full, day, monkeypatch):
    monkeypatch.setattr(rules, "SAMPLE", 10)
    times = full.monitor.look(day.study, View("all")).times
    assert times.people == PEOPLE
    assert times.sampled == sum(row.number % 4 == 0 for row in rows(full))
    assert times.wait.count > 0


def test_only_the_named_kind_counts(full, day):
    with full.database.write() as tx:
        for row in tx.scalars(select(Participation).where(Participation.number < 6)):
            row.simulated, row.pilot, row.preview = row.number < 2, 2 <= row.number < 4, row.number == 5
    arrived = {who: full.monitor.look(day.study, View("all", who)).arrived for who in ("people", "pilot", "simulated")}
    assert arrived == {"people": PEOPLE - 5, "pilot": 2, "simulated": 2}


def test_in_its_pilot_phase_the_pilot_is_shown(full, day):
    assert full.monitor.look(day.study, View()).view.who == "people"
    other = full.studies.create(full.life.config(day.study), "pilot")
    assert full.monitor.look(other.id, View()).view.who == "pilot"


def test_a_look_is_one_transaction_of_few_queries(full, day, statements):
    full.monitor.look(day.study, View("all"))
    statements.clear()
    full.monitor.look(day.study, View("all"))
    assert statements.count("BEGIN") == 1 and len(statements) == 6


def test_all_who_watch_share_a_look(full, day, statements):
    gate = threading.Barrier(8)

    def watch():
        gate.wait(10)
        return full.monitor.glance(day.study, View())

    with ThreadPoolExecutor(8) as pool:
        looks = list(pool.map(lambda _: watch(), range(8)))
    assert all(look is looks[0] for look in looks)
    assert statements.count("BEGIN") == 1 and len(statements) <= 7
    with told_by(lambda: END + rules.FRESH):
        assert full.monitor.glance(day.study, View()) is not looks[0]


def test_nothing_new_is_an_equal_look(full, day):
    one, other = full.monitor.look(day.study, View()), full.monitor.look(day.study, View())
    assert one == other and one is not other


def test_watchers_are_bounded_and_nobody_begins_to_watch_a_closing_server(full):
    full.monitor.most_watchers = 2
    with full.monitor.watching():
        full.monitor.check_watchers()
        with full.monitor.watching(), pytest.raises(UnavailableError):
            full.monitor.check_watchers()
    full.monitor.close()
    with pytest.raises(UnavailableError):
        full.monitor.check_watchers()


def test_no_such_study(full):
    with pytest.raises(NotFoundError):
        full.monitor.look("none", View())
