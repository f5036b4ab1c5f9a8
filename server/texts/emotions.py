"""The word of an emotion with the grammatical forms that sentences need.

A form is named by the language's catalogue (``the``, ``of``, ``to``) and written around ``{noun}``, so that only the
noun is marked in the sentence: "de la COLÈRE". A form without ``{noun}`` is marked as a whole.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Self

from markupsafe import Markup, escape

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

NOUN = "{noun}"


class EmotionWord(str):
    """The plain noun of an emotion, which knows its other forms."""

    __slots__ = ("templates",)
    templates: Mapping[str, str]

    def __new__(cls, noun: str, templates: Mapping[str, str]) -> Self:
        """Make the word from its noun and the templates of its forms."""
        made = super().__new__(cls, noun)
        made.templates = templates
        return made

    @property
    def label(self) -> str:
        """The word as it stands alone in a list."""
        return self.templates.get("label", str(self))

    @property
    def forms(self) -> dict[str, Markup]:
        """The forms by their names."""
        return self.marked(escape).forms

    def marked(self, wrap: Callable[[str], Markup]) -> MarkedWord:
        """Return the word and its forms with the noun in an element."""
        noun = wrap(str(self))
        forms = {
            name: Markup(escape(form)).format(noun=noun) if NOUN in form else wrap(form)  # noqa: S704 - escaped just before
            for name, form in self.templates.items()
        }
        return MarkedWord(noun, forms)


class MarkedWord(Markup):
    """A noun in an element, with its other forms."""

    forms: dict[str, Markup]

    def __new__(cls, noun: Markup, forms: dict[str, Markup]) -> Self:
        """Make the word from markup."""
        made = super().__new__(cls, noun)
        made.forms = forms
        return made
