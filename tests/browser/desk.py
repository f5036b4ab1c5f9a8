"""The experimenter's side of a running server: an owner with an account, and pictures of every admin page.

`python -m tests.browser.desk docs/screenshots` draws those of docs/running-a-study.md, on a study of forty people.
"""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path

from server.assets import asset
from server.services.clock import now
from server.services.config.files import read_study
from server.services.opening import open_house
from server.settings import Settings

from .populated import populate, study_for
from .screenshots import Camera
from .stage import chromium, running

ACCOUNT = {
    "Your name": "Ines Marchetti",
    "Email address": "ines.marchetti@westbrook.example",
    "Password": "four unrelated quiet words",
}
WIDE = {"viewport": {"width": 1440, "height": 900}}
DRAWN = "() => [...document.images].every(image => image.loading === 'lazy' || (image.complete && image.naturalWidth))"


def set_up(page, stage):
    """Make the owner's account, and stay signed in."""
    page.goto(stage.setup)
    for label, value in ACCOUNT.items():
        page.get_by_label(label).fill(value)
    page.get_by_role("button", name="Create the account").click()
    page.wait_for_url("**/admin/studies")


def main():
    folder = Path(sys.argv[1] if len(sys.argv) > 1 else "docs/screenshots")
    folder.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as data:
        day = _filled(Path(data))
        with running(Path(data), {}) as stage, chromium() as browser:
            page = browser.new_page(**WIDE)
            page.set_default_timeout(60_000)
            pictures(stage, Camera(folder, "desktop", page), day)


def _filled(folder):
    house = open_house(Settings(data_dir=folder), drawing=False)
    try:
        day = populate(house, now(), people=40, config=study_for(house.journal.rig, generations=10))
        for name, status in (("children", "draft"), ("retest-and-categorise", "pilot"), ("default", "closed")):
            config = read_study(asset("templates").joinpath(f"studies/{name}.yaml").read_text(encoding="utf-8"))
            house.studies.create(config, status)
        return day
    finally:
        house.close()


def pictures(stage, camera, day):
    page = camera.page
    page.goto(stage.setup)
    camera.take("admin-setup", whole=True)
    set_up(page, stage)
    study = f"{stage.address}/admin/studies/{day.study}"
    results(camera, study)  # first: it waits for the noise of the search, which the replay shows too
    for name, address in {
        "admin-studies": f"{stage.address}/admin/studies",
        "admin-new": f"{stage.address}/admin/studies/new",
        "admin-recruit": f"{study}/recruit",
        "admin-monitor": f"{study}/monitor",
        "admin-participants": f"{study}/participants",
        "admin-replay": f"{study}/participants/{day.who('complete')[0].number}",
        "admin-data": f"{study}/data",
        "admin-team": f"{stage.address}/admin/team",
        "admin-server": f"{stage.address}/admin/server",
        "admin-tokens": f"{stage.address}/admin/tokens",
    }.items():
        page.goto(address)
        _settle(page)
        camera.take(name, whole=True)
    design(camera, study)
    heads(stage, camera)
    page.context.clear_cookies()
    page.goto(f"{stage.address}/admin/login")
    camera.take("admin-sign-in", whole=True)


def design(camera, study):
    """The editor with one change that is not saved yet."""
    page = camera.page
    page.goto(f"{study}/design")
    _settle(page)
    page.get_by_label("Generations per face").fill("12")
    page.evaluate("scrollTo(0, 0)")
    camera.take("admin-design")


def results(camera, study):
    """The results, once the noise of the search is known."""
    page = camera.page
    page.goto(f"{study}/results")
    while page.get_by_text("is being computed").count():
        page.wait_for_timeout(1000)
        page.reload()
    _settle(page)
    camera.take("admin-results", whole=True)


def heads(stage, camera):
    """The editor of heads with one of its own that smiles."""
    page = camera.page
    page.goto(f"{stage.address}/admin/heads?from=male")
    page.wait_for_load_state("networkidle")
    page.locator("summary", has_text="Nose").click()
    for name, value in (("name", "Fifty-two"), ("p-age", "52"), ("p-nose-width", "0.4"), ("p-look-grey", "0.5")):
        page.locator(f"#{name}").evaluate("(input, value) => { input.value = value }", value)
        page.locator(f"#{name}").dispatch_event("input", {"bubbles": True})
    page.locator("#e-happy").check(force=True)
    page.locator("#status", has_text="Drawn in").wait_for()
    page.evaluate("scrollTo(0, 0)")
    camera.take("admin-heads", whole=True)


def _settle(page):
    """Bring every picture into view once, so that lazy ones load, and wait for all of them."""
    page.evaluate("document.querySelectorAll('img[loading=lazy]').forEach(image => { image.loading = 'eager' })")
    page.wait_for_function(DRAWN)
    page.evaluate("scrollTo(0, 0)")


if __name__ == "__main__":
    main()
