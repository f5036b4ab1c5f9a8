"""A person takes part from the link to the code: by mouse, by keyboard alone, on a phone, without script."""

from __future__ import annotations

import json

import pytest

from tests.browser.stage import participation_of, sent

pytestmark = pytest.mark.browser

CHOICES = (
    "SELECT g.number, c.selected, c.elite_face_id, c.input, c.onset_ms, c.chosen_ms, c.tile_width FROM choices c"
    " JOIN generations g ON c.generation_id = g.id JOIN trials t ON g.trial_id = t.id"
    " WHERE t.participation_id = ? AND NOT t.practice ORDER BY t.position, g.number"
)


def finish_trial(player, generations, choose):
    """Answer every generation of a trial, from the first faces on."""
    for number in range(generations + 1):
        label = f"Generation {number} of" if number else "First faces"
        player.wait_generation(label)
        choose(number)


def test_four_emotions_by_mouse(stage, player):
    player.begin(stage.link("full", "?PROLIFIC_PID=abc123&other=1"))

    def choose(number):
        player.choose(number % 10, (number + 3) % 10, best=number % 10).next()

    for trial in range(4):
        assert f"Face set {trial + 1} of 4" in player.page.locator("#progress").inner_text()
        finish_trial(player, 10, choose)
        player.rate(5, 6)
    player.page.get_by_role("heading", name="You have finished. Thank you.").wait_for()
    who = participation_of(stage, player.page)
    code = player.page.locator(".code.main code").inner_text()
    assert stage.rows("SELECT outcome, completion_code FROM participations WHERE id = ?", who) == [("complete", code)]
    choices = stage.rows(CHOICES, who)
    assert len(choices) == 4 * 11
    for number, selected, elite, kind, onset, chosen, tile in choices:
        assert len(json.loads(selected)) == 2 and elite in json.loads(selected), number
        assert kind == "mouse" and chosen - onset >= 250 and tile == 234
    assert stage.one("SELECT recruiter FROM participations WHERE id = ?", who) == '{"PROLIFIC_PID": "abc123"}'
    rated = "SELECT question, value FROM ratings r JOIN trials t ON r.trial_id = t.id WHERE t.participation_id = ?"
    assert sorted(stage.rows(rated, who)) == [("intensity", 5)] * 4 + [("satisfaction", 6)] * 4


def press(page, *keys):
    for key in keys:
        page.keyboard.press(key)


def focus_by_tab(page, selector, limit=30):
    """Go on with Tab until a control has the focus."""
    for _ in range(limit):
        if page.evaluate("selector => document.activeElement.matches(selector)", selector):
            return
        page.keyboard.press("Tab")
    raise AssertionError(f"{selector} cannot be reached with Tab")


def test_keyboard_alone(stage, player):
    page = player.page
    page.goto(stage.link("small"))
    focus_by_tab(page, "main form button")
    press(page, "Enter")
    page.wait_for_url("**/p/*")
    for name in ("age", "read", "keep"):
        focus_by_tab(page, f"#{name}")
        press(page, "Space")
    focus_by_tab(page, "button[value=true]")
    press(page, "Enter")
    page.wait_for_selector(".steps")
    focus_by_tab(page, "form[data-answer] button")
    press(page, "Enter")
    player.faces()
    focus_by_tab(page, "#select-1")
    press(page, "Space", "Enter")
    page.wait_for_selector("[data-generation]")
    player.faces()
    focus_by_tab(page, "#select-1")
    for number in range(3):
        player.wait_generation(f"Generation {number} of" if number else "First faces")
        page.wait_for_selector("#select-1:focus")
        press(page, "ArrowRight", "Space", "ArrowDown", "b")
        assert player.status() == "Selected 2 · best chosen"
        press(page, "Control+z")
        assert player.status() == "Selected 1 · best chosen"
        press(page, "b", "z")
        page.wait_for_selector("#enlarged[open]")
        press(page, "ArrowRight", "Space", "Escape")
        page.wait_for_selector("#select-8:focus")
        assert player.status() == "Selected 3 · best chosen"
        press(page, "Enter")
    page.wait_for_selector(".rating")
    page.wait_for_load_state()
    for question, key in (("intensity", "4"), ("satisfaction", "7")):
        focus_by_tab(page, f"#{question}")
        press(page, key)
    press(page, "Enter")
    page.get_by_role("heading", name="You have finished. Thank you.").wait_for()
    who = participation_of(stage, page)
    choices = stage.rows(CHOICES, who)
    assert [(number, len(json.loads(selected)), kind) for number, selected, _, kind, *_ in choices] == [
        (number, 3, "keyboard") for number in range(3)
    ]


def test_one_generation_on_a_phone(stage, phone):
    phone.begin(stage.link("small"))
    page = phone.page
    assert "See all ten faces" in page.locator("#next").inner_text()
    phone.tile(0).locator(".face").tap()
    phone.tile(1).locator(".face").tap()
    assert phone.status() == "Selected 2 · mark the closest"
    phone.next()
    assert phone.status() == "Mark the closest of the 2 faces you chose."
    phone.tile(1).locator(".strip").tap()
    assert phone.status() == "Selected 2 · best chosen"
    page.locator("#next").tap()
    phone.wait_generation("Generation 1 of")
    assert page.evaluate("scrollY") == 0
    [(number, selected, _, kind, *_)] = stage.rows(CHOICES, participation_of(stage, page))
    assert (number, len(json.loads(selected)), kind) == (0, 2, "touch")


def test_plain_form_without_script(stage, browser):
    context = browser.new_context(java_script_enabled=False)
    page = context.new_page()
    page.goto(stage.link("small"))
    sent(page, "main form button")
    sent(page, "button[value=true]")
    assert page.title().startswith("Error:")
    for label in page.locator(".statement label").all():
        label.click()
    sent(page, "button[value=true]")
    sent(page, "form[data-answer] button")
    for chosen in ((3,), (2, 6)):
        for place in chosen:
            page.locator(".tile").nth(place).locator(".face").click()
        if len(chosen) > 1:
            sent(page, "#next")
            assert "Mark the closest of the 2 faces" in page.locator("#status").inner_text()
            assert page.locator(".select:checked").count() == 2
        page.locator(".tile").nth(chosen[-1]).locator(".strip").click()
        sent(page, "#next")
    assert page.locator("[data-generation]").inner_text() == "Generation 1 of 2"
    assert len(stage.rows(CHOICES, participation_of(stage, page))) == 1
    context.close()
