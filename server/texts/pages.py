"""Participant pages from templates: words, direction and surround are set in one place."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

from jinja2 import Environment, FileSystemLoader, StrictUndefined, select_autoescape
from markupsafe import Markup, escape

from ..services.config import Texts
from .catalogue import FALLBACK, Catalogue, languages, load_catalogue
from .emotions import EmotionWord

# What a study may say about itself; a page leaves out what is not there.
STUDY: dict[str, Any] = {"title": "", **Texts().model_dump()}
# Texts of the study in whatever script they are; an address for mail is part of a link.
OWN_TEXTS = tuple(name for name, value in STUDY.items() if isinstance(value, str) and name != "contact")

# What a page has unless it says otherwise.
PAGE: dict[str, Any] = {
    "surround": "light", "address": "", "errors": {}, "own": str, "preview": None, "lease": None, "tile_height": None,
}  # fmt: skip


class Pages:
    """Renders the participant's templates in the language of a study."""

    def __init__(self, templates: Path) -> None:
        self._words = templates / "words"
        self._environment = Environment(
            loader=FileSystemLoader(templates),
            autoescape=select_autoescape(["html"]),
            undefined=StrictUndefined,
            trim_blocks=True,
            lstrip_blocks=True,
        )
        target = _tagged('<strong class="target">{}</strong>')
        self._environment.globals.update(bold=_tagged("<b>{}</b>"), underlined=_tagged("<u>{}</u>"), target=target)

    def catalogue(self, language: str) -> Catalogue:
        """Return the words of a language."""
        return load_catalogue(self._words, language)

    @property
    def languages(self) -> list[str]:
        """The languages that there are words in, English first."""
        return sorted(languages(self._words), key=lambda code: (code != FALLBACK, code))

    def language_name(self, code: str) -> str:
        """Return how a language calls itself; its code where there is no catalogue of it."""
        words = self.catalogue(code)
        known = words.code.split("-")[0] == code.split("-", maxsplit=1)[0].lower()
        return str(words.words["language"]["name"]) if known else code

    def render(self, template: str, words: Catalogue, **context: Any) -> str:
        """Return the page as HTML."""
        study = STUDY | {name: value for name, value in context.pop("study", {}).items() if value is not None}
        study |= {name: words.isolated(study[name]) for name in OWN_TEXTS if isinstance(study.get(name), str)}
        page = PAGE | context | {"study": study}
        return self._environment.get_template(template).render(words=words, t=words.say, **page)


def _tagged(element: str) -> Callable[[Any], Markup]:
    def wrap(text: Any) -> Markup:
        if isinstance(text, EmotionWord):
            return text.marked(wrap)
        return Markup(element).format(escape(text))  # noqa: S704 - the element is one of ours

    return wrap
