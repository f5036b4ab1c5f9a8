"""Pages around the trials in Chromium: readable for everybody, a card and its outline, a place that is about to go."""

from __future__ import annotations

import json
import sqlite3
from contextlib import closing
from datetime import UTC, datetime, timedelta

import pytest

from .player import Player
from .stage import SMALL, TEXTS, participation_of, running
from .test_accessibility import must_be_accessible

pytestmark = pytest.mark.browser
COMPLETION = {
    "codes": {"full": "FULL1", "no_consent": "NONE1"},
    "redirects": {"full": "https://app.prolific.com/submissions/complete?cc={code}"},
}
PLACES = {
    "sized": {**SMALL, "devices": {"face_degrees": 6}, "texts": {**TEXTS, "consents": ("I am over 16.",)}},
    "desk": {**SMALL, "devices": {"phones": False, "least_height": 600}, "translations": {"de": {}}},
    "full": {**SMALL, "quota": 1, "completion": COMPLETION},
    "lease": {**SMALL, "lease_minutes": 30},
    "closed": SMALL,
}  # fmt: skip
WIDE, NARROW = {"width": 1280, "height": 800}, {"width": 360, "height": 740}


@pytest.fixture(scope="module")
def places(tmp_path_factory):
    with running(tmp_path_factory.mktemp("arrival"), PLACES) as stage:
        yield stage


@pytest.fixture
def visit(browser):
    """Return somebody new with a window of a size."""
    made = []

    def come(viewport, **options):
        context = browser.new_context(viewport=viewport, **options)
        player = Player(context.new_page())
        made.append((context, player))
        return player

    yield come
    for context, player in made:
        context.close()
        assert player.problems == []


def must_fit(page):
    assert page.evaluate("document.documentElement.scrollWidth <= innerWidth"), "scrolls sideways"


@pytest.mark.parametrize("viewport", [WIDE, NARROW], ids=["wide", "narrow"])
def test_every_page_is_accessible_and_fits(places, visit, viewport):
    player = visit(viewport)
    page = player.page

    def good():
        must_be_accessible(page)
        must_fit(page)

    page.goto(places.link("desk"))
    good()
    player.arrive(places.link("sized"))
    good()
    player.page.locator(".statement label").click()
    page.get_by_role("button", name="I agree, start").click()
    page.locator("#fit", has_text="window").wait_for()
    good()
    page.get_by_role("button", name="I have no card here").click()
    page.wait_for_selector(".steps")
    good()
    page.goto(places.link("closed"))
    good()
    page.goto(places.link("full"))
    if places.one("SELECT count(*) FROM participations p JOIN links l ON p.link_id = l.id WHERE l.id = ?",
                  places.links["full"]) == 0:  # fmt: skip
        visit(viewport).arrive(places.link("full"))
        page.goto(places.link("full"))
    page.get_by_role("heading", name="This study has enough participants now").wait_for()
    good()


def size(page, selector):
    box = page.locator(selector).first.bounding_box()
    return box["width"], box["height"]


def outline(page):
    return size(page, "#card")[0]


def measuring(places, player):
    player.arrive(places.link("sized"))
    player.page.locator(".statement label").click()
    player.page.get_by_role("button", name="I agree, start").click()
    player.page.locator("#fit", has_text="window").wait_for()
    return player.page


def test_outline_slider_and_field_are_one(places, visit):
    player = visit(WIDE)
    page = measuring(places, player)
    slider, number = page.locator("#card-slider"), page.locator("#card-number")
    assert outline(page) == 324 == float(number.input_value()) == float(slider.input_value())
    slider.focus()
    page.keyboard.press("ArrowRight")
    page.keyboard.press("ArrowRight")
    assert outline(page) == 326 == float(number.input_value())
    number.fill("428")
    assert outline(page) == 428 == float(slider.input_value())
    number.fill("5")
    assert outline(page) == 428, "what is half typed changes nothing"
    number.press("Tab")
    assert outline(page) == 60
    number.fill("428")
    page.locator("#distance").fill("60")
    page.get_by_role("button", name="Continue").click()
    page.wait_for_selector(".steps")
    (device,) = places.rows("SELECT device FROM participations WHERE id = ?", participation_of(places, page))
    found = json.loads(device[0])
    assert (found["px_per_mm"], found["distance_mm"], found["kind"]) == (5, 600, "computer")
    assert found["tile_height"] == pytest.approx(2 * 600 * 0.05240778 * 5, abs=0.06)
    player.read()
    room = min((1280 - 112) / 5 * 6 / 5, (800 - 214 - 12) / 2)
    assert size(page, ".tile")[1] == pytest.approx(min(found["tile_height"], room), abs=1)
    player.choose(0).next()
    page.wait_for_selector("[data-generation]")
    assert places.rows("SELECT DISTINCT round(tile_height) FROM choices WHERE tile_height > 200") != []


def test_the_window_that_cannot_hold_the_size_is_told_before_the_instructions(places, visit):
    page = measuring(places, visit(WIDE))
    assert page.locator("#fit").inner_text() == "All ten faces fit into your window at this size."
    page.locator("#distance").fill("200")
    page.locator("#fit", has_text="too small for this size").wait_for()
    page.locator("#distance").fill("2")
    page.get_by_role("button", name="Continue").click()
    assert "Enter a distance from 15 to 300 cm" in page.locator("#summary").inner_text()


def test_a_smaller_size_is_kept_on_a_wide_window(places, visit):
    player = visit(WIDE)
    page = measuring(places, player)
    page.locator("#distance").fill("30")
    page.get_by_role("button", name="Continue").click()
    page.wait_for_selector(".steps")
    player.read()
    wanted = player.state()["study"]["tile_height"]
    assert wanted < 150
    assert page.evaluate("document.querySelector('.tile').getBoundingClientRect().height") == pytest.approx(
        wanted, abs=1
    )


def test_on_a_phone_the_card_stands_upright(places, visit):
    page = measuring(places, visit(NARROW, has_touch=True, is_mobile=True))
    width, height = size(page, "#card")
    assert height / width == pytest.approx(85.6 / 53.98, abs=0.01)
    assert width <= 360
    left = page.locator("#card").bounding_box()["x"]
    assert left == pytest.approx(360 - left - width, abs=1), "as far from either edge"
    assert page.locator("#distance").input_value() == "35"
    assert page.get_by_text("Hold it upright").is_visible()


def set_lease(places, who, seconds):
    until = datetime.now(UTC) + timedelta(seconds=seconds)
    with closing(sqlite3.connect(places.folder / "emogen.db", timeout=10)) as database:
        stored = database.execute("SELECT lease_until FROM participations WHERE id = ?", (who,)).fetchone()[0]
        text = until.isoformat(sep=stored[10])[: len(stored)]
        database.execute("UPDATE participations SET lease_until = ? WHERE id = ?", (text, who))
        database.commit()


def test_the_page_asks_before_a_place_is_given_away(places, visit):
    player = visit(WIDE)
    page = player.arrive(places.link("lease")).page
    page.clock.install()
    page.reload()
    who = participation_of(places, page)
    assert page.locator("#lease.shown").count() == 0
    set_lease(places, who, 290)
    page.clock.fast_forward("25:02")
    page.locator("#lease [role=status]", has_text="kept for 5 more minutes").wait_for()
    must_be_accessible(page)
    page.get_by_role("button", name="I am still here").click()
    page.locator("#lease [role=status]", has_text="Your place is kept").wait_for()
    left = places.one("SELECT lease_until FROM participations WHERE id = ?", who)
    assert datetime.fromisoformat(left).replace(tzinfo=UTC) > datetime.now(UTC) + timedelta(minutes=29)
    page.clock.fast_forward("00:05")
    page.locator("#lease.shown").wait_for(state="detached")


def test_an_answer_in_the_meantime_is_as_good(places, visit):
    page = visit(WIDE).arrive(places.link("lease")).page
    page.clock.install()
    page.reload()
    with page.expect_response("**/lease"):
        page.clock.fast_forward("25:02")
    assert page.locator("#lease.shown").count() == 0


def test_a_zoomed_page_is_let_in_and_a_small_screen_is_not(places, visit):
    """At 200 % a window of 1280 x 800 has 640 x 400: `desk` wants a computer and 600 px of height."""
    zoomed = visit({"width": 640, "height": 400}, screen={"width": 1280, "height": 800}).page
    zoomed.goto(places.link("desk"))
    assert "If you have enlarged the page to see better, leave it so." in zoomed.locator("#too-little").inner_text()
    zoomed.locator("main form button").click()
    zoomed.wait_for_url("**/p/*")
    low = visit({"width": 900, "height": 500}, screen={"width": 900, "height": 500}).page
    low.goto(places.link("desk"))
    assert "Your screen has 900 by 500 pixels" in low.locator("#too-little").inner_text()
    low.locator("main form button").click()
    low.get_by_role("heading", name="Please use a larger screen for this study").wait_for()


def test_an_old_browser_is_told_and_takes_no_place(places, visit):
    page = visit(WIDE).page
    page.add_init_script("delete window.HTMLDialogElement")
    page.goto(places.link("desk"))
    assert page.get_by_text("This page needs a newer browser.").is_visible()
    assert page.locator("main form button:visible").count() == 0
