"""The rules of the evolve page: sizes, selecting, marking, limits, undo, focus."""

from __future__ import annotations

import pytest

from .conditions import apart
from .player import Player
from .stage import participation_of

pytestmark = pytest.mark.browser

SIZES = [((1280, 800), (234, 280)), ((1366, 625), (185, 222)), ((1024, 768), (182, 219)), ((1920, 1080), (330, 396))]


@pytest.fixture
def evolving(stage, player):
    return player.begin(stage.link("small"))


def test_tiles_fill_the_window_without_scrolling(evolving):
    page = evolving.page
    for (width, height), (tile_width, tile_height) in SIZES:
        page.set_viewport_size({"width": width, "height": height})
        box = page.locator(".tile").first.bounding_box()
        assert (box["width"], box["height"]) == pytest.approx((tile_width, tile_height), abs=1)
        last = page.locator(".tile").last.bounding_box()
        assert last["y"] + last["height"] < page.locator(".footer").bounding_box()["y"]
        assert page.evaluate("document.documentElement.scrollHeight <= innerHeight")


# A zoomed page is a low window: 1920x1080 at 250 %, a browser beside another one, a phone on its side.
@pytest.mark.parametrize("size", [(768, 432), (900, 420), (1280, 400), (700, 470), (640, 400), (740, 360)])
def test_in_a_low_window_each_face_is_seen_whole_by_scrolling(evolving, size):
    page = evolving.page
    page.set_viewport_size({"width": size[0], "height": size[1]})
    for tile in page.locator(".tile").all():
        tile.scroll_into_view_if_needed()
        box = tile.bounding_box()
        assert box["width"] >= 130
        assert round(box["y"]) >= 0 and round(box["y"] + box["height"]) <= size[1]
    assert page.evaluate("document.documentElement.scrollWidth") == size[0]
    page.locator("#next").scroll_into_view_if_needed()
    assert page.locator("#next").is_visible()


@pytest.mark.parametrize("size", [(640, 400), (700, 470), (900, 420)])
def test_somebody_who_zoomed_before_gets_to_the_next_faces(stage, browser, size):
    """No bar sticks in a low window, so none may be counted as covering faces that were in view."""
    context = browser.new_context(viewport={"width": size[0], "height": size[1]})
    player = Player(context.new_page()).begin(stage.link("small"))
    player.choose(1).next().wait_generation("Generation 1 of")
    assert player.problems == []
    context.close()


@pytest.mark.parametrize("width", [320, 390, 640, 767])
def test_narrow_pages_never_scroll_sideways(evolving, width):
    evolving.page.set_viewport_size({"width": width, "height": 700})
    assert evolving.page.evaluate("document.documentElement.scrollWidth") == width
    first, second = (evolving.tile(index).bounding_box() for index in (0, 1))
    assert first["y"] == second["y"] and first["width"] > width / 2 - 40


def test_one_face_is_best_by_definition(evolving):
    evolving.choose(1)
    assert evolving.status() == "Selected 1 · best chosen"
    evolving.choose(2)
    assert evolving.status() == "Selected 2 · mark the closest"
    assert evolving.page.locator(".best:checked").count() == 0
    apart(evolving.page)
    evolving.choose(2)
    assert evolving.status() == "Selected 1 · best chosen"


def test_mark_that_the_person_set_stays(evolving):
    evolving.choose(1, best=1).choose(2, 3)
    assert evolving.status() == "Selected 3 · best chosen"
    apart(evolving.page)
    evolving.choose(1)
    assert evolving.status() == "Selected 2 · mark taken back"


def test_double_click_selects_and_marks(evolving):
    evolving.choose(1)
    evolving.tile(5).locator(".face").dblclick()
    assert evolving.status() == "Selected 2 · best chosen"
    assert evolving.tile(5).locator(".best").is_checked()
    apart(evolving.page)
    evolving.tile(1).locator(".face").dblclick()
    assert evolving.status() == "Selected 2 · best chosen"
    assert evolving.tile(1).locator(".best").is_checked()


def test_undo_goes_back_step_by_step(evolving):
    evolving.choose(1, 2, best=2)
    for status in ("Selected 2 · mark the closest", "Selected 1 · best chosen", "Nothing selected yet"):
        evolving.page.keyboard.press("Control+z")
        assert evolving.status() == status
    assert evolving.page.locator("#undo").is_hidden()


def test_next_says_what_is_missing_and_goes_there(evolving):
    evolving.next()
    assert evolving.status() == "Choose at least one face."
    assert evolving.page.evaluate("document.activeElement.id") == "select-1"
    evolving.choose(3, 6, 8).next()
    assert evolving.status() == "Mark the closest of the 3 faces you chose."
    assert evolving.page.evaluate("document.activeElement.id") == "best-4"


def test_limits_of_the_study(stage, player):
    player.arrive(stage.link("limited")).agree().read()
    assert "Choose up to 3 faces" in player.page.locator(".hint").inner_text()
    player.choose(0).next()
    player.page.wait_for_selector("[data-generation]")
    player.faces()
    assert "Choose 2 to 3 faces" in player.page.locator(".hint").inner_text()
    player.choose(1).next()
    assert player.status() == "Choose at least 2 faces."
    player.choose(2, 3, 4)
    assert player.status() == "You can choose up to 3 faces. Take one back first."
    assert player.page.locator(".select:checked").count() == 3


def test_input_right_after_the_onset_is_ignored(evolving):
    page = evolving.page
    page.evaluate(
        """() => new MutationObserver((_, observer) => {
          const grid = document.getElementById("grid");
          if (!grid.classList.contains("shown") || grid.classList.contains("empty")) return;
          observer.disconnect();
          grid.querySelector(".face").click();
        }).observe(document.getElementById("grid"), { attributes: true })"""
    )
    page.wait_for_timeout(50)
    evolving.choose(1).next().wait_generation("Generation 1 of")
    assert evolving.status() == "Nothing selected yet"
    assert page.locator(".select:checked").count() == 0


def test_grid_is_one_tab_stop(evolving):
    page = evolving.page
    page.locator("#select-1").focus()
    for key, place in (
        ("ArrowLeft", 1),
        ("ArrowDown", 6),
        ("ArrowRight", 7),
        ("End", 10),
        ("ArrowRight", 10),
        ("Home", 1),
    ):
        page.keyboard.press(key)
        assert page.evaluate("document.activeElement.id") == f"select-{place}", key
    page.keyboard.press("Space")
    order = []
    for _ in range(4):
        page.keyboard.press("Tab")
        order.append(page.evaluate("document.activeElement.id || document.activeElement.className"))
    assert order == ["best-1", "enlarge", "undo", "next"]


def test_right_to_left_mirrors_the_grid_and_the_arrows(evolving):
    page = evolving.page
    page.evaluate("document.documentElement.dir = 'rtl'")
    first, second = (evolving.tile(index).bounding_box() for index in (0, 1))
    assert first["x"] > second["x"]
    page.locator("#select-1").focus()
    page.keyboard.press("ArrowLeft")
    assert page.evaluate("document.activeElement.id") == "select-2"
    assert page.locator("#next").bounding_box()["x"] < page.locator("#status").bounding_box()["x"]


def test_start_again_asks_first(evolving):
    page = evolving.page
    assert page.locator(".footer .again").is_hidden()
    evolving.choose(1).next().wait_generation("Generation 1 of")
    page.locator(".footer .again").click()
    page.get_by_role("link", name="Carry on with this one").click()
    assert evolving.generation() == "Generation 1 of 2"
    page.locator(".footer .again").click()
    page.get_by_role("button", name="Start again").click()
    evolving.wait_generation("First faces")
    assert evolving.status() == "This face begins anew."
    assert evolving.state()["trial"]["attempt"] == 1


@pytest.mark.parametrize(("button", "heading", "kept"), [
    ("Stop and keep", "You have stopped taking part", True),
    ("Stop and erase", "Your answers have been erased", False),
])  # fmt: skip
def test_stop_keeps_or_erases(stage, evolving, button, heading, kept):
    someone = participation_of(stage, evolving.page)
    evolving.page.locator(".wide-link").nth(1).click()
    evolving.page.get_by_role("button", name=button).click()
    evolving.page.get_by_role("heading", name=heading).wait_for()
    assert stage.one("SELECT count(*) > 0 FROM trials WHERE participation_id = ?", someone) == kept


def test_holding_a_finger_enlarges_and_does_not_select(stage, phone):
    phone.begin(stage.link("small"))
    page = phone.page
    touch = page.context.new_cdp_session(page)
    box = phone.tile(0).bounding_box()
    point = {"x": box["x"] + 80, "y": box["y"] + 100}
    touch.send("Input.dispatchTouchEvent", {"type": "touchStart", "touchPoints": [point]})
    page.wait_for_selector("#enlarged[open]")
    touch.send("Input.dispatchTouchEvent", {"type": "touchEnd", "touchPoints": []})
    page.wait_for_timeout(400)
    assert page.locator("#enlarged[open]").count() == 1
    page.locator("#enlarged-close").tap()
    assert page.locator(".select:checked").count() == 0
