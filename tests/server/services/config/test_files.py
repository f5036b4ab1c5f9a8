"""Study files in both directions, and files that somebody made by mistake or on purpose."""

import json

import pytest

from server.assets import asset
from server.services.config import DEMO
from server.services.config.files import MOST_BYTES, read_plain, read_study, write_study
from server.services.errors import InvalidError

EXAMPLES = sorted((asset("templates") / "studies").glob("*.yaml"))


@pytest.mark.parametrize("kind", ["yaml", "json"])
def test_a_study_is_the_same_after_a_file(kind):
    text = write_study(DEMO, kind)
    assert read_study(text) == DEMO
    assert read_study(text.encode()).hash() == DEMO.hash()


def test_json_is_read_by_the_same_reader():
    tricky = {"a": [1, 2.5, True, None, "no", "2026-01-01", "1e3", "\u2028", "ä", "x: y"], "b": {"c": ""}}
    assert read_plain(json.dumps(tricky)) == tricky


@pytest.mark.parametrize(("text", "got"), [("a: off", "off"), ("a: no", "no"), ("a: 2026-01-01", "2026-01-01")])
def test_words_stay_words(text, got):
    assert read_plain(text) == {"a": got}
    assert read_plain("a: true") == {"a": True}


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("a: [1", "line 1"),
        ("a: &x [1]\nb: *x", "aliases are not allowed"),
        ("a: 1\na: 2", "'a' stands there twice"),
        ("a: !!python/object:os.system x", "could not determine a constructor"),
        ("a: " + "[" * 5000, "file"),
        (b"\xff\xfe\xfa", "file"),
        ("x" * (MOST_BYTES + 1), "too long"),
    ],
)
def test_files_that_cannot_be_read_say_where_and_why(text, said):
    with pytest.raises(InvalidError) as caught:
        read_plain(text)
    assert said in f"{caught.value.field} {caught.value.message}"


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
def test_the_examples_are_studies(path):
    assert read_study(path.read_text(encoding="utf-8"))


def test_the_default_example_is_the_demonstration():
    assert read_study((asset("templates") / "studies" / "default.yaml").read_text(encoding="utf-8")) == DEMO
    assert {path.stem for path in EXAMPLES} >= {"default", "retest-and-categorise", "children"}
