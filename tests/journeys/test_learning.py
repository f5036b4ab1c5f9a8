"""A trial whose search learns from every choice, to its end: the page is the same, and the estimate is stored."""

import pytest

from emogen_core.search import preference
from tests.browser.stage import participation_of

pytestmark = pytest.mark.browser

ORIGINS = (
    "SELECT g.number, f.origin FROM faces f JOIN generations g ON f.generation_id = g.id"
    " JOIN trials t ON g.trial_id = t.id WHERE t.participation_id = ? AND NOT t.practice"
)
LEARNED = {"elite", "posterior-mean", "draw", "draws-mean", "elite-draw", "part", "random"}
ESTIMATES = "SELECT t.practice FROM estimates e JOIN trials t ON e.trial_id = t.id WHERE t.participation_id = ?"


def test_faces_are_chosen_and_rated_and_the_estimate_is_stored(stage, player):
    player.begin(stage.link("learning"))
    for number in range(3):
        player.wait_generation(f"Generation {number} of" if number else "First faces")
        assert player.page.locator(".tile").count() == 10
        player.choose(number, number + 3, best=number).next()
    player.rate(5, 6)
    player.page.get_by_role("heading", name="You have finished. Thank you.").wait_for()
    who = participation_of(stage, player.page)
    assert (
        stage.one("SELECT algorithm FROM participations WHERE id = ?", who) == f"{preference.NAME}/{preference.VERSION}"
    )
    made = stage.rows(ORIGINS, who)
    for number in (1, 2):
        origins = {origin for at, origin in made if at == number}
        assert "elite" in origins
        assert origins & {"draw", "draws-mean"}, "faces that may be meant"
        assert origins <= LEARNED
    assert sorted(stage.rows(ESTIMATES, who)) == [(0,), (1,)]
