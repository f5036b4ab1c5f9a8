"""What participants are called in the pages and files: a number, never a name."""

from __future__ import annotations

import re


def name_of(number: int) -> str:
    """Return what a person is called on the admin pages; the number is that of the data."""
    return f"P-{number:04d}"


def number_in(words: str) -> int | None:
    """Return the number that words mean, written as 147, 0147 or P-0147."""
    found = re.fullmatch(r"(?:[Pp]-?)?(\d{1,9})", words.strip(), re.ASCII)
    return int(found[1]) if found else None
