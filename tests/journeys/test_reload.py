"""Reload in the middle of a generation: marks that were not sent yet are there again, what was recorded is kept."""

import pytest

from tests.browser.conditions import on_device, until

from .record import choices, chosen, events

pytestmark = pytest.mark.browser


def state_of(page):
    return page.locator(".tile").evaluate_all(
        "tiles => tiles.map(tile => [tile.querySelector('.select').checked, tile.querySelector('.best').checked])"
    )


def faces_of(page):
    return page.locator(".tile").evaluate_all("tiles => tiles.map(tile => tile.dataset.face)")


def test_marks_come_back_with_the_same_faces(stage, player):
    page = player.begin(stage.link("small")).page
    player.choose(2).next().wait_generation("Generation 1 of")
    player.choose(1, 4, 8, best=4)
    before = state_of(page), faces_of(page)
    page.reload()
    player.faces()
    assert player.status() == "Selected 3 · best chosen"
    assert (state_of(page), faces_of(page)) == before
    page.keyboard.press("Control+z")
    assert player.status() == "Selected 3 · mark the closest", "undo goes back beyond the reload"
    player.tile(4).locator(".strip").click()
    player.next().wait_generation("Generation 2 of")
    faces = before[1]
    assert choices(stage, page)[1] == ([faces[1], faces[4], faces[8]], faces[4])
    assert player.status() == "Nothing selected yet", "marks are of their own faces only"


def test_marks_are_not_those_of_another_attempt(stage, player):
    page = player.begin(stage.link("small")).page
    player.choose(1).next().wait_generation("Generation 1 of").choose(3, 5, best=3)
    page.locator(".footer .again").click()
    page.get_by_role("button", name="Start again").click()
    player.wait_generation("First faces")
    page.reload()
    player.faces()
    assert player.status() == "Nothing selected yet"


def test_events_before_the_reload_are_kept_and_come_first(stage, player):
    page = player.begin(stage.link("small")).page
    page.route("**/events", lambda route: route.abort())
    player.choose(1).choose(4)
    on_device(page, "events", 13)  # the onset, ten faces in view, two chosen
    page.unroute("**/events")
    page.reload()
    player.faces()
    player.choose(6)
    player.next()
    player.tile(1).locator(".strip").click()
    player.next().wait_generation("Generation 1 of")
    page.locator(".wide-link").nth(0).click()
    page.evaluate("dispatchEvent(new Event('pagehide'))")
    rows = until(page, lambda: events(stage, page), lambda rows: len(rows) == 26)
    kinds = [kind for kind, *_ in rows]
    assert kinds.count("onset") == 2, "each load of the page shows the faces anew, on a clock of its own"
    second = len(kinds) - 1 - kinds[::-1].index("onset")
    assert [kind for kind in kinds[:second] if kind in {"select", "best"}] == ["select", "select"]
    assert [kind for kind in kinds[second:] if kind in {"select", "best"}] == ["select", "best"]
    assert max(arrived for *_, arrived in rows[:second]) < rows[second][-1], "two loads are never mixed"
    assert kinds.count("first_view") == 20
    assert chosen(stage, page) == [0]


def test_the_study_link_leads_back(stage, player):
    player.begin(stage.link("small"))
    address = player.page.url
    player.page.goto(stage.link("small"))
    player.page.get_by_role("link", name="Carry on where you were").click()
    player.faces()
    assert player.page.url == address
