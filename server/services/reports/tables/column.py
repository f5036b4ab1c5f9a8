"""What a column and a table of the export are."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

Type = Literal["text", "json", "integer", "number", "boolean", "time"]
TRUTH = ("true", "false")
NAME = "NAME"
"""Stands in names and allowed values for what a rig or a study calls it."""


@dataclass(frozen=True, slots=True)
class Column:
    """One column; `family` marks one that is repeated for every gene or shape of the rig.

    `allowed` lists the values that can stand there, where that is a list; a part in capitals stands for a name.
    `least` and `most` are the limits of a number. `single` says that a number has the precision of 32 bits.
    `later` marks one that exports of earlier releases lack.
    """

    name: str
    type: Type
    help: str
    unit: str = ""
    allowed: tuple[str, ...] = ()
    least: float | None = None
    most: float | None = None
    family: Literal["genes", "weights"] | None = None
    single: bool = False
    later: bool = False

    @property
    def shown(self) -> str:
        """Return the name as it is told where the rig is not known."""
        return self.name if self.family is None else f"{self.name}{NAME}"

    @property
    def values(self) -> str:
        """Return what may stand in the column, in words; empty where that is anything of its type."""
        if self.least is not None:
            return f"from {self.least:g}" if self.most is None else f"{self.least:g} to {self.most:g}"
        return ", ".join(self.allowed)


@dataclass(frozen=True, slots=True)
class Table:
    """A table: what it is for, in one sentence, its columns, and those whose values tell its rows apart."""

    name: str
    about: str
    key: tuple[str, ...]
    columns: tuple[Column, ...]


def text(name: str, help_: str, *allowed: str) -> Column:
    """Return a column of text."""
    return Column(name, "text", help_, allowed=allowed)


def json_text(name: str, help_: str) -> Column:
    """Return a column of lists or objects: JSON in a cell, and as it is in JSON Lines."""
    return Column(name, "json", help_)


def integer(name: str, help_: str, *, least: int = 0, most: int | None = None) -> Column:
    """Return a column of whole numbers."""
    return Column(name, "integer", help_, least=least, most=most)


def number(name: str, help_: str, unit: str = "", *, least: float | None = 0) -> Column:
    """Return a column of numbers."""
    return Column(name, "number", help_, unit, least=least)


def truth(name: str, help_: str, *, later: bool = False) -> Column:
    """Return a column of true and false."""
    return Column(name, "boolean", help_, allowed=TRUTH, later=later)


def time(name: str, help_: str) -> Column:
    """Return a column of moments."""
    return Column(name, "time", help_, "ISO 8601, UTC")


def milliseconds(name: str, help_: str) -> Column:
    """Return a column of spans of time, or of moments on a page's clock."""
    return number(name, help_, "ms")
