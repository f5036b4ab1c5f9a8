"""How long a participant waits between a choice and ten new faces, in a real browser.

The page itself notes the moments of each generation (`static/participant/choice.js`): the choice, the server's reply,
ten decoded portraits, and the frame after they were painted; with each portrait the server says how long it was drawn.
"""

from __future__ import annotations

import uuid
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from ..services.studies.simulation import plain_answer

if TYPE_CHECKING:
    from playwright.sync_api import Browser, Page

BAR_MS = {"median": 300, "p95": 500}
WINDOW = {"width": 1280, "height": 800}
NAME = "emogen-turnaround"
SPANS = f"performance.getEntriesByName('{NAME}').map(entry => entry.detail).filter(one => one.start < one.requested)"


def measure(browser: Browser, address: str, link: str, generations: int, look: float) -> dict[str, Any]:
    """Take part until so many generations were chosen from, looking at each for `look` seconds.

    Returns:
        Milliseconds from the choice to ten decoded portraits, to their being shown, and where they went.
    """
    spans: list[dict[str, Any]] = []
    while len(spans) < generations:
        page = browser.new_page(viewport={"width": WINDOW["width"], "height": WINDOW["height"]})
        spans += _Participant(page, address, link, look).take_part(generations - len(spans))
        page.close()
    return report(spans)


def report(spans: list[dict[str, Any]]) -> dict[str, Any]:
    """Return the figures of moments that the page noted."""
    turnaround = _told([one["decoded"] - one["start"] for one in spans])
    draw = [min(one["drawn"] or 0, one["decoded"] - one["requested"]) for one in spans]
    return {
        "n": len(spans),
        "turnaround_ms": turnaround,
        "shown_ms": _told([one["onset"] - one["start"] for one in spans]),
        "split_ms": {
            "answer": _told([one["requested"] - one["start"] for one in spans]),
            "draw": _told(draw),
            "transfer_and_decode": _told(
                [one["decoded"] - one["requested"] - drawn for one, drawn in zip(spans, draw, strict=True)]
            ),
            "paint": _told([one["onset"] - one["decoded"] for one in spans]),
        },
        "bar_ms": BAR_MS,
        "holds": all(turnaround[name] <= bar for name, bar in BAR_MS.items()),
    }


@dataclass
class _Participant:
    page: Page
    address: str
    link: str
    look: float
    spans: list[dict[str, Any]] = field(default_factory=list)

    def take_part(self, wanted: int) -> list[dict[str, Any]]:
        """Go through a participation until so many generations were measured, or to its end."""
        joined = self.page.request.post(f"{self.address}/s/{self.link}", headers={"Accept": "application/json"})
        place = self.address + joined.json()["address"]
        while len(self.spans) < wanted:
            state = self.page.request.get(f"{place}/state").json()
            if "completion" in state:
                break
            if "trial" in state:
                self._trial(place, state["trial"], wanted)
            else:
                body = {"id": str(uuid.uuid4()), **plain_answer(state)}
                self.page.request.post(f"{place}/answers", data=body)
        return self.spans[:wanted]

    def _trial(self, place: str, trial: dict[str, Any], wanted: int) -> None:
        """Choose in the page until a trial is over or enough was measured."""
        self.page.goto(place)
        left = trial["generations"] - trial["generation"]
        need = max(trial["minimum"], min(3, trial["maximum"]))
        before: list[dict[str, Any]] = []
        for number in range(left + 1):
            self._choose(1 if number == left else need)
            if number == left:
                with self.page.expect_navigation():
                    self.page.locator("#next").click()
                return
            self.page.locator("#next").click()
            self.page.wait_for_function(f"count => {SPANS}.length > count", arg=len(before))
            before = self.page.evaluate(SPANS)
            self.spans.append(before[-1])
            if len(self.spans) >= wanted:
                return

    def _choose(self, count: int) -> None:
        self.page.wait_for_selector("#grid.shown:not(.empty)")
        self.page.wait_for_timeout(self.look * 1000)
        for place in range(count):
            self.page.locator(".tile .face").nth(3 * place).click()
        if count > 1:
            self.page.locator(".tile .strip").first.click()


def _told(values: list[float]) -> dict[str, float]:
    median, p95 = np.quantile(values, [0.5, 0.95])
    return {"median": round(float(median), 1), "p95": round(float(p95), 1), "max": round(max(values), 1)}
