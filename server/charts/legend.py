"""What the signs of a chart stand for: each as a small drawing, to be put beside its name."""

from __future__ import annotations

from typing import TYPE_CHECKING

from .map import dots_at, look_of
from .markup import element

if TYPE_CHECKING:
    from collections.abc import Sequence

    from .markup import Markup

Entry = tuple[str, "Markup"]


def legend(names: Sequence[str]) -> list[Entry]:
    """Return every series with the sign of its line."""
    return [
        (name, _sign(element("path", d="M0 7H28", class_=f"line s{look_of(at)}"), dots_at(14, 7, look_of(at))))
        for at, name in enumerate(names)
    ]


def bare_line(name: str, look: int = 1) -> Entry:
    """Return a series that has no marks with the sign of its line."""
    return name, _sign(element("path", d="M0 7H28", class_=f"line s{look}"))


def filled(name: str, look: str) -> Entry:
    """Return an area with its sign."""
    return name, _sign(element("path", d="M0.5 1.5H27.5V12.5H0.5Z", class_=look))


def _sign(*parts: Markup) -> Markup:
    return element("svg", *parts, class_="chart sign", viewBox="0 0 28 14", aria_hidden="true")
