"""The words of an item's questions: those that the study wrote, or those of the page for questions that it names."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, TypeAlias

if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Mapping

    from .catalogue import Catalogue

Words = dict[str, Any]
Own: TypeAlias = "Callable[[str], str]"
PREFIX = "q-"
"""What a question's name begins with in a form, so that it is never the name of another field."""


_LIMITED = {
    (): "number", ("least",): "number_from", ("most",): "number_to", ("least", "most"): "number_between",
}  # fmt: skip


def _as_it_is(text: str) -> str:
    return text


def asked(words: Catalogue, item: Mapping[str, Any], own: Own = _as_it_is) -> dict[str, Words]:
    """Return for each question how it is asked, the ends of its scale, its options, and what is said if it is open.

    `own` says the study's words in the language of the page; the values of options stay as the study has them.
    """
    fields = item["questions"]
    return {field["name"]: (_own if field["text"] else _known)(words, item, field, own) for field in fields}


def open_questions(
    words: Catalogue, item: Mapping[str, Any], names: Collection[str], own: Own = _as_it_is
) -> dict[str, str]:
    """Return what is said at the questions of these names, by the names of their fields, in the order of the page."""
    said = asked(words, item, own)
    return {
        PREFIX + field["name"]: said[field["name"]]["missing"] for field in item["questions"] if field["name"] in names
    }


def _own(words: Catalogue, item: Mapping[str, Any], field: Mapping[str, Any], own: Own) -> Words:
    ask = words.isolated(own(field["text"]).replace("{emotion}", _noun(words, item)))
    limits = {"least": field["least"], "most": field["most"]}
    shown = {name: words.number(f"{value:g}") for name, value in limits.items() if value is not None}
    kind = _LIMITED[tuple(shown)] if field["kind"] == "number" else field["kind"]
    missing = words.say(f"items.missing.{kind}", ask=ask, **shown)
    options = [(option, words.isolated(own(option))) for option in field["options"]]
    ends = {end: words.isolated(own(field[end])) for end in ("low", "high")}
    return {"ask": ask, **ends, "options": options, "missing": missing}


def _known(words: Catalogue, item: Mapping[str, Any], field: Mapping[str, Any], own: Own) -> Words:
    name, noun = field["name"], _noun(words, item)
    key = f"rating.questions.{name}" if noun else f"items.{name}"
    said = {part: words.say(f"{key}.{part}", emotion=noun) for part in ("ask", "missing")}
    ends = {part: words.entry(key).get(part, "") for part in ("low", "high")}
    return {**said, **ends, "options": [(label, _label(words, item, label, own)) for label in field["options"]]}


def _label(words: Catalogue, item: Mapping[str, Any], label: str, own: Own) -> str:
    if label == "none_of_these":
        return str(words.say("items.label.none_of_these"))
    known = item["labels"].get(label)
    return words.noun(label, known["noun"]).label if known else words.isolated(own(label))


def _noun(words: Catalogue, item: Mapping[str, Any]) -> str:
    return words.noun(item["emotion"], item["noun"]) if item.get("emotion") else ""
