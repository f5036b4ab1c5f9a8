"""The answer arrives and its reply does not: the repeat gets the stored reply. A silent connection is given up."""

import pytest

from .record import answers, chosen, must_be_whole
from .wire import wired

pytestmark = pytest.mark.browser


# Twice: Chromium itself sends a request once more when a connection that it had used before is reset.
def over(wire, stage, name):
    return stage.link(name).replace(stage.address, wire.address)


def test_every_reply_is_lost_twice(stage, player):
    page = player.page
    with wired(stage.address) as wire:
        player.begin(over(wire, stage, "small"))
        before = answers(stage, page)
        for number, label in ((0, "Generation 1 of"), (1, "Generation 2 of")):
            wire.lose = 2
            player.choose(number, 4, best=4).next().wait_generation(label)
        wire.lose = 2
        player.choose(2).next()
        page.wait_for_selector(".rating")
        wire.lose = 2
        player.rate(2, 6)
        page.get_by_role("heading", name="You have finished").wait_for()
    assert wire.lost == [200] * 8
    assert answers(stage, page) == before + 4
    must_be_whole(stage, page)


def test_a_connection_that_stays_silent(stage, player):
    page = player.page
    with wired(stage.address) as wire:
        player.begin(over(wire, stage, "small"))
        wire.hang = 1
        player.choose(3).next()
        page.get_by_role("heading", name="Your answer is safe on this device").wait_for()
        player.wait_generation("Generation 1 of")
    assert chosen(stage, page) == [0]


def test_connections_are_reset_for_a_while(stage, player):
    page = player.page
    with wired(stage.address) as wire:
        player.begin(over(wire, stage, "small"))
        wire.cut = True
        player.choose(3).next()
        page.get_by_role("heading", name="Your answer is safe on this device").wait_for()
        assert chosen(stage, page) == []
        wire.cut = False
        player.wait_generation("Generation 1 of")
    assert chosen(stage, page) == [0]


def test_cut_off_between_the_reply_and_the_faces(stage, player):
    """The answer was taken, the faces cannot be fetched: they are tried again, and appear all together."""
    page = player.begin(stage.link("small")).page
    page.route("**/portraits/*", lambda route: route.abort())
    player.choose(1).next()
    page.get_by_text("faces could not be drawn.").wait_for()
    assert page.locator("#grid.shown").count() == 0
    page.unroute("**/portraits/*")
    page.get_by_role("button", name="Draw all ten again").click()
    player.wait_generation("Generation 1 of")
    assert chosen(stage, page) == [0]
