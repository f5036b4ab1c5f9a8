"""Damaged files, by the hundred: each is read or refused, and nothing else happens."""

import json
import random
from dataclasses import replace

import pytest

from emogen_core.errors import InvalidInputError
from emogen_core.rigs.foreign.read import read_head
from tests.emogen_core.rigs.foreign.heads import glb, gltf_of, made_head

WRONG = (None, -1, 0, 1, 3, 99, 1e9, 2**40, "x", "", [], {}, True, [1, 2], {"a": 1}, -0.5, float("nan"))


@pytest.fixture(scope="module")
def whole():
    head = made_head()
    return gltf_of(replace(head, expressions={name: head.expressions[name] for name in ("jawOpen", "eyeBlink_L")}))


def places(value, before=()):
    items = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    for key, inner in items:
        yield (*before, key)
        yield from places(inner, (*before, key))


def refusal(path, data):
    """What is said of a file that is refused; nothing of one that is read. Any other error is a fault."""
    path.write_bytes(data)
    try:
        read_head(path)
    except InvalidInputError as refused:
        return str(refused)
    return ""


def test_documents_with_something_wrong_or_missing(whole, tmp_path):
    chance = random.Random(7)
    text = json.dumps(whole.document | {"buffers": [{"byteLength": len(whole.data)}]})
    known = list(places(json.loads(text)))
    refusals = 0
    for _ in range(250):
        document = json.loads(text)
        *most, last = chance.choice(known)
        inner = document
        for step in most:
            inner = inner[step]
        inner[last] = chance.choice(WRONG)
        refusals += bool(refusal(tmp_path / "head.glb", glb(json.dumps(document).encode(), whole.data)))
    assert refusals > 100


def test_bytes_that_are_others(whole, tmp_path):
    chance = random.Random(7)
    told = []
    for _ in range(100):
        data = bytearray(whole.glb())
        for _ in range(chance.randint(1, 20)):
            data[chance.randrange(len(data))] = chance.randrange(256)
        told.append(refusal(tmp_path / "head.glb", bytes(data)))
    # Most bytes are digits of coordinates, whose change nobody can see; others make the file unreadable.
    assert "" in told
    assert all("expected" in sentence and ", got " in sentence for sentence in told if sentence)
    assert any(told)
