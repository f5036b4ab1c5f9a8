"""A device that slept, or whose clock was set: recorded times are those of the page's own monotonic clock."""

import pytest

from tests.browser.stage import participation_of

from .record import answers, events

pytestmark = pytest.mark.browser

JUMP = """(() => {
  const now = Date.now;
  window.jumped = 0;
  Date.now = () => now() + window.jumped;
})()"""
TIMES = (
    "SELECT c.requested_ms, c.decoded_ms, c.onset_ms, c.chosen_ms, c.hidden_ms FROM choices c"
    " JOIN generations g ON g.id = c.generation_id JOIN trials t ON t.id = g.trial_id"
    " WHERE t.participation_id = ? AND NOT t.practice ORDER BY g.number"
)


@pytest.mark.parametrize("hours", [-30, 30])
def test_times_do_not_jump(stage, player, hours):
    page = player.page
    page.add_init_script(JUMP)
    player.begin(stage.link("small"))
    begun = page.evaluate("performance.now()")
    player.choose(1)
    page.evaluate("hours => { window.jumped = hours * 3600e3; }", hours)
    page.context.set_offline(True)
    player.choose(4, best=4).next()
    page.get_by_role("heading", name="Your answer is safe on this device").wait_for()
    page.context.set_offline(False)
    player.wait_generation("Generation 1 of").choose(2).next().wait_generation("Generation 2 of")
    page.evaluate("dispatchEvent(new Event('pagehide'))")
    page.wait_for_timeout(300)
    ended = page.evaluate("performance.now()")
    for row in stage.rows(TIMES, participation_of(stage, page)):
        requested, decoded, onset, chosen, hidden = row
        assert requested <= decoded <= onset < chosen <= ended
        assert onset - requested < 30_000 and chosen - onset < 30_000 and hidden == 0
    times = [at for _, at, *_ in events(stage, page)]
    assert times == sorted(times) and times[0] > 0 and times[-1] <= ended
    assert max(times) > begun
    assert answers(stage, page) == 5
