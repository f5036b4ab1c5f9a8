"""Lying bars in rows of a page: drawings without words, as the words stand beside them."""

from __future__ import annotations

from .markup import Markup, element

GAP = 2.0


def bar(share: float) -> Markup:
    """Return a bar that fills a share of its place."""
    filled = element("rect", width=100 * min(max(share, 0.0), 1.0), height=8, class_="s1") if share > 0 else Markup("")
    return _stretched("lie", filled)


def segments(done: float, count: int) -> Markup:
    """Return `count` equal pieces of which the first `done` are filled, the last of them in part."""
    wide = (100 + GAP) / max(count, 1) - GAP
    pieces = []
    for index in range(max(count, 1)):
        left, part = index * (wide + GAP), min(max(done - index, 0.0), 1.0)
        pieces.append(element("rect", x=left, width=wide, height=8, class_="rest"))
        if part > 0:
            pieces.append(element("rect", x=left, width=wide * part, height=8, class_="s1"))
    return _stretched("pieces", *pieces)


def _stretched(name: str, *children: Markup) -> Markup:
    return element(
        "svg", *children, class_=name, viewBox="0 0 100 8", preserveAspectRatio="none", aria_hidden="true",
        focusable="false",
    )  # fmt: skip
