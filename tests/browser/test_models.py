"""Another face model, through the browser: its files are added, its heads are seen, and a study shows its faces."""

from __future__ import annotations

import json
import time
from dataclasses import replace

import pytest

from emogen_core.face.bundled import load_bundled_rig
from emogen_core.face.modes import ModeSpace, save_modes
from emogen_core.face.rig_file import save_rig
from emogen_core.rendering.look import save_look
from emogen_core.rendering.setup import bundled_look
from tests.browser.desk import ACCOUNT
from tests.browser.stage import running
from tests.browser.test_accessibility import must_be_accessible

pytestmark = pytest.mark.browser
SECONDS = 60_000
SEEN = "() => [...document.querySelectorAll('.sheet img')].every(image => image.complete && image.naturalWidth)"


@pytest.fixture(scope="module")
def lab(tmp_path_factory):
    """The bundled rig with one head, so that its hash is another one, and two modes that lead to others."""
    rig, path = load_bundled_rig(), tmp_path_factory.mktemp("lab") / "lab.rig"
    worn = {name: change for name, change in rig.adjustments.items() if name == "male"}
    lab = save_rig(replace(rig, name="lab", neutrals={"male": rig.neutrals["male"]}, adjustments=worn), path)
    save_look(path.with_suffix(".look"), bundled_look())
    older, wider = (rig.neutrals[name] - rig.neutrals["male"] for name in ("caucasian-male-old", "asian-male-young"))
    save_modes(ModeSpace(lab.hash, {"identity000": older, "identity001": wider}), path.with_suffix(".modes"))
    return path


@pytest.fixture(scope="module")
def desk(tmp_path_factory, browser):
    with running(tmp_path_factory.mktemp("models"), {"small": {}}) as stage:
        context = browser.new_context(viewport={"width": 1440, "height": 1400})
        page, problems = context.new_page(), []
        page.on("pageerror", lambda error: problems.append(str(error)))
        page.set_default_timeout(SECONDS)
        page.goto(stage.setup)
        for label, value in ACCOUNT.items():
            page.get_by_label(label).fill(value)
        page.get_by_role("button", name="Create the account").click()
        page.wait_for_url("**/admin/studies")
        page.goto(f"{stage.address}/admin/models")
        yield page, stage
        context.close()
        assert problems == []


def test_files_are_added_and_heads_are_seen(desk, lab):
    page, _ = desk
    form = page.locator("form", has=page.locator("#add-rig"))
    form.locator("#add-name").fill("lab")
    form.locator("#add-rig").set_input_files(lab)
    form.locator("#add-look").set_input_files(lab.with_suffix(".look"))
    form.locator("#add-modes").set_input_files(lab.with_suffix(".modes"))
    form.get_by_role("button", name="Add").click()
    page.locator("h2", has_text="lab").wait_for()
    page.wait_for_function(SEEN, timeout=SECONDS)
    assert page.locator(".sheet img").count() == 7, "neutral and six emotions"
    must_be_accessible(page)


def test_a_head_is_chosen_for_a_study(desk):
    page, stage = desk
    page.goto(f"{stage.address}/admin/studies/{stage.one('SELECT id FROM studies')}/design")
    before = page.locator("#portrait").get_attribute("src")
    page.locator('input[name$=".preset"][value="lab:male"]').first.check(force=True)
    page.wait_for_function("before => document.querySelector('#portrait').src !== before", arg=before)
    page.locator("#status", has_text="drawn in").wait_for()
    assert page.locator("#portrait").evaluate("image => image.naturalWidth") == 400


def drawn(page):
    page.locator("#status", has_text="Drawn in").wait_for()
    return page.locator("#portrait").get_attribute("src"), page.locator("#digest").inner_text()


def test_a_head_of_its_modes_follows_the_sliders_and_gets_a_study(desk):
    page, stage = desk
    page.goto(f"{stage.address}/admin/models")
    page.get_by_role("link", name="Make heads of its 2 identity modes").click()
    before, fingerprint = drawn(page)
    page.get_by_label("identity000", exact=True).fill("1.5")
    page.wait_for_function("before => document.querySelector('#digest').textContent !== before", arg=fingerprint)
    after, moved = drawn(page)
    assert (after, moved) != (before, fingerprint)
    assert page.locator("#portrait").evaluate("image => image.naturalWidth") == 400
    page.locator("#e-happy").check(force=True)
    page.wait_for_function("before => document.querySelector('#portrait').src !== before", arg=after)
    drawn(page)
    must_be_accessible(page)
    page.get_by_role("button", name="Reset identity000").click()
    page.wait_for_function("first => document.querySelector('#digest').textContent === first", arg=fingerprint)
    page.get_by_label("identity001", exact=True).fill("-1")
    page.wait_for_function("before => document.querySelector('#digest').textContent !== before", arg=fingerprint)
    _, chosen = drawn(page)
    page.get_by_role("button", name="Create a study with this head").click()
    page.wait_for_url("**/admin/studies/**")
    (kept,) = json.loads(stage.one("SELECT config FROM study_versions ORDER BY rowid DESC LIMIT 1"))["identities"]
    assert (kept["modes"], kept["hash"][:12]) == ({"identity001": -1.0}, chosen)


def test_the_form_of_its_study_follows_the_same_sliders(desk):
    page, stage = desk
    page.goto(f"{stage.address}/admin/studies/{stage.one('SELECT id FROM studies ORDER BY rowid DESC')}/design")
    page.locator("#status", has_text="drawn in").wait_for()
    before = page.locator("#portrait").get_attribute("src")
    with page.expect_request("**/admin/models/lab/heads/preview") as asked:
        page.get_by_label("identity001", exact=True).fill("2")
    assert "mode.identity001=2" in asked.value.post_data
    page.wait_for_function("before => document.querySelector('#portrait').src !== before", arg=before)
    assert page.locator("#unsaved").is_visible()
    must_be_accessible(page)


def test_small_pictures_come_after_a_portrait_that_took_its_time(desk):
    page, stage = desk

    def late(route):
        time.sleep(1)
        route.continue_()

    page.route("**/preview", late)
    page.goto(f"{stage.address}/admin/studies/{stage.one('SELECT id FROM studies ORDER BY rowid DESC')}/design")
    page.wait_for_function("() => [...document.querySelectorAll('.thumbs img')].every(image => image.naturalWidth)")
    assert page.locator(".thumbs img:visible").count() > 1
    page.unroute("**/preview")
