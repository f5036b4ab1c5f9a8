"""One study in each language of the house, with every kind of page, and one that is closed."""

from __future__ import annotations

from .stage import SMALL, TEXTS

LANGUAGES = ("en", "de", "fr", "es", "zh", "ar")
ABOUT = {
    "kind": "questionnaire", "name": "about",
    "items": (
        {"name": "age", "kind": "number", "text": "Age", "least": 18, "most": 110},
        {"name": "gender", "kind": "single", "text": "Gender", "options": ("woman", "man", "other")},
        {"name": "languages", "kind": "multiple", "text": "Languages", "options": ("one", "two", "three")},
        {"name": "mood", "kind": "scale", "text": "Mood", "low": "Very bad", "high": "Very good"},
        {"name": "words", "kind": "text", "text": "Anything to add?", "required": False},
    ),
}  # fmt: skip
CHECK = {"kind": "attention", "name": "check", "text": "Choose sad.", "options": ("sad", "angry"), "right": "sad"}
BLOCKS = (
    ABOUT, CHECK, {"kind": "evolve", "name": "first"}, {"kind": "rate", "name": "strength"},
    {"kind": "categorise", "name": "reading"},
)  # fmt: skip


def study_in(language):
    """Return what differs from the demonstration study."""
    return {
        **SMALL,
        "language": language,
        "title": "Picturing anger",
        "texts": TEXTS,
        "generations": 1,
        "blocks": BLOCKS,
    }


STUDIES = {
    **{language: study_in(language) for language in LANGUAGES},
    **{f"closed-{language}": study_in(language) for language in LANGUAGES},
}
