"""A whole study with every kind of block, by keyboard alone."""

import json

import pytest

from tests.browser.stage import participation_of

from .test_participation import focus_by_tab, press

pytestmark = pytest.mark.browser


def test_every_block_by_keyboard(stage, player):
    page = player.page
    page.goto(stage.link("blocks"))
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

    page.get_by_role("heading", name="About you").wait_for()
    page.wait_for_load_state()
    focus_by_tab(page, "[name=q-age]")
    page.keyboard.type("41")
    focus_by_tab(page, "[name=q-gender]")
    press(page, "Space")
    focus_by_tab(page, "[name=q-mood]")
    press(page, "6")
    focus_by_tab(page, "form[data-answer] .actions button")
    press(page, "Enter")

    player.faces()
    focus_by_tab(page, "#select-1")
    press(page, "ArrowDown", "Space", "Enter")
    player.wait_generation("Generation 1")
    page.wait_for_selector("#select-1:focus")
    press(page, "End", "b", "z")
    page.wait_for_selector("#enlarged[open]")
    press(page, "Escape")
    page.wait_for_selector("#select-10:focus")
    press(page, "Enter")

    page.get_by_role("heading", name="Judging a face").wait_for(state="attached")
    page.wait_for_load_state()
    focus_by_tab(page, "[name=q-intensity]")
    press(page, "5", "Enter")
    page.get_by_role("heading", name="Naming an expression").wait_for(state="attached")
    page.wait_for_load_state()
    focus_by_tab(page, "[name=q-label]")
    press(page, "ArrowDown")
    for name, key in (("intensity", "3"), ("confidence", "7")):
        focus_by_tab(page, f"[name=q-{name}]")
        press(page, key)
    press(page, "Enter")
    page.get_by_role("heading", name="You have finished").wait_for()

    stored = stage.rows(
        "SELECT r.question, r.value FROM responses r JOIN trials t ON t.id = r.trial_id WHERE t.participation_id = ?",
        participation_of(stage, page),
    )
    said = {question: json.loads(value) for question, value in stored if question != "intensity"}
    assert said == {"age": [41], "gender": ["woman"], "mood": [6], "words": [], "label": ["sad"], "confidence": [7]}
    strengths = sorted(json.loads(value) for question, value in stored if question == "intensity")
    assert strengths == [[3], [5]]
