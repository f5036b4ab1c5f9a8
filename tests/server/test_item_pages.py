"""Pages of trials without generations, without script: what they ask, what they say is missing, how they go on."""

import re

import pytest

from tests.conftest import small_study
from tests.server.walker import Walker

AGE = {"name": "age", "kind": "number", "text": "Your age?", "least": 18, "most": 110}
MOOD = {"name": "mood", "kind": "multiple", "text": "Your mood?", "options": ["calm", "<tense>"], "required": False}
ABOUT = {"kind": "questionnaire", "name": "about", "title": "About you", "items": [AGE, MOOD]}
FIRST = {"kind": "evolve", "name": "first"}
READ = {"kind": "categorise", "name": "read"}
RATE = {"kind": "rate", "name": "rate", "questions": ["intensity"]}


def begun(house, client, *blocks):
    made = house.studies.create(small_study(blocks=blocks, practice=None, generations=1, ratings=()))
    walker = Walker(client, made.links[0])
    state = walker.start()
    while state["step"] == "evolve":
        state = walker.step(state)
    return walker, state


def hidden(page):
    return dict(re.findall(r'type="hidden" name="(\w+)" value="([^"]*)"', page))


LIMITED = [
    {"name": name, "kind": "number", "text": f"{name}?", **limits}
    for name, limits in {"any": {}, "from": {"least": 2}, "to": {"most": 9}}.items()
]


def test_every_answer_that_cannot_be_taken_is_named_at_once(house, client):
    """Nobody repairs what is empty only to be told then that a number is out of its limits."""
    block = {"kind": "questionnaire", "name": "about", "items": [AGE, *LIMITED]}
    walker, _ = begun(house, client, block)
    page = client.get(walker.address).text
    said = {"q-age": "7", "q-any": "many", "q-from": "1", "q-to": ""}
    reply = client.post(f"{walker.address}/answers/form", data={**hidden(page), **said})
    summary = re.search(r'id="summary".*?</ul>', reply.text, re.DOTALL)[0]
    assert re.findall(r"<a href=\"#([\w-]+)\">([^<]+)<", summary) == [
        ("q-age", "Enter a number from 18 to 110: Your age?"), ("q-any", "Enter a number: any?"),
        ("q-from", "Enter a number of at least 2: from?"), ("q-to", "Enter a number of at most 9: to?"),
    ]  # fmt: skip


def test_a_questionnaire_as_a_plain_form(house, client):
    walker, _ = begun(house, client, ABOUT)
    page = client.get(walker.address).text
    assert "<h1>About you</h1>" in page
    assert "&lt;tense&gt;" in page
    reply = client.post(f"{walker.address}/answers/form", data={**hidden(page), "q-mood": "calm", "q-age": ""})
    assert reply.status_code == 422
    assert "Enter a number from 18 to 110: Your age?" in reply.text
    assert re.search(r'value="calm" checked', reply.text)
    reply = client.post(f"{walker.address}/answers/form", data={**hidden(page), "q-age": "12"})
    assert reply.status_code == 422
    assert 'value="12"' in reply.text
    reply = client.post(
        f"{walker.address}/answers/form", data={**hidden(page), "q-age": "30", "q-mood": ["calm", "<tense>"]}
    )
    assert reply.status_code == 303
    assert walker.state()["step"] == "debrief"


@pytest.mark.parametrize(
    ("block", "asks"),
    [
        (READ, ["Which word fits this face best?", "happiness", "anger", "None of these", "How sure are you?"]),
        (RATE, ["How strong is the "]),
    ],
)
def test_a_face_is_shown_with_its_questions(house, client, block, asks):
    walker, state = begun(house, client, FIRST, block)
    page = client.get(walker.address).text
    assert state["item"]["portrait"] in page
    assert "Face 1 of 2" in page
    assert all(ask in page for ask in asks)
    assert f"/static/participant/{state['step']}.js" in page
