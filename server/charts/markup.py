"""SVG elements as text. Everything that comes from outside is escaped here and nowhere else."""

from __future__ import annotations

from html import escape


class Markup(str):
    """Text that is markup already: templates put it in as it stands."""

    __slots__ = ()

    def __html__(self) -> str:
        """Say to a template that nothing has to be escaped."""
        return str(self)


def element(name: str, *children: str, **attributes: str | float | None) -> Markup:
    """Return an element; text among the children is escaped, markup is not.

    A trailing underscore of an attribute is left out (`class_`), any other one is a hyphen. None leaves it out.
    """
    written = "".join(
        f' {key.rstrip("_").replace("_", "-")}="{_value(value)}"'
        for key, value in attributes.items()
        if value is not None
    )
    inside = "".join(child if isinstance(child, Markup) else escape(child) for child in children)
    return Markup(f"<{name}{written}>{inside}</{name}>" if inside else f"<{name}{written}/>")


def joined(*parts: str) -> Markup:
    """Return markup after markup."""
    return Markup("".join(parts))


def number(value: float) -> str:
    """Return a coordinate to a tenth of a pixel, as short as it can be."""
    return f"{round(value, 1) + 0.0:.10g}"


def _value(value: str | float) -> str:
    return escape(value) if isinstance(value, str) else number(value)
