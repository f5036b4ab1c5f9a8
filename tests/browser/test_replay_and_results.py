"""Participants, replay and results in a browser: with a day's data, with and without script, on a phone, on paper."""

from __future__ import annotations

import re
import zipfile

import pytest

from server.services.clock import now
from server.services.opening import open_house
from server.settings import Settings
from tests.browser.conditions import TWO_FRAMES
from tests.browser.desk import ACCOUNT
from tests.browser.populated import populate, study_for
from tests.browser.stage import running
from tests.browser.test_accessibility import must_be_accessible

pytestmark = pytest.mark.browser
DRAWN = "where => [...document.querySelectorAll(where)].every(image => image.complete && image.naturalWidth > 100)"


@pytest.fixture(scope="module")
def filled(tmp_path_factory):
    """A server with a study that people took part in."""
    folder = tmp_path_factory.mktemp("filled")
    house = open_house(Settings(data_dir=folder), drawing=False)
    try:
        day = populate(house, now(), people=24, config=study_for(house.journal.rig, generations=2))
    finally:
        house.close()
    with running(folder, {}) as stage:
        yield stage, f"{stage.address}/admin/studies/{day.study}"


@pytest.fixture(scope="module")
def cookies(filled, browser):
    context = browser.new_context()
    page = context.new_page()
    page.goto(filled[0].setup)
    for label, value in ACCOUNT.items():
        page.get_by_label(label).fill(value)
    page.get_by_role("button", name="Create the account").click()
    page.wait_for_url("**/admin/studies")
    found = context.cookies()
    context.close()
    return found


@pytest.fixture
def open_page(browser, cookies):
    opened, problems = [], []

    def make(address, **options):
        context = browser.new_context(**{"viewport": {"width": 1440, "height": 1000}, **options})
        context.add_cookies(cookies)
        page = context.new_page()
        page.set_default_timeout(60_000)
        page.on("pageerror", lambda error: problems.append(str(error)))
        page.on("console", lambda told: problems.append(told.text) if told.type == "error" else None)
        opened.append(context)
        page.goto(address)
        return page

    yield make
    for context in opened:
        context.close()
    assert problems == []


@pytest.fixture(scope="module")
def number(filled):
    stage, _ = filled
    return stage.one("SELECT MIN(number) FROM participations WHERE outcome = 'complete'")


def seconds(page):
    return float(page.locator(".track input").input_value())


def test_the_playhead_moves_and_marks_follow(filled, open_page, number):
    page = open_page(f"{filled[1]}/participants/{number}")
    recorded = (
        page.locator("tr[data-seconds]")
        .first.locator("td[data-place]")
        .evaluate_all("cells => cells.map(cell => cell.className)")
    )
    assert page.locator("tr.now").count() == 0
    page.get_by_text("16×").click()
    page.get_by_role("button", name="Play", exact=True).click()
    page.wait_for_function("() => Number(document.querySelector('.track input').value) > 0.5")
    assert page.locator("tr.now").count() == 1
    page.get_by_role("button", name="Pause", exact=True).click()
    stopped = seconds(page)
    for _ in range(3):
        page.evaluate(TWO_FRAMES)
        assert seconds(page) == stopped
    page.locator(".track input").evaluate("input => { input.value = 0.01; input.dispatchEvent(new Event('input')) }")
    first = page.locator("tr[data-seconds]").first
    assert first.get_attribute("aria-current") == "step"
    assert first.locator("td.best, td.chosen").count() == 0, "nothing was chosen yet"
    page.get_by_role("button", name="Next generation").click()
    assert page.locator("tr.now th").inner_text().startswith("1")
    now_there = first.locator("td[data-place]").evaluate_all("cells => cells.map(cell => cell.className)")
    assert now_there == recorded, "what was recorded stands again when the playhead has left"
    page.get_by_role("button", name="Previous generation").click()
    page.keyboard.press("Tab")
    assert first.locator("td.best").count() == 1
    page.get_by_role("button", name="Play", exact=True).click()
    page.wait_for_function(
        "() => document.querySelector('.track input').value >= document.querySelector('.track input').max - 0.2"
    )
    page.get_by_role("button", name="Play", exact=True).wait_for()


def test_the_playhead_by_keyboard(filled, open_page, number):
    page = open_page(f"{filled[1]}/participants/{number}")
    page.locator(".track input").focus()
    page.keyboard.press("End")
    assert page.locator("tr.now th").inner_text().startswith("2")
    page.keyboard.press("Home")
    assert page.locator("tr.now th").inner_text().startswith("0")
    assert re.match(r"0:00 of \d+:\d\d", page.locator(".track input").get_attribute("aria-valuetext"))


def test_without_script_every_row_is_there(filled, open_page, number):
    page = open_page(f"{filled[1]}/participants/{number}", java_script_enabled=False)
    assert page.locator(".player").is_hidden()
    rows = page.locator("tr[data-seconds]")
    assert rows.count() == 3
    for index in range(3):
        assert rows.nth(index).is_visible()
        assert rows.nth(index).locator("td.best").count() == 1
        assert rows.nth(index).locator("img").count() == 10


def test_portraits_appear(filled, open_page, number):
    page = open_page(f"{filled[1]}/participants/{number}")
    page.locator("tr[data-seconds]").last.scroll_into_view_if_needed()
    page.wait_for_function(DRAWN, arg="tr[data-seconds] img")
    shown = page.locator("tr[data-seconds] img").evaluate_all("images => images.map(image => image.src)")
    assert len(shown) % 10 == 0 and len(set(shown)) > 10


@pytest.mark.parametrize("size", [{"width": 1440, "height": 1000}, {"width": 360, "height": 800}])
def test_pages_are_accessible_and_fit(filled, open_page, number, size):
    stage, base = filled
    tabs = stage.rows(
        "SELECT position FROM trials WHERE kind = 'evolve' AND participation_id = (SELECT id FROM participations"
        " WHERE number = ?) ORDER BY position",
        number,
    )
    erased = stage.one("SELECT number FROM participations WHERE outcome = 'erased'")
    paths = (
        "/participants", f"/participants/{number}", f"/participants/{number}?trial={tabs[0][0]}&check=1",
        f"/participants/{number}/erase", f"/participants/{erased}", "/results", "/results?who=simulated",
    )  # fmt: skip
    page = open_page(f"{base}{paths[0]}", viewport=size)
    for path in paths:
        page.goto(f"{base}{path}")
        for summary in page.locator(".numbers > summary").all():
            summary.click()
        must_be_accessible(page)
        assert page.evaluate("document.documentElement.scrollWidth") <= size["width"], path
    page.goto(f"{stage.address}/admin/find?q=P-0001")
    must_be_accessible(page)


def test_results_show_faces_and_wait_for_the_noise(filled, open_page):
    page = open_page(f"{filled[1]}/results")
    page.wait_for_function(DRAWN, arg=".faces img")
    assert page.locator(".panels figure").count() == 4
    assert page.locator("svg.map image").count() == 4
    computed = "async () => !(await (await fetch(location.href)).text()).includes('is being computed')"
    page.wait_for_function(computed, polling=500)
    page.reload()
    assert page.locator(".panels path.noise").count() == 4


def test_results_on_paper(filled, open_page):
    page = open_page(f"{filled[1]}/results", viewport={"width": 720, "height": 1000})
    page.emulate_media(media="print")
    for hidden in (".bar", ".tabs", ".filters", ".title .actions", ".crumbs"):
        assert page.locator(hidden).first.is_hidden(), hidden
    assert "fingerprint" in page.locator(".printed").inner_text()
    places = [figure.bounding_box() for figure in page.locator(".panels figure").all()]
    assert places[0]["y"] == places[1]["y"] < places[2]["y"], "two charts a row"
    assert page.pdf(prefer_css_page_size=True).startswith(b"%PDF")


def test_slash_goes_to_the_search_field(filled, open_page):
    page = open_page(f"{filled[1]}/participants")
    page.keyboard.press("/")
    assert page.evaluate("document.activeElement.id") == "find"
    page.keyboard.type("P-0001/")
    assert page.locator("#find").input_value() == "P-0001/"
    page.locator("#find").fill("P-0001")
    page.keyboard.press("Enter")
    page.wait_for_url("**/admin/find?q=P-0001")
    page.get_by_role("link", name="P-0001").click()
    page.get_by_role("heading", name="Participant P-0001").wait_for()


def test_the_report_is_made_behind_the_page_and_opens_in_a_tab(filled, open_page):
    page = open_page(f"{filled[1]}/results")
    must_be_accessible(page)
    page.get_by_role("button", name="Make the report").click()
    standing = page.locator("#analysis .standing")
    standing.get_by_text("Being made since").wait_for()
    # The page asks again by itself; nobody reloads it.
    standing.get_by_text(re.compile(r"Made .* participants\.")).wait_for(timeout=180_000)
    must_be_accessible(page)
    assert page.get_by_role("button", name="Make it again").is_visible()
    with page.context.expect_page() as opened:
        page.get_by_role("link", name="Open the report").click()
    report = opened.value
    report.get_by_role("heading", name="Do people mean different faces?").wait_for()
    assert report.evaluate(DRAWN, "img")
    assert report.locator("img").count() > 0
    report.get_by_role("link", name="Methods, for a paper").click()
    report.get_by_text("Analysed with Emogen").wait_for()
    with page.expect_download() as loaded:
        page.get_by_role("link", name="All tables and the report (zip)").click()
    with zipfile.ZipFile(loaded.value.path()) as files:
        assert {"report.html", "methods.txt", "about.json", "within.csv"} <= set(files.namelist())
