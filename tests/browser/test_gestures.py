"""Pointer and keys on a tile: what acts, when, and what must not (design system, interaction rules 1 to 9)."""

import pytest

from .conditions import DOUBLE, apart, quickly

pytestmark = pytest.mark.browser

HOLD = 450
"""Milliseconds after which a finger that stays enlarges."""


@pytest.fixture
def evolving(stage, player):
    return player.begin(stage.link("small"))


def middle(player, place):
    box = player.tile(place).bounding_box()
    return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2


def test_sliding_off_cancels(evolving):
    page = evolving.page
    page.mouse.move(*middle(evolving, 1))
    page.mouse.down()
    assert evolving.status() == "Nothing selected yet", "nothing happens before the release"
    page.mouse.move(640, 740)
    page.mouse.up()
    assert evolving.status() == "Nothing selected yet"


def test_tiles_do_not_drag_zoom_or_open_menus(evolving):
    tile = evolving.tile(0)
    style = tile.evaluate(
        "node => { const { touchAction, userSelect } = getComputedStyle(node); return [touchAction, userSelect]; }"
    )
    assert style == ["manipulation", "none"]
    assert not tile.locator("img").evaluate("image => image.draggable")
    kept = tile.locator(".face").evaluate(
        "node => node.dispatchEvent(new MouseEvent('contextmenu', { bubbles: true, cancelable: true }))"
    )
    assert kept is False


def test_marking_an_unselected_face_selects_it(evolving):
    page = evolving.page
    page.locator("#select-6").focus()
    page.keyboard.press("b")
    assert evolving.status() == "Selected 1 · best chosen"
    assert evolving.tile(5).locator(".best").is_checked()


def test_letters_work_in_the_grid_only(evolving):
    page = evolving.page
    evolving.choose(1, 2)
    page.locator("#next").focus()
    for key in ("b", "z"):
        page.keyboard.press(key)
    assert evolving.status() == "Selected 2 · mark the closest"
    assert page.locator("#enlarged[open]").count() == 0


def test_undo_stays_within_its_generation(evolving):
    evolving.choose(1).next().wait_generation("Generation 1 of")
    evolving.page.keyboard.press("Control+z")
    assert evolving.generation() == "Generation 1 of 2"
    assert evolving.status() == "Nothing selected yet"


def test_the_enlarged_face_by_keys(evolving):
    page = evolving.page
    page.locator("#select-10").focus()
    page.keyboard.press("z")
    page.wait_for_selector("#enlarged[open]")
    assert page.locator("#enlarged-place").inner_text() == "Face 10 of 10"
    assert page.locator("#enlarged-next").get_attribute("aria-disabled") == "true"
    page.keyboard.press("ArrowLeft")
    page.keyboard.press("b")
    assert page.locator("#enlarged-best").get_attribute("aria-pressed") == "true"
    page.keyboard.press("z")
    page.wait_for_selector("#select-9:focus")
    assert evolving.status() == "Selected 1 · best chosen"


def test_faces_never_change_their_look(evolving):
    """No scaling, dimming, brightening or fading: at rest, under the pointer, selected, best."""
    tile = evolving.tile(2)
    look = """node => { const { transform, filter, opacity, transitionDuration, animationName } =
        getComputedStyle(node);
      const { width, height, x, y } = node.getBoundingClientRect();
      return { transform, filter, opacity, transitionDuration, animationName, width, height, x, y }; }"""
    image = tile.locator("img")
    evolving.page.mouse.move(5, 5)
    rest = image.evaluate(look)
    assert (rest["transform"], rest["filter"], rest["opacity"]) == ("none", "none", "1")
    tile.hover()
    assert image.evaluate(look) == rest
    evolving.choose(2)
    evolving.choose(best=2)
    assert image.evaluate(look) == rest


def touch(page):
    session = page.context.new_cdp_session(page)
    return lambda kind, *points: session.send(
        "Input.dispatchTouchEvent", {"type": kind, "touchPoints": [{"x": x, "y": y} for x, y in points]}
    )


def test_moving_cancels_a_hold(stage, phone):
    page = phone.begin(stage.link("small")).page
    finger = touch(page)
    x, y = middle(phone, 0)

    def move():
        finger("touchStart", (x, y))
        finger("touchMove", (x + 14, y))

    def let_go():
        finger("touchEnd")
        page.keyboard.press("Escape")
        page.locator("#enlarged[open]").wait_for(state="detached")

    quickly(page, move, ["pointerdown", "pointermove"], HOLD, let_go)
    page.wait_for_timeout(600)
    finger("touchEnd")
    assert page.locator("#enlarged[open]").count() == 0


def test_double_tap_marks(stage, phone):
    page = phone.begin(stage.link("small")).page
    phone.tile(0).locator(".face").tap()
    phone.tile(3).locator(".face").tap()
    place = middle(phone, 0)

    def double_tap():
        apart(page)
        for _ in range(2):
            page.touchscreen.tap(*place)

    # Two slow taps take the face back and choose it again.
    quickly(page, double_tap, ["click"], DOUBLE, lambda: None)
    assert phone.status() == "Selected 2 · best chosen"
    assert phone.tile(0).locator(".best").is_checked()


def test_all_ten_must_have_been_in_view_on_a_phone(stage, phone):
    page = phone.begin(stage.link("asking")).page
    phone.tile(0).locator(".face").tap()
    for _ in range(8):
        if "See all ten faces" not in page.locator("#next").inner_text():
            break
        before = page.evaluate("scrollY")
        page.locator("#next").tap()
        page.wait_for_function("before => scrollY > before", arg=before)
        page.wait_for_timeout(500)
    assert "Next faces" in page.locator("#next").inner_text()
    last, dock = phone.tile(9).bounding_box(), page.locator(".footer").bounding_box()
    assert last["y"] + 0.75 * last["height"] <= dock["y"] + 1, "the dock does not cover what counts as seen"
    page.locator("#next").tap()
    phone.wait_generation("Generation 1 of")
    assert "See all ten faces" in page.locator("#next").inner_text()
