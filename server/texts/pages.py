"""Participant pages from templates: words, direction and surround are set in one place."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

from jinja2 import Environment, FileSystemLoader, StrictUndefined, select_autoescape
from markupsafe import Markup, escape

from .catalogue import Catalogue, load_catalogue

# What a study may say about itself; a page leaves out what is not there.
STUDY = {
    "title": "",
    "organisation": "",
    "contact_name": "",
    "contact": "",
    "ethics": "",
    "minutes": 0,
    "payment": "",
    "device": "",
    "erase_until": "",
    "about": "",
    "example": "surprised",
    "generations": 10,
    "practice": True,
}


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
        self._environment.globals.update(bold=_tagged("b"), underlined=_tagged("u"))

    def catalogue(self, language: str) -> Catalogue:
        """Return the words of a language."""
        return load_catalogue(self._words, language)

    def render(self, template: str, language: str, **context: Any) -> str:
        """Return the page as HTML."""
        words = self.catalogue(language)
        study = STUDY | {name: value for name, value in context.pop("study", {}).items() if value is not None}
        page = {"surround": "light", "address": "", "errors": {}} | context | {"study": study}
        return self._environment.get_template(template).render(words=words, t=words.say, **page)


def _tagged(tag: str) -> Callable[[Any], Markup]:
    def wrap(text: Any) -> Markup:
        return Markup("<{0}>{1}</{0}>").format(Markup(tag), escape(text))  # noqa: S704 - the tag is one of ours

    return wrap
