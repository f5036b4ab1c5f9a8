"""The server dies in the middle of a choice and comes back on the same data: the page goes on by itself."""

import pytest

from server.cli.local import served
from tests.browser.stage import STUDIES, Stage, drawing, running

from .record import chosen, must_be_whole

pytestmark = pytest.mark.browser


def test_killed_and_restarted(tmp_path, player):
    page = player.page
    with running(tmp_path, {"small": STUDIES["small"]}) as stage:
        player.begin(stage.link("small"))
        player.choose(1).next().wait_generation("Generation 1 of")
        stage.process.kill()
        stage.process.wait()
        player.choose(4, 7, best=7).next()
        page.get_by_role("heading", name="Your answer is safe on this device").wait_for()
    port = int(stage.address.rsplit(":", 1)[1])
    with served(tmp_path, port, EMOGEN_RENDERER=drawing()) as again:
        stage = Stage(tmp_path, again.address, again.setup, again.process)
        player.wait_generation("Generation 2 of")
        assert chosen(stage, page) == [0, 1]
        player.choose(3).next()
        player.rate(3, 3)
        page.get_by_role("heading", name="You have finished").wait_for()
        must_be_whole(stage, page)
