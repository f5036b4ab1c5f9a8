"""Every participant page in every language: one walk each, several things looked at on each page."""

from __future__ import annotations

import pytest

from server.texts.plurals import plural

from . import checks
from .languages import LANGUAGES, STUDIES
from .stage import running
from .walk import Walk

pytestmark = pytest.mark.browser

PAGES = {"entry", "consent", "instructions", "practice", "evolve", "rating", "rate", "categorise", "debrief"}
DIRECTION = {language: "rtl" if language == "ar" else "ltr" for language in LANGUAGES}
EVOLVE = {"practice", "evolve", "evolve-chosen", "evolve-missing"}
JUDGED_BY_AXE = {"en", "de", "zh", "ar"}
"""French and Spanish are laid out as German is."""
TABBED_THROUGH = {"en", "ar"}
FONTS = {"ar": {"noto-sans-arabic.woff2", "inter-latin.woff2"}}


@pytest.fixture(scope="module")
def stage(tmp_path_factory):
    with running(tmp_path_factory.mktemp("languages"), STUDIES) as started:
        yield started


@pytest.fixture
def reader(browser):
    """A page of somebody who asked for less motion; style sheets of the tests are let in."""
    context = browser.new_context(viewport={"width": 1280, "height": 800}, bypass_csp=True, reduced_motion="reduce")
    yield context.new_page()
    context.close()


LONGEST = """() => {
  for (const label of document.querySelectorAll(".progress b")) {
    label.textContent = label.textContent.replace(/[0-9]+/g, "10").replace(/[٠-٩]+/g, "١٠");
  }
}"""


def look_at(page, language, name):
    page.evaluate(LONGEST)
    checks.built(page, language, DIRECTION[language])
    checks.still(page)
    for size in (*checks.NARROW, checks.ZOOMED, checks.DESKTOP):
        checks.fits(page, size)
    if name in EVOLVE:
        for size in (*checks.WIDE, checks.DESKTOP):
            checks.stacks(page, size)
    elif page.locator("main.paper").count():
        checks.holds_spacing(page, checks.NARROW[0])
    checks.resized(page, checks.DESKTOP)
    if language in JUDGED_BY_AXE and (language in TABBED_THROUGH or not name.endswith("-missing")):
        checks.accessible(page)
    if language in TABBED_THROUGH:
        checks.focus_is_seen(page)


@pytest.mark.parametrize("language", LANGUAGES)
def test_every_page(stage, reader, language):
    fonts = set()
    reader.on("request", lambda request: fonts.add(request.url.rsplit("/", 1)[1]) if "/fonts/" in request.url else None)
    seen = []

    def look(name):
        seen.append(name)
        look_at(reader, language, name)

    walk = Walk(reader, look)
    walk.whole(stage.link(language))
    reader.context.clear_cookies()
    walk.declined(stage.link(language))
    reader.context.clear_cookies()
    walk.stopped(stage.link(language))
    reader.goto(stage.link(f"closed-{language}"))
    look("closed")
    assert walk.player.problems == []
    assert {*seen} >= PAGES
    assert fonts == FONTS.get(language, {"inter-latin.woff2"})


def test_words_of_script_are_those_of_the_server(stage, player):
    """The browser chooses the same plural form as the server, for every language."""
    counts = [*range(120), 1_000, 1_000_000]
    choose = "([language, counts]) => counts.map((count) => new Intl.PluralRules(language).select(count))"
    for language in LANGUAGES:
        assert player.page.evaluate(choose, [language, counts]) == [plural(language, count) for count in counts]


class TestRightToLeft:
    @pytest.fixture
    def arabic(self, stage, player):
        walk = Walk(player.page, lambda _: None)
        walk.to_practice(stage.link("ar"))
        return player.faces()

    def test_the_page_is_mirrored_and_faces_are_not(self, arabic):
        page = arabic.page
        left = [tile.bounding_box()["x"] for tile in page.locator(".tile").all()[:5]]
        assert left == sorted(left, reverse=True)
        circle, tile = (page.locator(f".tile {part}").first.bounding_box() for part in (".circle", ".ring"))
        assert circle["x"] > tile["x"] + tile["width"] / 2
        assert page.locator("#next").bounding_box()["x"] < page.locator("#status").bounding_box()["x"]
        turned = page.evaluate("""() => Object.fromEntries(
          ['.next .forward', '.tile img', '.circle .icon', '.strip .icon', '.enlarge .icon', '.arrows .icon'].map(
            (part) => [part, getComputedStyle(document.querySelector(part)).transform]))""")
        assert turned.pop(".next .forward") == "matrix(-1, 0, 0, 1, 0, 0)"
        assert set(turned.values()) == {"none"}
        caps = [cap.bounding_box()["x"] for cap in page.locator(".footer .arrows kbd").all()]
        assert caps == sorted(caps)

    def test_letters_join(self, arabic):
        assert (
            arabic.page.evaluate("""() => [...document.querySelectorAll('body *')].filter((node) => {
            const style = getComputedStyle(node);
            return style.letterSpacing !== 'normal' && style.letterSpacing !== '0px' || style.textTransform !== 'none';
        }).length""")
            == 0
        )

    def test_digits_follow_the_language(self, arabic):
        arabic.choose(0, 1)
        assert "٢" in arabic.status()
        assert not any(digit in arabic.page.locator("body").inner_text() for digit in "0123456789")

    def test_keys_follow_the_eye(self, arabic):
        page = arabic.page
        page.locator("#select-1").focus()
        page.keyboard.press("ArrowLeft")
        assert page.evaluate("document.activeElement.id") == "select-2"
        page.keyboard.press("ArrowDown")
        assert page.evaluate("document.activeElement.id") == "select-7"
        page.keyboard.press("ArrowRight")
        page.keyboard.press("ArrowRight")
        assert page.evaluate("document.activeElement.id") == "select-6"

    def test_letter_keys_work_on_an_arabic_keyboard(self, arabic):
        page = arabic.page
        page.locator("#select-3").focus()
        press(page, "لا", "KeyB")
        assert page.locator("#best-3").is_checked()
        press(page, "ئ", "KeyZ", ctrlKey=True)
        assert not page.locator("#best-3").is_checked()
        press(page, "ئ", "KeyZ")
        page.wait_for_selector("#enlarged[open]")
        press(page, "ئ", "KeyZ")
        assert not page.locator("#enlarged").evaluate("dialog => dialog.open")

    def test_scales_take_digits_of_either_script_and_arrows_follow_the_eye(self, arabic):
        page = arabic.choose(0).page
        page.locator("#next").click()
        page.wait_for_selector(".boxes")
        page.wait_for_load_state()
        points = page.locator(".boxes input")
        points.first.focus()
        press(page, "٥", "Digit5")
        assert points.nth(4).is_checked()
        press(page, "3", "Digit3")
        assert points.nth(2).is_checked()
        page.keyboard.press("ArrowLeft")
        assert points.nth(3).is_checked()


def press(page, key, code, **more):
    """Press a key as a keyboard of another script sends it."""
    page.evaluate(
        "(init) => document.activeElement.dispatchEvent(new KeyboardEvent('keydown', init))",
        {"key": key, "code": code, "bubbles": True, "cancelable": True, **more},
    )
