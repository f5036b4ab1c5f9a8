"""Word catalogues: ``templates/words/<language>.json``, whole sentences with named places.

A sentence is a string, or a table of plural forms from which ``count`` chooses. Templates are trusted, the values put
into them are escaped unless they are markup already.
"""

import json
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any

from markupsafe import Markup, escape

FALLBACK = "en"


@dataclass(frozen=True)
class Catalogue:
    """All words of one language."""

    words: dict[str, Any]

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
            entry = entry[_plural(self.code, values["count"], entry)]
        filled = {name: self._fill(value) for name, value in values.items()}
        return Markup(escape(entry)).format(**filled)  # noqa: S704 - catalogue text, escaped just before

    def entry(self, key: str) -> Any:
        """Return what stands under a dotted key, a sentence or a table of them."""
        found: Any = self.words
        for part in key.split("."):
            found = found[part]
        return found

    def noun(self, emotion: str, fallback: str) -> str:
        """Return the word of an emotion in this language."""
        return str(self.words["emotions"].get(emotion, fallback))

    def word(self, number: int) -> str:
        """Return a small number as a word, a larger one in digits."""
        return str(self.words["numbers"].get(str(number), self.number(number)))

    def number(self, number: int) -> str:
        """Return a number in the digits of this language."""
        return str(number).translate(str.maketrans("0123456789", self.words["language"]["digits"]))

    def _fill(self, value: Any) -> Any:
        return self.number(value) if isinstance(value, int) else value


@lru_cache(maxsize=16)
def load_catalogue(folder: Path, language: str) -> Catalogue:
    """Read the catalogue of a language, English where there is none yet."""
    base = _read(folder / f"{FALLBACK}.json")
    if language == FALLBACK or language not in languages(folder):
        return Catalogue(base)
    return Catalogue(_over(base, _read(folder / f"{language}.json")))


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


def _plural(language: str, count: int, forms: dict[str, str]) -> str:
    """Choose the plural form as CLDR does for the six languages of the house."""
    wanted = _arabic(count) if language == "ar" else _european(language, count)
    return wanted if wanted in forms else "other"


def _european(language: str, count: int) -> str:
    return "one" if count == 1 or (language == "fr" and count == 0) else "other"


def _arabic(count: int) -> str:
    if count <= 2:
        return ("zero", "one", "two")[count]
    rest = count % 100
    if 3 <= rest <= 10:
        return "few"
    return "many" if rest >= 11 else "other"
