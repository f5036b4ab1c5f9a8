"""A study's own words in one of its languages. Pure: what is stored keeps the study's words (docs/study.md)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from .parts import Emotion, Texts

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from .study import StudyConfig


@dataclass(frozen=True)
class Spoken:
    """What a study says in one language; what it has no words for there stays in its own language.

    Attributes:
        language: the language.
        title: the study's title.
        texts: what it says about itself.
        emotions: words of emotions by the adjective in the data: those that the study itself has in this language.
        words: other words by the study's own.
    """

    language: str
    title: str
    texts: Texts
    emotions: Mapping[str, Emotion]
    words: Mapping[str, str]

    def say(self, text: str) -> str:
        """Return a question or an answer of a block in this language."""
        return self.words.get(text) or text


def offered_languages(study: StudyConfig) -> tuple[str, ...]:
    """Return the languages that a study speaks, its own first."""
    return (study.language, *study.translations)


def in_language(study: StudyConfig, language: str) -> Spoken:
    """Return a study's own words in a language; in its own where it does not speak that one."""
    own = {emotion.adjective: emotion for emotion in (*study.emotions, *filter(None, [study.practice]))}
    spoken = study.translations.get(language)
    if spoken is None:
        return Spoken(study.language, study.title, study.texts, own, {})
    texts = Texts(**{name: getattr(spoken.texts, name) or getattr(study.texts, name) for name in Texts.model_fields})
    return Spoken(language, spoken.title or study.title, texts, spoken.emotions, spoken.words)


def preferred(offered: Sequence[str], wanted: Sequence[str]) -> str:
    """Return the first wanted language that is offered, a region aside where need be; else the first offered."""
    for one in wanted:
        for test in (_same, _related):
            found = next((language for language in offered if test(language, one)), None)
            if found is not None:
                return found
    return offered[0]


def _same(language: str, wanted: str) -> bool:
    return language.lower() == wanted.lower()


def _related(language: str, wanted: str) -> bool:
    return _primary(language) == _primary(wanted)


def _primary(language: str) -> str:
    return language.split("-", maxsplit=1)[0].lower()
