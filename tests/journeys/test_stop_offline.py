"""Stopping without a connection: the wish is noted on the device, and arrives later, after the answers before it."""

import pytest

from tests.browser.player import Player

from .record import chosen, outcome

pytestmark = pytest.mark.browser


def stop(page, button="Stop and keep"):
    page.get_by_role("link", name="Stop taking part").click()
    page.get_by_role("button", name=button).click()


def test_noted_and_sent_later(stage, player):
    page = player.begin(stage.link("small")).page
    page.context.set_offline(True)
    stop(page)
    page.get_by_role("heading", name="Your wish to stop is noted").wait_for()
    assert "kept on this device and sent" in page.locator("#panel").inner_text()
    assert page.locator("#grid.shown").count() == 0
    assert outcome(stage, page) is None
    page.context.set_offline(False)
    page.get_by_role("heading", name="You have stopped taking part").wait_for()
    assert outcome(stage, page) == "stopped"


def test_after_the_answer_that_waits(stage, player):
    page = player.begin(stage.link("small")).page
    page.context.set_offline(True)
    player.choose(3).next()
    page.get_by_role("heading", name="Your answer is safe on this device").wait_for()
    stop(page)
    page.get_by_role("heading", name="Your wish to stop is noted").wait_for()
    address = page.url
    context = page.context
    page.close()
    context.set_offline(False)
    again = Player(context.new_page())
    again.page.goto(address)
    again.page.get_by_role("heading", name="You have stopped taking part").wait_for()
    assert (chosen(stage, again.page), outcome(stage, again.page)) == ([0], "stopped")


def test_erasing_from_a_form_page(stage, player):
    page = player.arrive(stage.link("blocks")).agree().page
    page.locator("form[data-answer] button").click()
    page.get_by_role("heading", name="About you").wait_for()
    page.wait_for_load_state()
    page.context.set_offline(True)
    stop(page, "Stop and erase")
    page.get_by_role("heading", name="Your wish to stop is noted").wait_for()
    assert "erased as soon as it has arrived" in page.locator(".offline-box").inner_text()
    page.context.set_offline(False)
    page.get_by_role("heading", name="Your answers have been erased").wait_for()
    assert outcome(stage, page) == "erased"
