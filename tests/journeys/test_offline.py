"""Offline for a minute in the middle: the answer is safe, the page says so, tries again more rarely, and goes on."""

from itertools import pairwise

import pytest

from .record import answers, chosen, must_be_whole

pytestmark = pytest.mark.browser

# Once `hurried` is set, twenty seconds of the page's timers in one; and when, on this clock, each try was made. Not
# sooner: the device has a second to open its memory while the page loads, and a busy machine may need a part of it.
HURRY = """(() => {
  const real = window.setTimeout;
  let ticks = 0;
  window.hurried = false;
  window.setTimeout = (run, ms, ...more) => window.hurried
    ? real(() => { if (ms === 1000) ticks += 1; run(...more); }, ms / 20)
    : real(run, ms, ...more);
  window.tries = [];
  const send = window.fetch;
  window.fetch = (address, ...more) => {
    if (String(address).endsWith("/answers")) window.tries.push(ticks);
    return send(address, ...more);
  };
})()"""


def test_a_minute_offline(stage, player):
    page = player.page
    page.add_init_script(HURRY)
    player.begin(stage.link("small"))
    page.evaluate("window.hurried = true")
    page.context.set_offline(True)
    before = answers(stage, page)
    player.choose(1, 5, best=5).next()
    page.get_by_role("heading", name="Your answer is safe on this device").wait_for()
    assert "The connection was lost." in page.locator("#panel").inner_text()
    page.wait_for_function("() => window.tries.length >= 7")
    tries = page.evaluate("window.tries")
    assert [later - sooner for sooner, later in pairwise(tries)][:6] == [1, 2, 4, 8, 15, 15]
    assert chosen(stage, page) == []
    page.context.set_offline(False)
    player.wait_generation("Generation 1 of")
    assert player.status() == "Connected again. Your answer has arrived."
    assert (chosen(stage, page), answers(stage, page)) == ([0], before + 1)
    player.choose(2).next().wait_generation("Generation 2 of").choose(3).next()
    player.rate(4, 5)
    page.get_by_role("heading", name="You have finished").wait_for()
    must_be_whole(stage, page)


def test_the_panel_appears_after_two_seconds_and_not_before(stage, player):
    page = player.begin(stage.link("small")).page
    page.evaluate(
        """() => new MutationObserver(() => {
          const panel = document.getElementById("panel");
          if (!panel.hidden && panel.classList.contains("offline")) window.lostAt ??= performance.now();
        }).observe(document.getElementById("panel"), { attributes: true })"""
    )
    page.context.set_offline(True)
    player.choose(1)
    page.evaluate(
        "document.getElementById('next').addEventListener('click', () => { window.pressedAt = performance.now(); })"
    )
    player.next()
    page.wait_for_selector("#panel.offline:not([hidden])")
    waited = page.evaluate("window.lostAt - window.pressedAt")
    assert 1900 < waited < 3500
    assert "Next try in" in page.locator(".next-try").inner_text()
    assert "kept on this device" in player.status()
    page.context.set_offline(False)
    player.wait_generation("Generation 1 of")
