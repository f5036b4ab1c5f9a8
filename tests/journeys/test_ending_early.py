"""A face that is finished early: the page says so once it is known, and not any more after a new start."""

import pytest

from tests.browser.stage import participation_of

pytestmark = pytest.mark.browser

LEAST, MOST = 2, 4
TRIALS = "SELECT generation, last_generation FROM trials WHERE participation_id = ? AND NOT practice"


def to_the_last_page(player):
    """Choose until the best face ends the trial, look at what the pages count, and return the generation.

    It is nearly always the least; the seed is the server's, and another one may leave more doubt.
    """
    segments, number, last = player.page.locator(".topline .segments i"), 0, False
    player.wait_generation("First faces")
    while not last:
        assert segments.count() == MOST
        player.choose(1, 2, best=1).next()
        number += 1
        player.wait_generation(f"Generation {number} of")
        last = player.page.locator("[data-generation]").inner_text() == f"Generation {number} of {number}"
    assert LEAST <= number == segments.count() <= MOST
    assert segments.last.get_attribute("class") == "current"
    return number


def test_the_page_counts_to_the_last_generation_and_anew_after_a_new_start(stage, player):
    player.begin(stage.link("ending"))
    to_the_last_page(player)
    player.page.locator(".footer .again").click()
    player.page.get_by_role("button", name="Start again").click()
    last = to_the_last_page(player)
    player.choose(3, best=3).next()
    player.rate(5, 6)
    player.page.get_by_role("heading", name="You have finished. Thank you.").wait_for()
    assert stage.rows(TRIALS, participation_of(stage, player.page)) == [(last, last if last < MOST else None)]
