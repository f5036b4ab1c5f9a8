"""Reload, a second tab, a lost connection, a closed page: no answer is lost and none is stored twice."""

from __future__ import annotations

import pytest

from tests.browser.stage import participation_of

pytestmark = pytest.mark.browser

CHOSEN = (
    "SELECT g.number FROM choices c JOIN generations g ON c.generation_id = g.id JOIN trials t ON g.trial_id = t.id"
    " WHERE t.participation_id = ? AND NOT t.practice ORDER BY g.number"
)


def chosen(stage, page):
    return [number for (number,) in stage.rows(CHOSEN, participation_of(stage, page))]


def stored_answers(stage, page):
    return stage.one("SELECT count(*) FROM answers WHERE participation_id = ?", participation_of(stage, page))


def portraits(page):
    return page.locator(".tile img").evaluate_all("images => images.map(image => image.src)")


def test_reload_goes_on_where_it_was(stage, player):
    player.begin(stage.link("small"))
    player.choose(2).next().wait_generation("Generation 1 of")
    before = portraits(player.page)
    player.choose(4)
    player.page.reload()
    player.faces()
    assert player.generation() == "Generation 1 of 2"
    assert portraits(player.page) == before
    assert player.status() == "Nothing selected yet"
    player.choose(4).next().wait_generation("Generation 2 of")
    assert chosen(stage, player.page) == [0, 1]


def test_the_study_link_leads_back(stage, player):
    player.begin(stage.link("small"))
    address = player.page.url
    player.page.goto(stage.link("small"))
    player.page.get_by_role("link", name="Carry on where you were").click()
    player.faces()
    assert player.page.url == address


def test_second_tab_moves_on_to_the_current_faces(stage, player):
    player.begin(stage.link("small"))
    other = player.page.context.new_page()
    other.goto(player.page.url)
    other.wait_for_selector("#grid.shown")
    player.choose(1).next().wait_generation("Generation 1 of")
    current = portraits(player.page)
    other.wait_for_timeout(300)
    other.locator(".tile .face").nth(7).click()
    other.locator("#next").click()
    other.locator("[data-generation]", has_text="Generation 1 of").wait_for()
    other.wait_for_selector("#grid.shown")
    assert portraits(other) == current
    assert "another window" in other.locator("#status").inner_text()
    assert chosen(stage, player.page) == [0]
    other.close()


def test_offline_in_the_middle(stage, player):
    player.begin(stage.link("small"))
    context, page = player.page.context, player.page
    context.set_offline(True)
    player.choose(1, 5, best=5).next()
    page.get_by_role("heading", name="Your answer is safe on this device").wait_for()
    assert "Next try in" in page.locator(".next-try").inner_text()
    assert chosen(stage, page) == []
    before = stored_answers(stage, page)
    context.set_offline(False)
    player.wait_generation("Generation 1 of")
    assert player.status() == "Connected again. Your answer has arrived."
    assert chosen(stage, page) == [0]
    assert stored_answers(stage, page) == before + 1


def test_reply_lost_on_the_way_back(stage, player):
    player.begin(stage.link("small"))
    page = player.page
    lost = []

    def lose(route):
        if lost:
            route.continue_()
            return
        lost.append(route.fetch().status)
        route.abort()

    page.route("**/answers", lose)
    player.choose(3).next().wait_generation("Generation 1 of")
    assert lost == [200]
    assert chosen(stage, page) == [0]


def test_closed_while_offline(stage, player):
    player.begin(stage.link("small"))
    context, address = player.page.context, player.page.url
    context.set_offline(True)
    player.choose(8).next()
    player.page.get_by_role("heading", name="Your answer is safe on this device").wait_for()
    player.page.close()
    context.set_offline(False)
    page = context.new_page()
    page.goto(address)
    page.locator("[data-generation]", has_text="Generation 1 of").wait_for()
    page.wait_for_selector("#grid.shown")
    assert chosen(stage, page) == [0]


def test_events_arrive_once(stage, player):
    player.begin(stage.link("small"))
    page = player.page
    player.choose(1).choose(4)
    page.wait_for_timeout(330)
    player.choose(1)
    page.locator("#undo").click()
    player.tile(4).hover()
    player.tile(4).locator(".enlarge").click()
    page.keyboard.press("Escape")
    player.choose(best=4).next().wait_generation("Generation 1 of")
    page.wait_for_timeout(5600)
    rows = stage.rows(
        "SELECT e.type, e.duration_ms FROM events e JOIN generations g ON e.generation_id = g.id"
        " JOIN trials t ON g.trial_id = t.id"
        " WHERE e.participation_id = ? AND NOT t.practice AND g.number = 0 ORDER BY e.at_ms",
        participation_of(stage, page),
    )
    kinds = [kind for kind, _ in rows if kind not in {"blur", "focus", "hidden", "visible"}]
    assert kinds[0] == "onset"
    assert kinds.count("first_view") == 10
    assert [kind for kind in kinds if kind not in {"onset", "first_view"}] == [
        "select", "select", "deselect", "undo", "enlarge", "enlarge_end", "best",
    ]  # fmt: skip
    assert dict(rows)["enlarge_end"] > 0


def test_failed_faces_can_be_drawn_again(stage, player):
    player.begin(stage.link("small"))
    page = player.page
    failed = []

    def fail_two(route):
        if len(failed) < 2:
            failed.append(route.request.url)
            route.abort()
        else:
            route.continue_()

    page.route("**/portraits/*", fail_two)
    player.choose(1).next()
    page.get_by_text("Two faces could not be drawn.").wait_for()
    assert page.locator("#grid.shown").count() == 0
    page.get_by_role("button", name="Draw all ten again").click()
    player.wait_generation("Generation 1 of")
    assert chosen(stage, page) == [0]
