"""Word catalogues: ``templates/words/<language>.json``, whole sentences with named places.

A sentence is a string, or a table of plural forms from which ``count`` chooses. Templates are trusted, the values put
into them are escaped unless they are markup already. An emotion's word brings its grammatical forms along: where
``{emotion}`` is the noun, ``{emotion_of}`` is its form *of* (docs/languages.md).
"""

from __future__ import annotations

import json
from dataclasses import dataclass, field, replace
from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

from markupsafe import Markup, escape

from .emotions import EmotionWord, MarkedWord
from .plurals import plural

if TYPE_CHECKING:
    from collections.abc import Mapping

FALLBACK = "en"
FIRST_STRONG, END = "\u2068", "\u2069"
"""Unicode's isolates: what stands between them has the direction of its own first letter."""


@dataclass(frozen=True)
class Catalogue:
    """All words of one language."""

    words: dict[str, Any]
    english: dict[str, Any] = field(default_factory=dict)
    """The emotions' English words, by which a study written in English is understood."""
    own: Mapping[str, str] = field(default_factory=dict)
    """A study's own nouns in this language, by its adjectives."""

    @property
    def code(self) -> str:
        """The language's BCP 47 code."""
        return str(self.words["language"]["code"])

    @property
    def direction(self) -> str:
        """``ltr`` or ``rtl``."""
        return str(self.words["language"]["direction"])

    def say(self, key: str, **values: Any) -> Markup:
        """Return the sentence of a dotted key with its places filled."""
        entry = self.entry(key)
        if isinstance(entry, dict):
            entry = entry.get(plural(self.code, values["count"]), entry["other"])
        filled = {name: self._fill(value) for name, value in values.items()}
        if "emotion" in values:
            filled |= self._forms(values["emotion"])
        return Markup(escape(entry)).format(**filled)  # noqa: S704 - catalogue text, escaped just before

    def entry(self, key: str) -> Any:
        """Return what stands under a dotted key, a sentence or a table of them."""
        found: Any = self.words
        for part in key.split("."):
            found = found[part]
        return found

    def noun(self, emotion: str, fallback: str) -> EmotionWord:
        """Return the word of an emotion: the study's own in this language, else the catalogue's, else the fallback.

        A word that the catalogue has, whoever says it, brings its grammatical forms along.
        """
        meant = self.own.get(emotion, fallback)
        found = self._known(emotion, meant)
        if found is None:
            return EmotionWord(meant, self.words.get("unknown_emotion", {}))
        return EmotionWord(_noun(found), found if isinstance(found, dict) else {})

    def with_nouns(self, nouns: Mapping[str, str]) -> Catalogue:
        """Return these words with a study's own words for emotions."""
        return replace(self, own={**self.own, **nouns})

    def word(self, number: int) -> str:
        """Return a small number as a word, a larger one in digits."""
        return str(self.words["numbers"].get(str(number), self.number(number)))

    def number(self, number: int | str) -> str:
        """Return a number in the digits of this language, with its decimal mark."""
        language = self.words["language"]
        return str(number).translate(str.maketrans("0123456789.", language["digits"] + language.get("decimal", ".")))

    def isolated(self, text: str) -> str:
        """Return a study's own text so that it may run the other way than the page: "£4.20 via Prolific" in Arabic."""
        return f"{FIRST_STRONG}{text}{END}" if text and self.direction == "rtl" else text

    def _fill(self, value: Any) -> Any:
        return self.number(value) if isinstance(value, int) else value

    def _forms(self, word: Any) -> dict[str, Markup]:
        if not isinstance(word, EmotionWord | MarkedWord):
            word = EmotionWord(word, self.words.get("unknown_emotion", {}))
        return {f"emotion_{name}": form for name, form in word.forms.items()}

    def _known(self, emotion: str, noun: str) -> dict[str, str] | str | None:
        """Return what the catalogue has on an emotion: by its adjective, or by the noun where the study has its own."""
        table: dict[str, dict[str, str] | str] = self.words["emotions"]
        if emotion in table and emotion not in self.own:
            return table[emotion]
        named = (name for name in (emotion, *table) if name in table and noun in self._names(name))
        return next((table[name] for name in named), None)

    def _names(self, emotion: str) -> set[str]:
        """Return the words by which a study may mean an emotion of the catalogue."""
        own, english = self.words["emotions"][emotion], self.english.get(emotion, emotion)
        return {emotion, _noun(own), _noun(english)}


@lru_cache(maxsize=64)
def load_catalogue(folder: Path, language: str) -> Catalogue:
    """Read the catalogue of a language or of a region's language, English where there is none yet."""
    base = _read(folder / f"{FALLBACK}.json")
    main, _, region = language.partition("-")
    if main not in languages(folder):
        return Catalogue(base, base.get("emotions", {}))
    words = base if main == FALLBACK else _over(base, _read(folder / f"{main}.json"))
    return Catalogue(_regional(words, region), base.get("emotions", {}))


def languages(folder: Path) -> list[str]:
    """List the languages that have a catalogue."""
    return sorted(path.stem for path in folder.glob("*.json"))


def _read(path: Path) -> dict[str, Any]:
    return dict(json.loads(path.read_text(encoding="utf-8")))


def _over(base: dict[str, Any], words: dict[str, Any]) -> dict[str, Any]:
    """Lay a catalogue over another: a sentence that is not translated yet stays in the base language."""
    merged = dict(base)
    for key, value in words.items():
        nested = isinstance(value, dict) and isinstance(base.get(key), dict) and "other" not in value
        merged[key] = _over(base[key], value) if nested else value
    return merged


def _regional(words: dict[str, Any], region: str) -> dict[str, Any]:
    """Return the words with a region's digits, also where a sentence spells a number out in them."""
    language = words["language"]
    if region not in language.get("regions", {}):
        return words
    changes = language["regions"][region]
    text = json.dumps(words, ensure_ascii=False).translate(str.maketrans(language["digits"], changes["digits"]))
    return {**json.loads(text), "language": language | changes}


def _noun(entry: dict[str, str] | str) -> str:
    return entry["noun"] if isinstance(entry, dict) else entry
