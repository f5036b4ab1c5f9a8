"""The tab is closed straight after Next: the last try outlives it, or the next visit delivers what was left."""

import pytest

from tests.browser.conditions import until
from tests.browser.player import Player

from .record import chosen, must_be_whole

pytestmark = pytest.mark.browser


def test_closed_straight_after_next(stage, player):
    page = player.begin(stage.link("small")).page
    context, address = page.context, page.url
    player.choose(6)
    # The first try is held on its way when the page goes.
    page.route("**/answers", lambda route: None)
    page.locator("#next").click()
    page.unroute("**/answers")
    page.close(run_before_unload=True)
    again = Player(context.new_page())
    again.page.goto(address)
    again.wait_generation("Generation 1 of")
    assert chosen(stage, again.page) == [0]
    again.choose(1).next().wait_generation("Generation 2 of").choose(1).next()
    again.rate(5, 5)
    again.page.get_by_role("heading", name="You have finished").wait_for()
    must_be_whole(stage, again.page)


def test_gone_to_another_page_straight_after_next(stage, player):
    """The try that outlives the page is enough: nobody comes back."""
    page = player.begin(stage.link("small")).page
    player.choose(6)
    address = page.url
    page.evaluate("() => { document.getElementById('next').click(); location.href = '/static/icon.svg'; }")
    page.wait_for_url("**/icon.svg")
    page.evaluate("address => history.replaceState(null, '', address)", address)
    assert until(page, lambda: chosen(stage, page), len) == [0]


def test_closed_while_offline(stage, player):
    page = player.begin(stage.link("small")).page
    context, address = page.context, page.url
    context.set_offline(True)
    player.choose(8).next()
    page.get_by_role("heading", name="Your answer is safe on this device").wait_for()
    page.close()
    context.set_offline(False)
    again = Player(context.new_page())
    asked = []
    again.page.on("request", lambda request: asked.append(request.url.rsplit("/", 1)[-1]))
    again.page.goto(address)
    again.wait_generation("Generation 1 of")
    assert chosen(stage, again.page) == [0]
    assert asked.index("answers") < asked.index("state"), "what was left goes before the question where things are"
