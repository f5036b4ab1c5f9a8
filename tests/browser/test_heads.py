"""The heads page in a browser: the portrait follows the sliders, by mouse and by keyboard, and axe has no complaint."""

from __future__ import annotations

import json
import re

import pytest

from tests.browser.desk import ACCOUNT
from tests.browser.stage import running
from tests.browser.test_accessibility import must_be_accessible

pytestmark = pytest.mark.browser
SECONDS = 60_000


@pytest.fixture(scope="module")
def desk(tmp_path_factory):
    """A server of its own: its owner's account can be made only once."""
    with running(tmp_path_factory.mktemp("heads"), {"small": {}}) as stage:
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
def page(desk, browser, session):
    context = browser.new_context(viewport={"width": 1440, "height": 1000})
    context.add_cookies(session)
    context.set_default_timeout(SECONDS)
    page, problems = context.new_page(), []
    page.on("pageerror", lambda error: problems.append(str(error)))
    page.goto(f"{desk.address}/admin/heads")
    yield page
    context.close()
    assert problems == []


def drawn(page):
    page.locator("#status", has_text=re.compile("^Drawn in")).wait_for(timeout=SECONDS)
    return page.locator("#portrait").get_attribute("src")


def said(page, words):
    page.locator("#status.wrong", has_text=words).wait_for(timeout=SECONDS)
    return page.locator("#status").inner_text()


def digest(page):
    return page.locator("#digest").inner_text()


def test_the_portrait_and_the_hash_follow_the_sliders(page):
    before, fingerprint = page.locator("#portrait").get_attribute("src"), digest(page)
    page.locator("#p-age").fill("60")
    after = drawn(page)
    assert after.startswith("blob:") and after != before
    assert digest(page) != fingerprint
    assert page.locator(".control", has=page.locator("#p-age")).locator(".typed").input_value() == "60"
    page.get_by_role("button", name="Reset age").click()
    assert page.locator("#p-age").input_value() == "25"
    page.locator("#digest", has_text=fingerprint).wait_for(timeout=SECONDS)


def test_only_the_last_of_many_changes_is_shown(page):
    shown = []
    page.on("response", lambda reply: shown.append(reply.status) if reply.url.endswith("/preview") else None)
    for years in range(30, 50):
        page.locator("#p-age").fill(str(years))
    drawn(page)
    assert shown.count(200) == 1
    with page.expect_download() as download:
        page.get_by_role("button", name="Download document").click()
    document = json.loads(download.value.path().read_text())
    assert document["head"]["age"] == 49
    assert document["hash"].startswith(digest(page))


def test_by_keyboard_alone(page):
    page.locator("#p-sex").focus()
    page.keyboard.press("ArrowRight")
    assert float(page.locator("#p-sex").input_value()) == pytest.approx(0.01)
    page.keyboard.press("Tab")
    page.keyboard.type("0.5")
    assert page.locator("#p-sex").input_value() == "0.5"
    drawn(page)
    page.locator("#e-neutral").focus()
    page.keyboard.press("ArrowRight")
    assert page.locator("#e-happy").is_checked()
    page.locator("#status", has_text="Drawing").wait_for(timeout=SECONDS)
    drawn(page)
    page.locator("summary", has_text="Nose").focus()
    page.keyboard.press("Enter")
    assert page.locator("#p-nose-width").is_visible()


def test_the_look_follows_the_sliders_until_somebody_paints(page):
    own, depth = page.locator("#own_look"), page.locator("#p-look-skin_depth")
    young = depth.input_value()
    assert not own.is_checked()
    page.locator("#p-african").fill("1")
    drawn(page)
    assert float(depth.input_value()) > float(young)
    assert not page.locator(".control", has=depth).locator(".reset").is_visible()
    depth.fill("0.05")
    assert own.is_checked(), "whoever paints wants to see it"
    page.locator("#status", has_text="Drawing").wait_for(timeout=SECONDS)
    drawn(page)
    own.uncheck()
    page.locator("#status", has_text="Drawing").wait_for(timeout=SECONDS)
    drawn(page)
    assert float(depth.input_value()) > float(young)
    own.check()
    assert depth.input_value() == "0.05", "what was painted is not lost"


def test_a_number_typed_beside_a_slider_paints_too(page):
    depth = page.locator("#p-look-skin_depth")
    page.locator(".control", has=depth).locator(".typed").fill("0.4")
    assert page.locator("#own_look").is_checked()
    drawn(page)
    assert depth.input_value() == "0.4"


def test_enter_previews_and_a_name_is_in_the_fingerprint(page):
    downloads, before = [], digest(page)
    page.on("download", lambda download: downloads.append(download))  # noqa: PLW0108 - playwright marks it
    page.locator("#name").fill("Somebody else")
    page.keyboard.press("Enter")
    drawn(page)
    assert downloads == [] and page.url.endswith("/admin/heads")
    after = digest(page)
    assert after != before
    page.locator("#name").fill("A third")
    page.keyboard.press("Tab")
    page.locator("#status", has_text="Drawing").wait_for(timeout=SECONDS)
    drawn(page)
    assert digest(page) not in {before, after}


def test_a_number_that_does_not_fit_is_said(page):
    control = page.locator(".control", has=page.locator("#p-age"))
    control.locator(".typed").fill("95")
    page.keyboard.press("Tab")
    assert said(page, "Age") == "Age, number: expected 10 to 90."
    assert control.locator(".typed").get_attribute("aria-invalid") == "true"
    assert page.locator("#p-age").input_value() == "25"
    control.locator(".typed").fill("60")
    assert control.locator(".typed").get_attribute("aria-invalid") is None
    assert page.locator("#p-age").input_value() == "60"


def test_colours_mix_and_amounts_are_told(page):
    page.locator("summary", has_text="Eyes, lashes").click()
    page.locator("#p-look-iris_colour").fill("#3060a0")
    assert page.locator("#own_look").is_checked()
    page.locator("#p-african").fill("1")
    page.locator("#p-asian").fill("1")
    page.locator("#p-caucasian").fill("0")
    assert page.locator("#shares").inner_text() == "african 50 %, asian 50 %, caucasian 0 %"
    drawn(page)
    page.locator("#p-african").fill("0")
    page.locator("#p-asian").fill("0")
    page.locator("#status.wrong", has_text="ancestry: expected at least one amount above 0").wait_for(timeout=SECONDS)
    must_be_accessible(page)


def test_signed_out_and_offline_are_said(page):
    portrait, fingerprint = page.locator("#portrait").get_attribute("src"), digest(page)
    page.context.set_offline(True)
    page.locator("#p-age").fill("31")
    assert said(page, "cannot be reached") == "The server cannot be reached. Change a slider to try again."
    page.context.set_offline(False)
    page.context.clear_cookies()
    page.locator("#p-age").fill("32")
    assert said(page, "signed out") == "You are signed out, or this page is too old. Reload it."
    assert page.get_by_role("status").filter(has_text="signed out").count() == 1, "read aloud as well"
    assert (page.locator("#portrait").get_attribute("src"), digest(page)) == (portrait, fingerprint)
    assert page.locator("#p-age").input_value() == "32", "nothing typed is lost"
    assert not page.locator("#editor.busy").count()


@pytest.mark.parametrize("width", [1440, 390])
def test_axe(page, width):
    page.set_viewport_size({"width": width, "height": 900})
    must_be_accessible(page)
    for summary in page.locator("summary").all():
        summary.click()
    must_be_accessible(page)
    assert page.evaluate("document.documentElement.scrollWidth") <= width


def test_a_preset_to_start_from(page):
    page.get_by_role("link", name="asian-male-old", exact=True).click()
    page.wait_for_url("**from=asian-male-old*")
    assert page.locator("#p-age").input_value() == "90"
    assert page.locator("#p-asian").input_value() == "1"
    assert page.locator("#name").input_value() == "asian-male-old"


def test_without_script(desk, browser, session):
    context = browser.new_context(java_script_enabled=False)
    context.add_cookies(session)
    page = context.new_page()
    page.set_default_timeout(SECONDS)
    page.goto(f"{desk.address}/admin/heads")
    page.locator("#p-age").fill("70")
    page.get_by_role("button", name="Preview").click()
    assert page.locator("#portrait").get_attribute("src").startswith("data:image/png")
    assert page.locator("#p-age").input_value() == "70"
    page.locator("#name").fill("Seventy")
    page.get_by_role("button", name="Create a study with this head").click()
    page.get_by_role("heading", name="Picturing four emotions").wait_for()
    context.close()
