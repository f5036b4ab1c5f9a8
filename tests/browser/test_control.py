"""Experimental control: ten faces in one frame, times that mean what they say, nothing that moves or hints."""

from itertools import pairwise

import pytest

from tests.browser.stage import sent

from .conditions import TWO_FRAMES, at_rest
from .stage import participation_of

pytestmark = pytest.mark.browser

# In every frame: how many tiles show a picture that is there, and which.
FRAMES = """() => {
  window.frames_seen = [];
  const look = (time) => {
    const shown = document.getElementById("grid").classList.contains("shown");
    const images = [...document.querySelectorAll(".tile img")];
    const visible = images.filter((image) => shown && image.complete && image.naturalWidth > 0);
    const faces = images.map((image) => image.src).join();
    window.frames_seen.push({ time, visible: visible.length, faces });
    requestAnimationFrame(look);
  };
  requestAnimationFrame(look);
}"""
SHIFTS = """() => {
  window.shifts = [];
  window.note = (entries) => {
    for (const { value, sources } of entries) {
      window.shifts.push([value, ...sources.map(({ node }) => node?.className || node?.nodeName)]);
    }
  };
  window.watch = new PerformanceObserver((list) => window.note(list.getEntries()));
  window.watch.observe({ type: "layout-shift", buffered: false });
}"""
SHIFTED = "() => { window.note(window.watch.takeRecords()); return window.shifts; }"
TIMES = (
    "SELECT c.requested_ms, c.decoded_ms, c.onset_ms, c.chosen_ms, c.drawn_ms, c.none_is_close FROM choices c"
    " JOIN generations g ON g.id = c.generation_id JOIN trials t ON t.id = g.trial_id"
    " WHERE t.participation_id = ? AND NOT t.practice ORDER BY g.number"
)


def times(stage, page):
    return stage.rows(TIMES, participation_of(stage, page))


def test_ten_faces_change_in_one_frame_and_that_frame_is_time_zero(stage, player):
    page = player.begin(stage.link("small")).page
    page.evaluate(FRAMES)
    player.choose(1).next().wait_generation("Generation 1 of")
    frames = page.evaluate("window.frames_seen")
    assert {frame["visible"] for frame in frames} == {0, 10}
    assert len({frame["faces"] for frame in frames}) == 2, "never a mixture of two generations"
    player.choose(2).next().wait_generation("Generation 2 of")
    _, (requested, decoded, onset, chosen, *_) = times(stage, page)
    assert requested <= decoded < onset < chosen
    (first,) = [frame["time"] for before, frame in pairwise(frames)
                if frame["visible"] == 10 and before["visible"] == 0]  # fmt: skip
    # The page looks at the start of a frame, so the first one to see all ten is the one after they were painted.
    assert onset == pytest.approx(first, abs=1.5)


@pytest.mark.parametrize("study", ["small", "asking"])
def test_nothing_moves_when_faces_arrive(stage, player, study):
    page = player.begin(stage.link(study)).page
    page.mouse.move(640, 700)
    for number in (1, 2):
        player.choose(2, 6, best=6)
        at_rest(page)
        page.evaluate(SHIFTS)
        player.next().wait_generation(f"Generation {number} of")
        at_rest(page)
        assert page.evaluate(SHIFTED) == []


def test_nothing_moves_on_a_phone(stage, phone):
    page = phone.begin(stage.link("asking")).page
    phone.choose(8, 9, best=9)
    page.evaluate(SHIFTS)
    phone.next().wait_generation("Generation 1 of")
    at_rest(page)
    assert page.evaluate(SHIFTED) == []


def test_the_screen_is_empty_between_generations_and_no_words_flash(stage, player):
    page = player.begin(stage.link("asking")).page
    page.evaluate(FRAMES)
    page.evaluate(
        """() => new MutationObserver(() => { window.panelShown ||= !document.getElementById("panel").hidden; })
          .observe(document.getElementById("panel"), { attributes: true })"""
    )
    for number in (1, 2):
        player.choose(number).next().wait_generation(f"Generation {number} of")
    player.choose(1).next()
    page.wait_for_selector(".rating")
    rows = times(stage, page)
    for (*_, chosen, _, _), (_, decoded, onset, *_) in pairwise(rows):
        assert onset - chosen >= 900
        assert onset >= decoded
    assert all(onset <= chosen for _, _, onset, chosen, *_ in rows)


def test_the_panel_does_not_appear_within_the_pause(stage, player):
    page = player.begin(stage.link("asking")).page
    page.evaluate(
        """() => new MutationObserver(() => {
          if (!document.getElementById("panel").hidden) window.panelAt ??= performance.now();
        }).observe(document.getElementById("panel"), { attributes: true })"""
    )
    player.choose(3).next().wait_generation("Generation 1 of")
    player.choose(1).next().wait_generation("Generation 2 of")
    chosen = times(stage, page)[0][3]
    assert (page.evaluate("window.panelAt") or float("inf")) - chosen >= 900


def test_none_of_these_is_close(stage, player):
    page = player.begin(stage.link("asking")).page
    box = page.get_by_role("checkbox", name="None of these is close")
    page.locator(".none-is-close label").click()
    assert box.is_checked()
    assert player.status() == "Noted. The nearest ones still shape the next faces."
    player.next()
    assert player.status() == "Choose at least one face.", "the search needs the nearest ones all the same"
    player.choose(4).next().wait_generation("Generation 1 of")
    assert not box.is_checked(), "it is about these ten faces only"
    player.choose(2).next().wait_generation("Generation 2 of")
    assert [row[-1] for row in times(stage, page)] == [1, 0]


def test_none_is_close_is_not_asked_where_the_study_does_not(stage, player):
    page = player.begin(stage.link("small")).page
    assert page.locator("#none").count() == 0
    player.choose(2).next().wait_generation("Generation 1 of")
    assert [row[-1] for row in times(stage, page)] == [None]


def test_none_is_close_without_script(stage, browser):
    context = browser.new_context(java_script_enabled=False)
    page = context.new_page()
    page.goto(stage.link("asking"))
    sent(page, "main form button")
    for label in page.locator(".statement label").all():
        label.click()
    sent(page, "button[value=true]")
    sent(page, "form[data-answer] button")
    for places in ((0,), (2, 6)):
        for place in places:
            page.locator(".tile").nth(place).locator(".face").click()
        page.locator(".none-is-close label").click()
        sent(page, "#next")
    assert page.locator("#none").is_checked(), "what was ticked stays when something is missing"
    page.locator(".tile").nth(2).locator(".strip").click()
    sent(page, "#next")
    assert [row[-1] for row in times(stage, page)] == [1]
    context.close()


def test_the_servers_drawing_time_stands_apart(stage, player):
    page = player.begin(stage.link("small")).page
    for number in (1, 2):
        player.choose(number, 5, best=5).next().wait_generation(f"Generation {number} of")
    player.choose(1).next()
    page.wait_for_selector(".rating")
    later = times(stage, page)[1:]
    assert all(drawn is not None and 0 < drawn < 30_000 for *_, drawn, _ in later), (
        "five of the ten depend on the choice"
    )


def test_hidden_time_is_recorded_and_is_no_reaction_time(stage, player):
    page = player.begin(stage.link("small")).page
    hide = """hidden => {
      const before = performance.now();
      Object.defineProperty(document, "hidden", { configurable: true, value: hidden });
      document.dispatchEvent(new Event("visibilitychange"));
      return [before, performance.now()];
    }"""
    gone = page.evaluate(hide, True)
    page.evaluate(TWO_FRAMES)
    back = page.evaluate(hide, False)
    assert back[0] - gone[1] > 10
    player.choose(1).next().wait_generation("Generation 1 of")
    hidden = stage.rows("SELECT c.hidden_ms FROM choices c JOIN generations g ON g.id = c.generation_id"
                        " JOIN trials t ON t.id = g.trial_id WHERE t.participation_id = ? AND NOT t.practice",
                        participation_of(stage, page))  # fmt: skip
    assert back[0] - gone[1] - 1 <= hidden[0][0] <= back[1] - gone[0] + 1


def test_places_by_slot(stage, player):
    page = player.begin(stage.link("ordered")).page
    player.choose(1).next().wait_generation("Generation 1 of")
    shown = page.locator(".tile").evaluate_all("tiles => tiles.map(tile => tile.dataset.face)")
    slots = dict(stage.rows("SELECT id, slot FROM faces"))
    assert [slots[face] for face in shown] == list(range(1, 11))


def test_nothing_on_the_page_says_how_good_a_choice_is(stage, player):
    """No place, picture or word depends on whether a face is the elite; the page is not even told."""
    page = player.begin(stage.link("small")).page
    player.choose(3).next().wait_generation("Generation 1 of")
    told = page.evaluate("document.documentElement.outerHTML")
    assert not any(word in told for word in ("elite_", '"slot"', '"origin"', "bred"))
    state = player.state()["trial"]
    assert {frozenset(face) for face in state["faces"]} == {frozenset({"id", "place", "portrait"})}


def test_portraits_come_on_the_exact_grey_of_the_tile(stage, player):
    page = player.begin(stage.link("small")).page
    grey = page.evaluate(
        """async () => {
          const image = document.querySelector(".tile img");
          const canvas = Object.assign(document.createElement("canvas"), { width: 200, height: 240 });
          const pen = canvas.getContext("2d");
          pen.drawImage(image, 0, 0);
          const tile = getComputedStyle(document.querySelector(".tile")).backgroundColor;
          return [[...pen.getImageData(3, 3, 1, 1).data].slice(0, 3), tile];
        }"""
    )
    assert grey == [[201, 201, 201], "rgb(201, 201, 201)"]


def test_a_second_look_starts_at_the_first_tile_only_for_keys(stage, player):
    page = player.begin(stage.link("small")).page
    player.choose(4).next().wait_generation("Generation 1 of")
    assert page.evaluate("document.activeElement.id") != "select-1"
    page.locator("#select-3").focus()
    page.keyboard.press("Space")
    page.keyboard.press("Enter")
    player.wait_generation("Generation 2 of")
    assert page.evaluate("document.activeElement.id") == "select-1"
