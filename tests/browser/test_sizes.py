"""No page is heavy, none asks another host, and every one fits small windows."""

from pathlib import Path

import pytest

pytestmark = pytest.mark.browser

STATIC = Path(__file__).parents[2] / "static"
MOST = 150_000


class Weight:
    """What each page loads of our own script and style, and whom it asks."""

    def __init__(self, page):
        self.page = page
        self.pages = {}
        self.hosts = set()
        page.on("request", self._note)

    def _note(self, request):
        self.hosts.add(request.url.split("/")[2])
        if request.is_navigation_request():
            self.loading = self.pages.setdefault(len(self.pages), set())
        elif request.url.endswith((".js", ".css")):
            self.loading.add(request.url.split("/static/")[1])

    def heaviest(self):
        return max(sum((STATIC / name).stat().st_size for name in names) for names in self.pages.values())


def through_all_pages(player, address, look):
    page = player.page
    page.goto(address)
    look()
    player.arrive(address)
    look()
    player.agree()
    look()
    page.locator("form[data-answer] button").click()
    page.get_by_role("heading", name="About you").wait_for()
    look()
    page.get_by_label("How old are you?").fill("34")
    page.get_by_label("woman").check()
    page.locator(".boxes input").nth(4).check()
    page.get_by_role("button", name="Next").click()
    player.faces()
    look()
    for label in ("Generation 1", None):
        player.choose(0).next()
        if label:
            player.wait_generation(label)
    page.get_by_role("heading", name="Judging a face").wait_for(state="attached")
    look()
    page.locator(".boxes input").nth(4).check()
    page.get_by_role("button", name="Next").click()
    page.get_by_role("heading", name="Naming an expression").wait_for(state="attached")
    look()
    page.get_by_label("sad").check()
    for scale in page.locator(".boxes").all():
        scale.locator("input").nth(5).check()
    page.get_by_role("button", name="Next").click()
    page.get_by_role("heading", name="You have finished").wait_for()
    look()


def test_every_page_is_light_and_asks_nobody_else(stage, player):
    weight = Weight(player.page)
    through_all_pages(player, stage.link("blocks"), lambda: None)
    assert len(weight.pages) >= 8
    assert 10_000 < weight.heaviest() <= MOST
    assert weight.hosts == {stage.address.split("/")[2]}


def test_no_page_scrolls_sideways(stage, player):
    """At 360 and 320 px, and at 640 x 400: a window of 1280 x 800 at 200 %."""
    page = player.page
    wide = []

    def look():
        before = page.viewport_size
        for width, height in ((360, 740), (320, 640), (640, 400)):
            page.set_viewport_size({"width": width, "height": height})
            if page.evaluate("document.documentElement.scrollWidth") > width:
                wide.append((page.title(), width))
        page.set_viewport_size(before)

    through_all_pages(player, stage.link("blocks"), look)
    assert wide == []


def test_at_200_percent_every_face_can_be_chosen(stage, player):
    page = player.begin(stage.link("asking")).page
    page.set_viewport_size({"width": 640, "height": 400})
    for place in (0, 9):
        player.choose(place)
        box = player.tile(place).bounding_box()
        assert box["height"] <= 400
    player.choose(best=9)
    page.locator(".none-is-close label").click()
    player.next().wait_generation("Generation 1 of")


def test_the_footer_keeps_its_controls_apart(stage, player):
    """At every width the box, the buttons and the words lie side by side or below each other, inside the window."""
    page = player.begin(stage.link("asking")).page
    player.choose(1).next().wait_generation("Generation 1 of")
    player.choose(1, 5, best=5)
    for width in (768, 800, 959, 960, 1024, 1239, 1240, 1366):
        page.set_viewport_size({"width": width, "height": 700})
        controls = ("#status", "#undo", ".none-is-close", ".footer .again", "#next")
        boxes = [page.locator(name).bounding_box() for name in controls]
        for at, one in enumerate(boxes):
            assert one["x"] >= 0 and one["x"] + one["width"] <= width and one["y"] + one["height"] <= 700, width
            for other in boxes[at + 1 :]:
                apart = one["x"] + one["width"] <= other["x"] + 1 or other["x"] + other["width"] <= one["x"] + 1
                assert apart or abs(one["y"] - other["y"]) > 30, width
        last = player.tile(9).bounding_box()
        assert last["y"] + last["height"] <= min(box["y"] for box in boxes), width
