"""Text that people open in a spreadsheet."""

from __future__ import annotations

import re

FORMULA = "^'*[-=+@\\t\\r\\n\uff1d\uff0b\uff0d\uff20]"
"""How a text begins that gets a `'` in front: like a formula, with its signs in full width too, which East Asian
spreadsheets take for the same. One that has a `'` there already gets another, so that taking one away gives the text
again."""


def guarded(text: str) -> str:
    """Return text that a spreadsheet does not take for a formula."""
    return f"'{text}" if re.match(FORMULA, text) else text
