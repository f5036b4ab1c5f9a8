"""One way through every page that a participant can see: `look(name)` is called at each page and state.

It follows the server's state and never a page's words, so it walks the same way in every language.
"""

from __future__ import annotations

from .player import LATER, Player

FRESH = "() => document.documentElement?.dataset.walked === undefined && document.readyState === 'complete'"
OTHERS = "(face) => document.querySelector('.grid.shown') && !document.querySelector(`[data-face='${face}']`)"
STATE = "async () => (await fetch(`${document.body.dataset.address}/state`, { cache: 'no-store' })).json()"
ITEMS = {"questionnaire", "attention", "rate", "categorise"}


class Walk:
    def __init__(self, page, look):
        self.player, self.page, self.look = Player(page), page, look

    def whole(self, link):
        """Take part from the entry page to the debrief."""
        self.page.goto(link)
        self.look("entry")
        self._leave(lambda: self.page.locator("main form .button").click())
        while (step := self._state()["step"]) != "debrief":
            work = self._item if step in ITEMS else getattr(self, f"_{step}", self._other)
            work(step)
        self.look("debrief")

    def to_practice(self, link):
        """Go to the first ten faces."""
        self.page.goto(link)
        self._leave(lambda: self.page.locator("main form .button").click())
        self._consent("consent")
        self._leave(self._submit().click)

    def declined(self, link):
        self.page.goto(link)
        self._leave(lambda: self.page.locator("main form .button").click())
        self._leave(lambda: self.page.locator("button[name=given][value=false]").click())
        self.look("declined")

    def stopped(self, link):
        self.page.goto(link)
        self._leave(lambda: self.page.locator("main form .button").click())
        self._check_all()
        self._leave(lambda: self.page.locator("button[name=given][value=true]").click())
        self.page.locator("[data-dialog=stop]").last.click()
        self._leave(lambda: self.page.locator("#stop button[value=false]").click())
        self.look("stopped")

    def _state(self):
        # Asked by the browser, which opens a new connection where the server has closed the old one.
        return self.page.evaluate(STATE)

    def _leave(self, action):
        """Do what leads to a new page, and wait until it is there."""
        self.page.evaluate("document.documentElement.dataset.walked = 'yes'")
        action()
        self.page.wait_for_function(FRESH)

    def _submit(self):
        return self.page.locator("form[data-answer] .actions .button").first

    def _other(self, step):
        self.look(step)
        self._leave(self._submit().click)

    def _check_all(self):
        for label in self.page.locator(".statement label").all():
            label.click()

    def _consent(self, step):
        self.look(step)
        agree = self.page.locator("button[name=given][value=true]")
        agree.click()
        self.look("consent-missing")
        self._check_all()
        self._leave(agree.click)

    def _instructions(self, step):
        self.look(step)
        self.page.locator("[data-dialog=stop]").last.click()
        self.look("stop")
        self.page.keyboard.press("Escape")
        self._leave(self._submit().click)

    def _practice(self, step):
        self.player.faces()
        self.look(step)
        self.player.choose(0)
        self._leave(self.page.locator("#next").click)

    def _evolve(self, step):
        self.player.faces()
        trial = self._state()["trial"]
        if not trial["generation"]:
            self._first(step)
        else:
            self._again()
        self.player.choose(2)
        if trial["final"]:
            self._leave(self.page.locator("#next").click)
            return
        if trial["generation"]:
            self.page.locator("#next").click()
        else:
            self._offline()
        self.page.wait_for_function(OTHERS, arg=trial["faces"][0]["id"])

    def _first(self, step):
        page, player = self.page, self.player
        self.look(step)
        page.locator("#next").click()
        self.look("evolve-missing")
        player.choose(1, 3, 5, best=5)
        self.look("evolve-chosen")
        page.locator("[data-dialog=help]").last.click()
        self.look("help")
        page.keyboard.press("Escape")
        player.tile(3).locator(".enlarge").click()
        page.wait_for_selector("#enlarged[open]")
        self.look("enlarged")
        page.keyboard.press("Escape")
        page.wait_for_timeout(LATER)
        player.choose(1, 3, 5)

    def _again(self):
        self.page.locator("a.button.again").click()
        self.look("again")
        self.page.keyboard.press("Escape")

    def _offline(self):
        self.page.context.set_offline(True)
        self.page.locator("#next").click()
        self.page.wait_for_selector("#panel.offline:not([hidden])")
        self.look("offline")
        self.page.context.set_offline(False)
        self.page.evaluate("document.querySelector('#try-now')?.click()")

    def _rating(self, step):
        self.look(step)
        self._submit().click()
        self.look("rating-missing")
        for boxes in self.page.locator(".boxes").all():
            boxes.locator("input").nth(3).check()
        self._leave(self._submit().click)

    def _item(self, step):
        self.look(step)
        self._submit().click()
        self.look(f"{step}-missing")
        for field in self.page.locator("form[data-answer] fieldset").all():
            entry = field.locator(".entry")
            if entry.count():
                entry.fill("30")
            else:
                field.locator("input").first.check()
        self._leave(self._submit().click)
