"""Answers of other tabs still wait on the device at the end: the code appears only after they have arrived."""

import pytest

from tests.browser.player import Player

from .record import must_be_whole

pytestmark = pytest.mark.browser


def test_two_answers_wait_at_the_end(stage, player):
    page = player.begin(stage.link("unrated")).page
    tabs = [Player(page.context.new_page()) for _ in range(2)]
    for tab in tabs:
        tab.page.goto(page.url)
        tab.faces()
    page.context.set_offline(True)
    for place, tab in enumerate(tabs, 4):
        tab.choose(place).next()
        tab.page.get_by_role("heading", name="Your answer is safe on this device").wait_for()
        tab.page.close()
    page.context.set_offline(False)
    player.choose(1).next().wait_generation("Generation 1 of")
    player.choose(1).next().wait_generation("Generation 2 of").choose(1)
    held, released = [], []

    def hold(route):
        if not released and page.locator("#waiting").count():
            held.append(route)
        else:
            route.continue_()

    page.route("**/answers", hold)
    player.next()
    page.get_by_text("Two answers are still being sent. Your code appears as soon as they have arrived.").wait_for()
    assert page.locator(".code.main").is_hidden()
    released.append(True)
    for route in held:
        route.continue_()
    page.locator(".code.main code").wait_for()
    assert page.get_by_text("still being sent").is_hidden()
    must_be_whole(stage, page)
