"""Languages by their names: those that the pages have words in, and others whose pages are in English."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cache
from typing import TYPE_CHECKING

from ....assets import asset
from .leaves import Line
from .node import Choice

if TYPE_CHECKING:
    from .node import Node

_NAMES = (
    "ar Arabic, bg Bulgarian, bn Bengali, ca Catalan, cs Czech, da Danish, de German, el Greek, en English, es Spanish,"
    " et Estonian, eu Basque, fa Persian, fi Finnish, fr French, ga Irish, gl Galician, he Hebrew, hi Hindi,"
    " hr Croatian, hu Hungarian, id Indonesian, is Icelandic, it Italian, ja Japanese, ko Korean, lt Lithuanian,"
    " lv Latvian, ms Malay, nb Norwegian, nl Dutch, pl Polish, pt Portuguese, pt-BR Portuguese of Brazil, ro Romanian,"
    " ru Russian, sk Slovak, sl Slovenian, sr Serbian, sv Swedish, sw Swahili, ta Tamil, th Thai, tr Turkish,"
    " uk Ukrainian, ur Urdu, vi Vietnamese, zh Chinese, zh-TW Chinese of Taiwan"
)
NAMES = {code: name for code, _, name in (one.partition(" ") for one in _NAMES.split(", "))}
"""English names of languages by their codes."""


def language_name(code: str) -> str:
    """Return a language as a person says it, with its code; the code alone where it has no name here."""
    return f"{NAMES[code]} ({code})" if code in NAMES else code


@cache
def spoken_by_pages() -> frozenset[str]:
    """Return the languages that the participants' pages have words in."""
    return frozenset(path.stem for path in (asset("templates") / "words").glob("*.json"))


def choices(typed: str) -> list[Choice]:
    """Return the languages to choose from, those of the pages first, and what is typed where it is another one."""
    pages = spoken_by_pages()
    first = [Choice(code, language_name(code)) for code in NAMES if code in pages]
    rest = [Choice(code, f"{language_name(code)}, pages in {_pages_of(code)}") for code in NAMES if code not in pages]
    known = {"", *NAMES}
    return [
        *sorted(first, key=lambda one: one.label),
        *sorted(rest, key=lambda one: one.label),
        *([] if typed in known else [Choice(typed, typed)]),
    ]


@dataclass(frozen=True)
class Tongue(Line):
    """A language."""

    def _shown(self, node: Node) -> Node:
        return chosen(super()._shown(node))


def chosen(node: Node) -> Node:
    """Return a field as one to choose a language from; another code than those of the list stays as it is."""
    node.kind = "choose"
    node.words = replace(node.words, default=language_name(node.words.default) if node.words.default else "")
    nothing = [] if node.value else [Choice("", "Choose a language")]
    node.choices = [*nothing, *choices(node.value)]
    return node


def _pages_of(code: str) -> str:
    base = code.split("-", maxsplit=1)[0]
    return NAMES[base] if base in spoken_by_pages() else "English"
