"""Pictures of every page: `python -m tests.browser.screenshots docs/screenshots`."""

from __future__ import annotations

import io
import sys
import tempfile
from pathlib import Path

from PIL import Image

from .player import Player
from .stage import STUDIES, chromium, running

DESKTOP = {"viewport": {"width": 1280, "height": 800}}
PHONE = {"viewport": {"width": 390, "height": 844}, "has_touch": True, "is_mobile": True}
SHORT = {"generations": 3, "emotions": STUDIES["small"]["emotions"]}
SHOWN = {
    "light": {**STUDIES["pictures"], **SHORT},
    "dark": {**STUDIES["pictures"], **SHORT, "surround": "dark"},
    "closed": STUDIES["pictures"],
}


class Camera:
    """Takes one device's pictures into a folder."""

    def __init__(self, folder, device, page):
        self.folder, self.device, self.page = folder, device, page

    def take(self, name, *, whole=False):
        self.page.wait_for_timeout(200)
        picture = Image.open(io.BytesIO(self.page.screenshot(full_page=whole))).convert("RGB")
        small = picture.quantize(256, method=Image.Quantize.MEDIANCUT, dither=Image.Dither.NONE)
        small.save(self.folder / f"{name}-{self.device}.png", optimize=True)


def main():
    folder = Path(sys.argv[1] if len(sys.argv) > 1 else "docs/screenshots")
    folder.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as data, running(Path(data), SHOWN) as stage, chromium() as browser:
        for device, options in (("desktop", DESKTOP), ("phone", PHONE)):
            for walk in (participation, others):
                context = browser.new_context(**options)
                walk(stage, Camera(folder, device, context.new_page()))
                context.close()


def participation(stage, camera):
    page = camera.page
    player = Player(page)
    page.goto(stage.link("light"))
    camera.take("entry", whole=True)
    player.arrive(stage.link("light"))
    camera.take("consent", whole=True)
    page.get_by_role("button", name="I agree, start").click()
    camera.take("consent-error", whole=True)
    player.agree()
    camera.take("instructions", whole=True)
    player.read()
    camera.take("practice")
    player.choose(0).next()
    page.wait_for_selector("[data-generation]")
    player.faces()
    camera.take("evolve-first")
    player.choose(1).next().wait_generation("Generation 1 of")
    evolve(player, camera)
    ending(player, camera)


def evolve(player, camera):
    page = player.page
    player.choose(1, 4, 6, best=6)
    page.evaluate("scrollTo(0, 0)")
    if camera.device == "desktop":
        player.tile(8).hover()
    camera.take("evolve")
    player.tile(6).locator(".enlarge").click()
    camera.take("enlarged")
    page.keyboard.press("Escape")
    page.mouse.move(5, 5)
    if camera.device == "desktop":
        dialogs(player, camera)
    waiting(player, camera)


def dialogs(player, camera):
    page = player.page
    for name, opener in (
        ("start-again", ".footer .again"),
        ("help", ".wide-link >> nth=0"),
        ("stop", ".wide-link >> nth=1"),
    ):
        page.locator(opener).click()
        camera.take(name)
        page.keyboard.press("Escape")


def waiting(player, camera):
    """The two panels: drawing, with portraits held back, and connection lost."""
    page = player.page
    held, open_gate = [], []

    def gate(route):
        (route.continue_ if open_gate else lambda: held.append(route))()

    page.route("**/portraits/*", gate)
    player.next()
    page.wait_for_timeout(700)
    for route in held[:3]:
        route.continue_()
    page.wait_for_timeout(500)
    camera.take("drawing")
    open_gate.append(True)
    for route in held[3:]:
        route.continue_()
    player.wait_generation("Generation 2 of")
    page.unroute("**/portraits/*")
    page.context.set_offline(True)
    player.choose(2, 3, best=3).next()
    page.wait_for_selector("#panel.offline:not([hidden])")
    camera.take("offline")
    page.context.set_offline(False)
    player.wait_generation("Generation 3 of")


def ending(player, camera):
    page = player.page
    player.next()
    camera.take("nothing-selected")
    player.choose(5).next()
    page.wait_for_selector(".rating")
    page.wait_for_load_state()
    page.locator(".boxes").first.locator("input").nth(4).check()
    camera.take("rating")
    page.get_by_role("button", name="Next").click()
    camera.take("rating-error", whole=True)
    player.rate(5, 6)
    page.wait_for_selector(".code")
    camera.take("completion", whole=True)


def others(stage, camera):
    page = camera.page
    player = Player(page)
    player.begin(stage.link("dark"))
    player.choose(1, 4, 6, best=6)
    page.keyboard.press("ArrowRight")
    page.keyboard.press("ArrowRight")
    page.evaluate("scrollTo(0, 0)")
    camera.take("evolve-dark")
    page.request.post(page.url + "/stop", data={"erase": False})
    page.goto(page.url)
    camera.take("stopped", whole=True)
    page.goto(f"{stage.address}/s/not-a-link")
    camera.take("unknown-link", whole=True)
    page.goto(stage.link("closed"))
    camera.take("study-closed", whole=True)


if __name__ == "__main__":
    main()
