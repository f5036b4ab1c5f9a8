"""Questions and judged faces in Chromium: by mouse and keys, what is missing, what is stored."""

import json

from tests.browser.conditions import until

from .stage import participation_of


def test_what_is_missing_is_marked_from_its_question_on(stage, player):
    """The bar at the side of a question begins at the question; a fieldset's own border would begin below it."""
    page = player.arrive(stage.link("blocks")).agree().page
    page.locator("form[data-answer] button").click()
    page.get_by_role("heading", name="About you").wait_for()
    page.wait_for_load_state()
    page.get_by_role("button", name="Next").click()
    page.locator("fieldset.wrong").first.wait_for()
    for field in page.locator("fieldset.wrong").all():
        legend, message = field.locator("legend"), field.locator(".missing")
        assert field.bounding_box()["y"] <= legend.bounding_box()["y"] + 1
        assert legend.evaluate("node => getComputedStyle(node).float") == "inline-start"
        assert message.bounding_box()["y"] >= legend.bounding_box()["y"] + legend.bounding_box()["height"] - 1


def test_the_ways_to_stop_are_buttons_of_one_width(stage, player):
    page = player.arrive(stage.link("blocks")).agree().page
    page.wait_for_load_state()
    page.get_by_role("link", name="Stop taking part").click()
    for width, rows in ((1280, 2), (360, 3)):
        page.set_viewport_size({"width": width, "height": 740})
        boxes = [button.bounding_box() for button in page.locator("#stop .button").all()]
        assert abs(boxes[0]["width"] - boxes[1]["width"]) < 1
        assert len({round(box["y"]) for box in boxes}) == rows
        ends = [box["x"] + box["width"] for box in boxes]
        assert abs(ends[2] - max(ends)) < 1 and abs(boxes[2]["x"] - boxes[0]["x"]) < 1


def test_questions_and_judged_faces(stage, player):
    page = player.arrive(stage.link("blocks")).agree().page
    page.locator("form[data-answer] button").click()
    page.get_by_role("heading", name="About you").wait_for()
    page.wait_for_load_state()  # before its script is there, Next posts a plain form, which knows no times
    page.get_by_role("button", name="Next").click()
    until(page, page.locator("#summary li").count, lambda count: count == 3)
    assert "Enter a number from 18 to 110" in page.locator("#summary").inner_text()
    page.get_by_label("How old are you?").fill("7")
    page.get_by_label("woman").check()
    page.locator(".boxes input").nth(4).check()
    page.get_by_role("button", name="Next").click()
    until(page, page.locator("#summary li").count, lambda count: count == 1)
    page.get_by_label("How old are you?").fill("34")
    page.get_by_role("button", name="Next").click()

    player.faces().choose(0).next().wait_generation("Generation 1")
    player.choose(2).next()
    page.get_by_role("heading", name="Judging a face").wait_for(state="attached")
    page.wait_for_load_state()
    page.locator(".boxes input").first.focus()
    page.keyboard.press("5")
    page.keyboard.press("Enter")
    page.get_by_role("heading", name="Naming an expression").wait_for(state="attached")
    page.wait_for_load_state()
    page.get_by_label("sad").check()
    page.locator(".boxes").nth(1).locator("input").nth(5).check()
    page.get_by_role("button", name="Next").click()
    page.get_by_role("heading", name="You have finished").wait_for()

    who = participation_of(stage, page)
    stored = stage.rows(
        "SELECT r.question, r.value, r.onset_ms, r.answered_ms FROM responses r JOIN trials t ON t.id = r.trial_id"
        " WHERE t.participation_id = ? ORDER BY t.position, r.question", who,
    )  # fmt: skip
    said = {question: json.loads(value) for question, value, *_ in stored}
    assert said["age"] == [34]
    assert (said["gender"], said["mood"], said["words"]) == (["woman"], [5], [])
    assert said["label"] == ["sad"]
    assert said["confidence"] == [6]
    assert all(0 < onset < answered for *_, onset, answered in stored)
