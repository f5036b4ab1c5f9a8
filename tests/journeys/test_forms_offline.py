"""Questions, judged faces and ratings go through the same outbox as choices, each answer with its own id."""

import json

import pytest

from tests.browser.stage import participation_of

from .record import answers
from .wire import wired

pytestmark = pytest.mark.browser

STORED = (
    "SELECT t.kind, r.item, r.question, r.value, r.onset_ms, r.answered_ms FROM responses r"
    " JOIN trials t ON t.id = r.trial_id WHERE t.participation_id = ? ORDER BY t.position, r.item, r.question"
)


def to_questions(player, address):
    page = player.arrive(address).agree().page
    page.locator("form[data-answer] button").click()
    page.get_by_role("heading", name="About you").wait_for()
    page.wait_for_load_state()
    return page


def fill(page):
    page.get_by_label("How old are you?").fill("34")
    page.get_by_label("woman").check()
    page.locator(".boxes input").nth(4).check()
    page.get_by_role("button", name="Next").click()


def test_every_page_with_lost_replies(stage, player):
    with wired(stage.address) as wire:
        page = to_questions(player, stage.link("blocks").replace(stage.address, wire.address))
        before = answers(stage, page)
        wire.lose = 2
        fill(page)
        player.faces().choose(0).next().wait_generation("Generation 1").choose(2).next()
        page.get_by_role("heading", name="Judging a face").wait_for(state="attached")
        page.wait_for_load_state()
        wire.lose = 2
        page.locator(".boxes input").nth(3).check()
        page.get_by_role("button", name="Next").click()
        page.get_by_role("heading", name="Naming an expression").wait_for(state="attached")
        page.wait_for_load_state()
        wire.cut = True
        page.get_by_label("sad").check()
        for scale in page.locator(".boxes").all():
            scale.locator("input").nth(5).check()
        page.get_by_role("button", name="Next").click()
        page.get_by_role("heading", name="Your answer is safe on this device").wait_for()
        wire.cut = False
        page.get_by_role("heading", name="You have finished").wait_for()
    rows = stage.rows(STORED, participation_of(stage, page))
    assert [(kind, question, json.loads(value)) for kind, _, question, value, *_ in rows] == [
        ("questionnaire", "age", [34]), ("questionnaire", "gender", ["woman"]), ("questionnaire", "mood", [5]),
        ("questionnaire", "words", []), ("rate", "intensity", [4]), ("categorise", "confidence", [6]),
        ("categorise", "intensity", [6]), ("categorise", "label", ["sad"]),
    ]  # fmt: skip
    assert all(0 < onset < answered for *_, onset, answered in rows)
    assert answers(stage, page) == before + 5


def test_closed_while_an_answer_to_questions_waits(stage, player):
    page = to_questions(player, stage.link("blocks"))
    context, address = page.context, page.url
    context.set_offline(True)
    fill(page)
    page.get_by_role("heading", name="Your answer is safe on this device").wait_for()
    page.close()
    context.set_offline(False)
    again = context.new_page()
    again.goto(address)
    again.wait_for_selector("#grid.shown")
    ages = [json.loads(value) for _, _, question, value, *_ in stage.rows(STORED, participation_of(stage, again))
            if question == "age"]  # fmt: skip
    assert ages == [[34]]


def test_questions_in_two_tabs(stage, player):
    page = to_questions(player, stage.link("blocks"))
    other = page.context.new_page()
    other.goto(page.url)
    fill(page)
    page.wait_for_selector("#grid.shown")
    before = answers(stage, page)
    fill(other)
    other.wait_for_selector("#grid.shown")
    assert answers(stage, page) == before
    other.close()
