"""What was filled in and not sent yet survives a reload; nothing of it stays once it is sent, or taken back."""

import pytest

from .record import events
from .test_forms_offline import fill, to_questions

pytestmark = pytest.mark.browser

KEPT = "Object.keys(sessionStorage).filter((key) => key.includes('draft'))"


def said(page):
    return page.locator("form[data-answer]").evaluate(
        """form => [...form.querySelectorAll("input:not([type=hidden]), textarea")]
             .filter(({ type, checked, value }) => (["radio", "checkbox"].includes(type) ? checked : value))
             .map(({ id, value }) => [id, value])"""
    )


def test_questions_are_as_they_were_left(stage, player):
    page = to_questions(player, stage.link("blocks"))
    page.get_by_label("How old are you?").fill("34")
    page.get_by_label("woman").check()
    page.get_by_label("Anything to add?").fill("It was <late>.")
    page.locator(".boxes input").nth(4).check()
    before = said(page)
    assert len(before) == 4
    page.reload()
    assert said(page) == before
    page.get_by_label("woman").focus()
    page.keyboard.press("ArrowDown")
    page.reload()
    left = dict(said(page))
    assert (left.pop("q-gender-2"), left) == ("man", {name: value for name, value in before if name != "q-gender"})
    page.get_by_role("button", name="Next").click()
    page.wait_for_selector("#grid.shown")
    assert page.evaluate(KEPT) == []


def test_consent_is_as_it_was_left_and_gone_when_it_is_declined(stage, player):
    page = player.arrive(stage.link("small")).page
    page.locator("label[for=read]").click()
    page.reload()
    assert said(page) == [["read", "read"]]
    page.get_by_role("button", name="I do not want to take part").click()
    page.get_by_role("heading", name="You have chosen not to take part").wait_for()
    assert page.evaluate(KEPT) == []


def test_nothing_stays_of_somebody_who_withdraws(stage, player):
    page = to_questions(player, stage.link("blocks"))
    page.get_by_label("How old are you?").fill("34")
    assert len(page.evaluate(KEPT)) == 1
    page.get_by_role("link", name="Stop taking part").click()
    page.get_by_role("button", name="Stop and erase").click()
    page.get_by_role("heading", name="Your answers have been erased").wait_for()
    assert page.evaluate(KEPT) == []


def test_another_page_of_questions_begins_empty(stage, player):
    page = to_questions(player, stage.link("blocks"))
    fill(page)
    player.faces().choose(0).next().wait_generation("Generation 1").choose(2).next()
    page.get_by_role("heading", name="Judging a face").wait_for(state="attached")
    assert said(page) == []


def test_a_page_of_questions_sends_the_events_that_were_left(stage, player):
    """The last faces went while no event got through; nobody comes to another page of faces."""
    page = to_questions(player, stage.link("blocks"))
    fill(page)
    player.faces().choose(0).next().wait_generation("Generation 1")
    page.route("**/events", lambda route: route.abort())
    player.choose(2)
    before = len(events(stage, page, 1))
    page.locator("#next").click()
    page.get_by_role("heading", name="Judging a face").wait_for(state="attached")
    page.unroute("**/events")
    with page.expect_response("**/events") as sent:
        page.reload()
    assert sent.value.ok
    kinds = [kind for kind, *_ in events(stage, page, 1)]
    assert before == 0
    assert kinds[0] == "onset" and kinds.count("select") == 1


def test_whoever_comes_by_keyboard_answers_at_once(stage, player):
    page = player.begin(stage.link("small")).page
    page.locator("#select-1").focus()
    for number in range(3):
        player.wait_generation(f"Generation {number} of" if number else "First faces")
        page.keyboard.press("Space")
        page.keyboard.press("Enter")
    page.wait_for_selector("#intensity:focus")
    page.keyboard.press("6")
    assert page.locator("#intensity-6").is_checked()
    page.keyboard.press("Enter")
    assert page.evaluate("document.activeElement.id") == "summary", "the second question is open"


def test_a_key_that_is_held_sends_no_page(stage, player):
    page = to_questions(player, stage.link("blocks"))
    page.get_by_label("How old are you?").focus()
    page.keyboard.down("Enter")
    assert page.locator("#summary").is_visible()
    page.reload()
    page.get_by_label("How old are you?").focus()
    page.keyboard.down("Enter")
    page.keyboard.up("Enter")
    assert page.locator("#summary").is_hidden(), "the key was down all the time"


def test_a_mouse_leaves_the_focus_alone(stage, player):
    page = to_questions(player, stage.link("blocks"))
    assert page.evaluate("document.activeElement === document.body")


def test_from_practice_to_the_first_faces_by_keyboard(stage, player):
    page = player.arrive(stage.link("small")).agree().read().page
    page.locator("#select-1").focus()
    page.keyboard.press("Space")
    page.keyboard.press("Enter")
    page.wait_for_selector("[data-generation]")
    page.wait_for_selector("#select-1:focus")
    assert page.evaluate("document.activeElement.id") == "select-1"
