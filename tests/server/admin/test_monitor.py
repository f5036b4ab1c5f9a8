"""The monitor's page: written-out denominators, charts with words and numbers, updates of what has changed only."""

import asyncio
import json
import re
from datetime import timedelta

import pytest

from server.routes.admin import stream
from server.routes.admin.monitor import PARTS, Pieces
from server.services.clock import told_by
from server.services.errors import UnauthorisedError
from server.services.reports.monitor.monitor import View
from tests.server.admin.test_account import post
from tests.server.conftest import END


@pytest.fixture
def page(full_owner, day):
    return lambda query="": full_owner.get(f"/admin/studies/{day.study}/monitor{query}")


def figure(text, name):
    return re.search(rf"<dt>{name}</dt><dd>(.*?)</dd><dd class=\"hint\">(.*?)</dd>", text).groups()


def test_key_figures_say_of_how_many(page, full, day):
    found = full.monitor.look(day.study, View()).figures
    text = page().text
    assert figure(text, "In the study now")[0] == str(found.here)
    assert figure(text, "Completed")[0] == f"{found.complete} <small>of 96</small>"
    assert (
        figure(text, "Left early")[1]
        == f"{found.left} of the {found.complete + found.left} no longer in it; 1 withdrew"
    )
    assert "22 Mar 2026 14:07:31 UTC" in text


@pytest.mark.parametrize("span", ["hour", "today", "week", "all"])
def test_every_span_has_its_address_and_its_numbers(page, span):
    text = page(f"?range={span}").text
    assert re.search(rf'href="[^"]*range={span}[^"]*" aria-current="true"', text)
    for title in ("Arrivals and completions", "Still taking part", "Wait until all ten", "Time a generation"):
        assert title in text
    assert text.count("Show numbers") == 4
    assert not re.search(r"\sstyle=|<script>", text), "the pages' policy"
    ids = re.findall(r'\sid="([^"]+)"', text)
    assert len(ids) == len(set(ids))


def test_a_range_that_is_none_is_refused(page):
    assert page("?range=fortnight").status_code == 422
    assert page("?who=cats").status_code == 422


def test_links_lead_to_each_participant(page, full, day, monkeypatch):
    monkeypatch.setattr("server.services.reports.monitor.monitor.ROWS", 3)
    here = full.monitor.look(day.study, View(everyone=True)).people
    found = re.findall(rf'href="/admin/studies/{day.study}/participants/(\d+)"', page("?everyone=true").text)
    assert found == [str(person.number) for person in here]
    assert f"Show all {len(here)}" in page().text


def test_an_empty_study_offers_the_first_step(full_owner, full, day):
    made = full.studies.create(full.life.config(day.study))
    text = full_owner.get(f"/admin/studies/{made.id}/monitor").text
    assert "No one has started yet." in text and f'href="/admin/studies/{made.id}/recruit"' in text


def test_those_who_do_not_count_are_shown_apart(page):
    assert "There are none yet." in page("?who=simulated").text
    assert "They do not count in the figures of the study." in page("?who=pilot").text


def test_a_piece_is_made_anew_only_when_it_has_changed(full, day):
    pieces = Pieces(full, day.study)
    before = pieces.made(full.monitor.look(day.study, View()))
    assert set(before) == {*PARTS, "sent"}
    with told_by(lambda: END + timedelta(seconds=5)):
        after = pieces.made(full.monitor.look(day.study, View()))
    assert all(after[name] is before[name] for name in before)
    full.joining.join(day.link)
    changed = pieces.made(full.monitor.look(day.study, View()))
    names = {name for name in before if changed[name] is not before[name]}
    assert names == {"figures", "arrivals", "where", "places", "people"}


def told(full, study, signed_in=lambda: None, gone=None, ticks=3):
    """What a watcher is told in some ticks, without the pauses."""
    pieces, seen = Pieces(full, study), []

    async def leaves():
        return len(seen) > ticks

    async def watch():
        parts = lambda: pieces.told(full.monitor.glance(study, View()))  # noqa: E731
        async for line in stream.updates(full.monitor, parts, signed_in, gone or leaves):
            seen.append(line)
            if len(seen) == 3:
                await asyncio.to_thread(full.joining.join, full.studies.summary(study).links[0])
        return seen

    return asyncio.run(watch())


@pytest.fixture
def quick(monkeypatch):
    monkeypatch.setattr(stream, "TICK", 0.02)
    monkeypatch.setattr(stream, "STEP", 0.01)
    monkeypatch.setattr("server.services.reports.monitor.monitor.FRESH", timedelta(0))


def parts_of(line):
    assert line.startswith("event: look\n") and line.endswith("\n\n")
    return json.loads(line.split("data: ", 1)[1])


def test_a_watcher_is_told_everything_once_and_then_what_changes(full, day, quick):
    opening, first, second, third = told(full, day.study)
    assert opening.startswith("retry: ")
    assert set(parts_of(first)) == {*PARTS, "sent", "clock"}
    assert parts_of(second) == {}, "the clock stands still here, and nothing else has changed"
    assert set(parts_of(third)) == {"figures", "arrivals", "where", "places", "people", "clock"}


def test_a_stream_ends_with_the_session_and_with_the_server(full, day, quick, monkeypatch):
    monkeypatch.setattr(stream, "CHECKS", 1)
    checks = iter([None])

    def signed_in():
        if next(checks, "over"):
            raise UnauthorisedError("Sign in to go on.")

    assert told(full, day.study, signed_in)[-1] == 'event: end\ndata: {"why": "Sign in to go on."}\n\n'
    full.monitor.close()
    assert told(full, day.study)[-1].startswith("event: end\n")


def test_a_stream_notices_at_once_that_the_server_stops(full, day, monkeypatch):
    monkeypatch.setattr(stream, "STEP", 0.01)

    async def gone():
        full.monitor.close()
        return False

    assert len(told(full, day.study, gone=gone)) == 2, "it does not wait for the next tick"


def test_the_stream_is_refused_when_too_many_watch(full_owner, full, day):
    full.monitor.most_watchers = 0
    reply = full_owner.get(f"/admin/studies/{day.study}/monitor/stream", headers={"accept": "text/event-stream"})
    assert reply.status_code == 503
    assert reply.headers["retry-after"] == "15"


def test_no_such_study(full_owner):
    for path in ("monitor", "monitor/stream"):
        assert full_owner.get(f"/admin/studies/none/{path}").status_code == 404


def test_simulated_participants_are_sent_and_never_count(full_owner, full, day):
    page = f"/admin/studies/{day.study}/monitor"
    before = full.monitor.look(day.study, View()).figures
    reply = post(full_owner, f"/admin/studies/{day.study}/simulations", page=page, count="3", seed="5")
    assert reply.headers["location"] == f"{page}?who=simulated"
    full.simulations.settle()
    assert full.monitor.look(day.study, View()).figures == before
    assert full.monitor.look(day.study, View(who="simulated")).figures.complete == 3
    assert "The last run is over: 3 of 3 came to their end (seed 5)." in full_owner.get(page).text


@pytest.mark.parametrize(("field", "value"), [("count", "0"), ("count", "51"), ("count", "many"), ("seed", "-1")])
def test_a_wrong_number_is_said_at_its_field_and_kept(full_owner, day, field, value):
    page = f"/admin/studies/{day.study}/monitor"
    given = {"count": "7", "seed": "5", field: value}
    reply = post(full_owner, f"/admin/studies/{day.study}/simulations", page=page, **given)
    assert reply.status_code == 422
    for name, typed in given.items():
        assert f'value="{typed}"' in re.search(rf'<input id="{name}"[^>]*>', reply.text)[0]
    assert 'aria-invalid="true"' in re.search(rf'<input id="{field}"[^>]*>', reply.text)[0]
