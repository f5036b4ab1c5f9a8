"""Two tabs of one participation: one wins, the other is told so and goes on from the true state."""

import pytest

from tests.browser.conditions import on_device, until
from tests.browser.player import Player

from .record import answers, choices, chosen, must_be_whole

pytestmark = pytest.mark.browser


def portraits(page):
    return page.locator(".tile img").evaluate_all("images => images.map(image => image.src)")


def test_the_second_tab_goes_on_where_the_first_one_is(stage, player):
    page = player.begin(stage.link("small")).page
    other = Player(page.context.new_page())
    other.page.goto(page.url)
    other.faces()
    player.choose(1).next().wait_generation("Generation 1 of")
    won = choices(stage, page)
    stored = answers(stage, page)
    other.choose(7).next().wait_generation("Generation 1 of")
    assert portraits(other.page) == portraits(page)
    assert other.status() == "This face went on in another window. These are the current faces."
    assert other.page.locator(".select:checked").count() == 0
    assert (choices(stage, page), answers(stage, page)) == (won, stored)
    other.choose(2).next().wait_generation("Generation 2 of").choose(2).next()
    other.page.wait_for_selector(".rating")
    player.choose(5).next()
    page.wait_for_selector(".rating")
    # A page that opens sends what is left on the device; it has looked before the other tab leaves an answer there.
    page.wait_for_load_state()
    on_device(page, "answers", 0)
    other.rate(4, 4)
    other.page.get_by_role("heading", name="You have finished").wait_for()
    player.rate(1, 1)
    page.get_by_role("heading", name="You have finished").wait_for()
    must_be_whole(stage, page)
    assert stage.rows("SELECT DISTINCT value FROM ratings r JOIN trials t ON t.id = r.trial_id"
                      " JOIN participations p ON p.id = t.participation_id WHERE p.completion_code = ?",
                      page.locator(".code.main code").inner_text()) == [(4,)]  # fmt: skip
    other.page.close()
    assert other.problems == []


def test_both_tabs_choose_while_offline(stage, player):
    """The answers of both wait on the device; the first one counts, whichever tab sends it."""
    page = player.begin(stage.link("small")).page
    other = Player(page.context.new_page())
    other.page.goto(page.url)
    other.faces()
    page.context.set_offline(True)
    player.choose(1).next()
    other.choose(8).next()
    for one in (page, other.page):
        one.get_by_role("heading", name="Your answer is safe on this device").wait_for()
    page.context.set_offline(False)
    player.wait_generation("Generation 1 of")
    other.wait_generation("Generation 1 of")
    assert portraits(other.page) == portraits(page)
    assert chosen(stage, page) == [0]
    told = until(
        page, lambda: [one.status() for one in (player, other)], lambda both: "Nothing selected yet" not in both
    )
    assert sum("another window" in status for status in told) == 1
    other.page.close()
