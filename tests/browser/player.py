"""Takes part as a person would, through what is on the page."""

from __future__ import annotations

import re

LATER = 320  # longer than the 250 ms in which input is ignored, and than the 300 ms of a double tap


class Player:
    def __init__(self, page):
        self.page = page
        self.problems = []
        page.set_default_timeout(40_000)
        page.on("pageerror", lambda error: self.problems.append(str(error)))

    def arrive(self, address):
        self.page.goto(address)
        self.page.locator("main form button").click()
        self.page.wait_for_url("**/p/*")
        return self

    def agree(self):
        for label in self.page.locator(".statement label").all():
            label.click()
        self.page.get_by_role("button", name="I agree, start").click()
        self.page.wait_for_selector(".steps")
        return self

    def read(self):
        self.page.locator("form[data-answer] button").click()
        return self.faces()

    def begin(self, address):
        """Go to the first faces that count."""
        self.arrive(address).agree().read()
        self.choose(0)
        self.next()
        self.page.wait_for_selector("[data-generation]")
        return self.faces()

    def faces(self):
        self.page.wait_for_selector("#grid.shown")
        self.page.wait_for_timeout(LATER)
        return self

    def tile(self, place):
        return self.page.locator(".tile").nth(place)

    def choose(self, *places, best=None):
        for place in places:
            self.tile(place).locator(".face").click()
        if best is not None:
            self.tile(best).locator(".strip").click()
        return self

    def next(self):
        """Press the main button; on a phone first as often as it takes to have seen all ten."""
        for _ in range(8):
            if "See all" not in self.page.locator("#next").inner_text():
                break
            self.page.locator("#next").click()
            self.page.wait_for_timeout(700)
        self.page.locator("#next").click()
        return self

    def generation(self):
        return self.page.locator("[data-generation]").inner_text()

    def status(self):
        return self.page.locator("#status .words").inner_text()

    def wait_generation(self, label):
        self.page.locator("[data-generation]", has_text=label).wait_for()
        return self.faces()

    def rate(self, *values):
        self.page.wait_for_selector(".rating")
        self.page.wait_for_load_state()
        for scale, value in enumerate(values):
            self.page.locator(".boxes").nth(scale).locator("input").nth(value - 1).check()
        self.page.get_by_role("button", name="Next").click()
        return self

    def state(self):
        address = re.match(r".*/p/[\w-]+", self.page.url)[0]
        return self.page.request.get(f"{address}/state").json()
