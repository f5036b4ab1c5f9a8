"""The study editor in a browser: what is unsaved is seen, nothing typed is lost, the portrait follows the sliders."""

from __future__ import annotations

import json
import re

import pytest

from tests.browser.desk import ACCOUNT
from tests.browser.stage import BLOCKS, running
from tests.browser.test_accessibility import must_be_accessible

pytestmark = pytest.mark.browser
SECONDS = 30_000
STUDIES = {"first": {}, "second": {}, "third": {}, "fourth": {}, "blocks": {"blocks": BLOCKS}}


@pytest.fixture(scope="module")
def desk(tmp_path_factory):
    """A server of its own: its owner's account can be made only once."""
    with running(tmp_path_factory.mktemp("editor"), STUDIES) as stage:
        yield stage


@pytest.fixture(scope="module")
def session(desk, browser):
    context = browser.new_context()
    page = context.new_page()
    page.goto(desk.setup)
    for label, value in ACCOUNT.items():
        page.get_by_label(label).fill(value)
    page.get_by_role("button", name="Create the account").click()
    page.wait_for_url("**/admin/studies")
    cookies = context.cookies()
    context.close()
    return cookies


@pytest.fixture
def enter(desk, browser, session):
    """Opens the editor of a study in a window of its own."""
    contexts, problems = [], []

    def open_(study, width=1440, **options):
        context = browser.new_context(viewport={"width": width, "height": 1000}, **options)
        contexts.append(context)
        context.add_cookies(session)
        page = context.new_page()
        page.on("pageerror", lambda error: problems.append(str(error)))
        page.goto(address(desk, study))
        return page

    yield open_
    for context in contexts:
        context.close()
    assert problems == []


def address(desk, study):
    return f"{desk.address}/admin/studies/{study_id(desk, study)}/design"


def study_id(desk, study):
    return desk.one("SELECT study_id FROM links WHERE id = ?", desk.links[study])


def newest(desk, study):
    sql = "SELECT number, config FROM study_versions WHERE study_id = ? ORDER BY number DESC LIMIT 1"
    ((number, config),) = desk.rows(sql, study_id(desk, study))
    return number, json.loads(config)


def dots(page):
    return page.locator("label:visible, legend:visible").filter(has=page.locator(".dot:not([hidden])")).count()


def unsaved(page, words):
    page.locator("#count", has_text=re.compile(f"^{words}$")).wait_for(timeout=SECONDS)


def section(page, title):
    return page.get_by_role("navigation", name="Sections of the form").get_by_role("link", name=title)


def test_a_change_is_seen_and_saved_as_the_next_version(desk, enter):
    page = enter("first")
    assert page.locator("#unsaved").is_hidden()
    assert dots(page) == 0
    page.locator("#f-generations").fill("7")
    unsaved(page, "1 unsaved change")
    assert dots(page) == 1
    assert section(page, "Emotions and rounds").locator(".dot").is_visible()
    page.locator("#f-generations").fill("10")
    assert page.locator("#unsaved").is_hidden()
    page.locator("#f-generations").fill("7")
    page.get_by_label("Dark").check(force=True)
    unsaved(page, "2 unsaved changes")
    page.get_by_role("button", name="See changes").last.click()
    page.get_by_role("heading", name="What you changed").wait_for()
    must_be_accessible(page)
    page.get_by_role("button", name="Back to the form").click()
    unsaved(page, "2 unsaved changes")
    page.get_by_role("button", name="Save as version 2").click()
    page.get_by_text("Version 2 is saved.").wait_for()
    number, config = newest(desk, "first")
    assert (number, config["generations"], config["surround"]) == (2, 7, "dark")
    page.get_by_role("link", name="All versions").click()
    must_be_accessible(page)


def test_rows_come_without_a_reload_and_without_script(desk, enter):
    page = enter("second")
    page.evaluate("window.kept = true")
    page.locator("#f-title").fill("Five emotions")
    page.get_by_role("button", name="Add emotion").click()
    page.locator("#f-emotions-4-adjective").wait_for(timeout=SECONDS)
    assert page.evaluate("window.kept && document.activeElement.id") == "f-emotions-4-adjective"
    page.keyboard.type("bored")
    page.keyboard.press("Tab")
    page.keyboard.type("boredom")
    unsaved(page, "2 unsaved changes")
    page.get_by_role("button", name="Move emotion 5 up").click()
    page.locator("#f-emotions .row-line").nth(3).locator("#f-emotions-4-noun").wait_for(timeout=SECONDS)
    page.get_by_role("button", name="Remove emotion 1").click()
    page.locator("#f-emotions-0-adjective").wait_for(state="detached", timeout=SECONDS)
    assert page.locator("#f-title").input_value() == "Five emotions"
    page.get_by_role("button", name="Save as version 2").click()
    page.get_by_text("Version 2 is saved.").wait_for()
    plain = enter("second", java_script_enabled=False)
    plain.locator("#f-title").fill("Without script")
    plain.get_by_role("button", name="Add emotion").click()
    assert plain.locator("#f-title").input_value() == "Without script"
    plain.locator("#f-emotions-4-adjective").fill("proud")
    plain.locator("#f-emotions-4-noun").fill("pride")
    plain.get_by_role("button", name="Save as version 3").click()
    plain.get_by_text("Version 3 is saved.").wait_for()
    number, config = newest(desk, "second")
    assert (number, config["title"]) == (3, "Without script")
    assert [one["adjective"] for one in config["emotions"]] == ["sad", "angry", "bored", "fearful", "proud"]


def test_an_error_keeps_everything_and_leads_to_the_field(desk, enter):
    page = enter("third")
    page.locator("#f-generations").fill("100")
    page.locator("#f-title").fill("Kept")
    page.get_by_role("button", name="Save as version 2").click()
    page.locator("#summary").wait_for()
    assert page.title().startswith("Error: ")
    page.wait_for_function("document.activeElement.id === 'summary'")
    link = page.get_by_role("link", name="Emotions and rounds: enter a number of generations from 1 to 30")
    assert page.locator("#f-generations-wrong").inner_text().endswith("Enter a number of generations from 1 to 30")
    assert (page.locator("#f-generations").input_value(), page.locator("#f-title").input_value()) == ("100", "Kept")
    must_be_accessible(page)
    link.click()
    assert page.evaluate("document.activeElement.id") == "f-generations"
    assert newest(desk, "third")[0] == 1


def test_leaving_with_something_unsaved_asks_once(desk, enter):
    page = enter("third")
    asked = []
    page.on("dialog", lambda dialog: (asked.append(dialog.type), dialog.dismiss()))
    page.locator("#f-title").click()
    page.keyboard.type("Unsaved ")
    page.get_by_role("link", name="Recruit", exact=True).click()
    page.wait_for_function("performance.now() > 0")
    assert asked == ["beforeunload"]
    assert "Unsaved" in page.locator("#f-title").input_value()
    page.get_by_role("link", name="Discard").click()
    page.wait_for_load_state()
    assert asked == ["beforeunload"]
    assert "Unsaved" not in page.locator("#f-title").input_value()


def drawn(page):
    page.locator("#status", has_text=re.compile(r"^drawn in \d+ ms$")).wait_for(timeout=SECONDS)
    return page.locator("#portrait").get_attribute("src")


def test_the_portrait_follows_the_sliders(desk, enter):
    page = enter("fourth")
    drawn(page)
    page.get_by_role("button", name="Adjust this face").click()
    age = page.locator("#p-identities-0-head-age")
    age.wait_for(timeout=SECONDS)
    before = drawn(page)
    unsaved(page, "1 unsaved change")
    for years in range(30, 61, 5):
        age.fill(str(years))
    page.wait_for_function("before => document.querySelector('#portrait').src !== before", arg=before, timeout=SECONDS)
    assert page.locator("#portrait").evaluate("image => image.naturalWidth") == 400
    assert page.locator(".control", has=age).locator(".typed").input_value() == "60"
    page.get_by_role("radio", name="Identity B").check(force=True)
    page.locator("#letter", has_text="B").wait_for()
    assert page.get_by_role("button", name="Adjust this face").is_visible()
    page.get_by_role("button", name="Save as version 2").click()
    page.get_by_text("Version 2 is saved.").wait_for()
    head, other = newest(desk, "fourth")[1]["identities"]
    assert (head["head"]["age"], other) == (60, "male")


def test_by_keyboard_alone(desk, enter):
    page = enter("third")
    page.locator("#f-generations").focus()
    page.keyboard.press("Control+A")
    page.keyboard.type("4")
    page.keyboard.press("Enter")
    page.get_by_role("heading", name="What you changed").wait_for()
    page.get_by_role("button", name="Save as version 2").focus()
    page.keyboard.press("Enter")
    page.get_by_text("Version 2 is saved.").wait_for()
    assert newest(desk, "third")[1]["generations"] == 4


@pytest.mark.parametrize("width", [1440, 1280, 360])
def test_it_fits_and_axe_has_no_complaint(desk, enter, width):
    page = enter("blocks", width)
    for details in page.locator("details.more:visible > summary").all():
        details.click()
    must_be_accessible(page)
    assert page.evaluate("document.documentElement.scrollWidth") <= width
    for path in ("new", "import"):
        page.goto(f"{desk.address}/admin/studies/{path}")
        must_be_accessible(page)
        assert page.evaluate("document.documentElement.scrollWidth") <= width
    page.get_by_label("Or its text").fill("title: X\ngenerations: 99\nemotions: []")
    page.get_by_role("button", name="Import as a draft").click()
    page.get_by_role("heading", name="Everything that is wrong").wait_for()
    must_be_accessible(page)
