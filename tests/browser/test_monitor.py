"""The monitor while somebody looks at it: numbers change in place, what a person does stays; the list of studies."""

from __future__ import annotations

import re

import httpx2
import pytest

from server.services.clock import now
from server.services.house import build_house
from server.settings import Settings
from tests.browser.desk import ACCOUNT
from tests.browser.populated import populate, study_for
from tests.browser.test_accessibility import must_be_accessible
from tests.conftest import FakeDrawer, FakeTailor
from tests.rig_factory import small_rig
from tests.server.inside import serving
from tests.server.walker import Walker

pytestmark = pytest.mark.browser
SECONDS = 20_000


@pytest.fixture(scope="module")
def place(tmp_path_factory):
    """A server in this process with a day of people that ends now."""
    rig = small_rig()
    house = build_house(Settings(data_dir=tmp_path_factory.mktemp("day")), rig, FakeDrawer(rig), FakeTailor(rig))
    try:
        day = populate(house, now(), people=30, config=study_for(rig, generations=1), events=False)
        key = house.accounts.new_setup_key()
        secret = house.accounts.set_up(key, "Ines Marchetti", "i@example.org", ACCOUNT["Password"])
        with serving(house) as address:
            yield address, day, secret
    finally:
        house.close()


@pytest.fixture
def desk(place, browser):
    address, _, secret = place
    context = browser.new_context(viewport={"width": 1440, "height": 1000})
    context.add_cookies([{"name": "emogen_session", "value": secret, "url": f"{address}/admin"}])
    page, problems = context.new_page(), []
    page.set_default_timeout(SECONDS)
    page.on("pageerror", lambda error: problems.append(str(error)))
    yield page
    context.close()
    assert problems == []


@pytest.fixture
def monitor(place, desk):
    address, day, _ = place
    desk.goto(f"{address}/admin/studies/{day.study}/monitor")
    desk.locator("#live", has_text="Live").wait_for()
    return desk


def here(page):
    return page.locator("[data-part=figures] dd").first


def becomes(page, count):
    page.wait_for_function("n => document.querySelector('[data-part=figures] dd').innerText === n", arg=str(count))


def arrive(place):
    address, day, _ = place
    with httpx2.Client(base_url=address) as client:
        return Walker(client, day.link).start()


def test_a_new_person_is_seen_without_a_reload(place, monitor):
    before = int(here(monitor).inner_text())
    monitor.evaluate("window.same = true")
    monitor.locator("summary", has_text="Arrivals").click()
    link = monitor.locator("[data-part=people] a.code").first
    name = link.inner_text()
    link.focus()
    arrive(place)
    becomes(monitor, before + 1)
    assert monitor.evaluate("window.same")
    assert monitor.evaluate("document.activeElement.innerText") == name, "focus stays with the person, who moved down"
    assert monitor.locator("[data-part=people] a.code").nth(1).inner_text() == name
    assert monitor.locator("[data-part=arrivals] details").get_attribute("open") is not None
    assert monitor.locator("[data-part=where] h2").inner_text() == f"Where the {before + 1} are now"
    assert monitor.locator("[aria-live], [role=alert]").count() == 0, "nothing is read aloud"


def test_nothing_that_stays_the_same_is_touched(monitor):
    monitor.evaluate("""() => {
        window.touched = [];
        const parts = document.querySelector("#parts");
        new MutationObserver((changes) => {
            for (const one of changes) {
                const node = one.target.nodeType === Node.TEXT_NODE ? one.target.parentElement : one.target;
                if (!node.closest("time")) window.touched.push(node.outerHTML.slice(0, 200));
            }
        }).observe(parts, { subtree: true, childList: true, characterData: true, attributes: true });
    }""")
    stamp = monitor.locator("#moment").get_attribute("datetime")
    monitor.wait_for_function("old => document.querySelector('#moment').dateTime !== old", arg=stamp)
    assert monitor.evaluate("window.touched") == []


def test_paused_updates_wait(place, monitor):
    monitor.get_by_role("button", name="Pause updates").click()
    monitor.locator("#live", has_text="Paused").wait_for()
    before = here(monitor).inner_text()
    arrive(place)
    monitor.wait_for_function("() => document.querySelector('#age').innerText.startsWith('5 seconds')")
    assert here(monitor).inner_text() == before
    monitor.get_by_role("button", name="Resume updates").click()
    becomes(monitor, int(before) + 1)


def test_a_hidden_page_watches_nothing(place, monitor):
    count = "performance.getEntriesByType('resource').filter(one => one.name.includes('/stream')).length"
    hide = """value => {
        Object.defineProperty(document, "hidden", { value, configurable: true });
        document.dispatchEvent(new Event("visibilitychange"));
    }"""
    monitor.evaluate(hide, True)
    monitor.wait_for_function(f"() => {count} === 1")
    assert monitor.evaluate("document.hidden")
    stamp = monitor.locator("#moment").get_attribute("datetime")
    monitor.evaluate(hide, False)
    monitor.wait_for_function("old => document.querySelector('#moment').dateTime !== old", arg=stamp)
    # A stream counts when it ends: one before, and one after.
    monitor.evaluate(hide, True)
    monitor.wait_for_function(f"() => {count} === 2")


def test_without_script_the_page_has_a_way_to_reload(place, browser):
    address, day, secret = place
    context = browser.new_context(java_script_enabled=False)
    context.add_cookies([{"name": "emogen_session", "value": secret, "url": f"{address}/admin"}])
    page = context.new_page()
    page.goto(f"{address}/admin/studies/{day.study}/monitor?range=all")
    assert page.locator("#live").is_hidden() and page.locator("#pause").is_hidden()
    before = here(page).inner_text()
    arrive(place)
    page.get_by_role("link", name="Reload").click()
    assert here(page).inner_text() == str(int(before) + 1)
    assert "range=all" in page.url
    context.close()


def test_simulated_participants_come_to_their_end_before_ones_eyes(place, desk):
    address, day, _ = place
    desk.goto(f"{address}/admin/studies/{day.study}/monitor?who=simulated")
    desk.get_by_label("How many").fill("2")
    desk.get_by_role("button", name="Send simulated participants").click()
    desk.locator("[data-part=sent]", has_text="2 of 2 came to their end").wait_for()
    desk.wait_for_function("() => document.querySelectorAll('[data-part=figures] dd')[2].innerText.startsWith('2')")
    assert desk.locator(".empty").count() == 0


@pytest.mark.parametrize("width", [1440, 360])
def test_axe(place, monitor, width):
    address, _, _ = place
    monitor.set_viewport_size({"width": width, "height": 900})
    for summary in monitor.locator("main summary").all():
        summary.click()
    must_be_accessible(monitor)
    assert monitor.evaluate("document.documentElement.scrollWidth") <= width
    monitor.goto(f"{address}/admin/studies")
    must_be_accessible(monitor)
    monitor.locator("main .menu summary").first.click()
    must_be_accessible(monitor)
    assert monitor.evaluate("document.documentElement.scrollWidth") <= width


def test_charts_stay_apart_in_grey_and_print(monitor):
    monitor.emulate_media(media="print")
    assert monitor.locator("#watch").is_hidden() and monitor.locator(".chart").first.is_visible()
    styles = monitor.evaluate("""() => ["s1", "s2", "s3", "s4"].map((look) => {
        const path = document.createElementNS("http://www.w3.org/2000/svg", "path");
        path.setAttribute("class", `line ${look}`);
        document.querySelector(".chart").append(path);
        return getComputedStyle(path).strokeDasharray;
    })""")
    assert len(set(styles)) == 4
    assert re.search(r"\d+ %", monitor.locator("[data-part=kept] .name").first.text_content())


def test_signed_out_is_said(monitor):
    monitor.context.clear_cookies()
    monitor.get_by_role("button", name="Pause updates").click()
    monitor.get_by_role("button", name="Resume updates").click()
    monitor.locator("#live", has_text=re.compile("Reconnecting|signed out")).wait_for()
    assert here(monitor).is_visible()
