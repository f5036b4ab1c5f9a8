"""What the page saw arrives once, in order, whatever happens to the bundles on their way."""

import pytest

from tests.browser.conditions import until

from .record import events

pytestmark = pytest.mark.browser


def test_events_arrive_once(stage, player):
    player.begin(stage.link("small"))
    page = player.page
    player.choose(1).choose(4).choose(1)
    page.locator("#undo").click()
    player.tile(4).hover()
    player.tile(4).locator(".enlarge").click()
    page.keyboard.press("Escape")
    player.choose(best=4).next().wait_generation("Generation 1 of")
    arrived = until(page, lambda: events(stage, page), lambda rows: "best" in {kind for kind, *_ in rows})
    rows = sorted(arrived, key=lambda row: row[1])
    kinds = [kind for kind, *_ in rows]
    assert kinds[0] == "onset"
    assert kinds.count("first_view") == 10
    assert [kind for kind in kinds if kind not in {"onset", "first_view"}] == [
        "select", "select", "deselect", "undo", "enlarge", "enlarge_end", "best",
    ]  # fmt: skip
    assert {row[0]: row[2] for row in rows}["enlarge_end"] > 0
    assert len({row[1:4] for row in rows}) == len(rows)
