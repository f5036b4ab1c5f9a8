"""The documentation of the options is the schema, in words."""

from pathlib import Path

import pytest

from server.services.config.options import MARK, allowed, page, sections

PAGE = Path(__file__).parents[4] / "docs" / "study-options.md"


def test_the_page_is_made_from_the_schema():
    assert PAGE.read_text("utf-8").split(MARK)[1].strip() == page().strip()


def test_every_option_has_words_and_every_link_leads_somewhere():
    text = page()
    names = {section.name.lower() for section in sections()}
    assert {"study", "search", "evolve", "condition"} <= names
    for section in sections():
        assert section.help
        assert all(option.help and option.title and option.allowed for option in section.options), section.name
    links = {part.split(")")[0] for part in text.split("](#")[1:]}
    assert links <= names


@pytest.mark.parametrize(
    ("field", "words"),
    [
        ({"type": "integer", "minimum": 1, "maximum": 30}, "whole number from 1 to 30"),
        ({"type": "number", "minimum": 0, "exclusiveMaximum": 1}, "number from 0 below 1"),
        ({"anyOf": [{"type": "integer"}, {"type": "null"}]}, "whole number or empty"),
        ({"enum": ["a", "b"]}, "`a`, `b`"),
        ({"type": "array", "maxItems": 3, "items": {"type": "string"}}, "list (at most 3) of: text"),
        (
            {"type": "array", "prefixItems": [{"type": "boolean"}] * 2},
            "list of `true` or `false` and `true` or `false`",
        ),
        ({"type": "object", "patternProperties": {"x": {"type": "boolean"}}}, "names, each with: `true` or `false`"),
        ({"type": "object"}, "names with values"),
    ],
)
def test_what_is_allowed_in_words(field, words):
    assert allowed(field) == words
