"""What a card says: names of shapes as people read them, and in which colour each is marked."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Sequence

    from emogen_core.face.rig import Rig

COLOURS = ("#0b6b7b", "#d07a00", "#8a4390", "#3d8b45", "#c2362b", "#3a66b7", "#8a5a2b", "#c94f8a", "#6b7f00", "#555b6e")
"""Of the movements of a card, told apart by people who see colours differently; after the last the first again."""
HELD = "#9aa2a5"
"""Of what is held besides."""
_SIDE = re.compile(r"[._ ](?:(l|left)|(r|right))$", re.IGNORECASE)
_HUMP = re.compile(r"(?<=[a-z0-9])(?=[A-Z])|[._ ]+")


@dataclass(frozen=True, slots=True)
class Movement:
    """One movement of an expression.

    Attributes:
        shapes: names of the shapes that make it.
        words: what it is called.
        units: FACS codes of its gene, as the rig's maker read the shape; empty where none is known.
        colour: in which it is marked, as in CSS.
        held: whether another expression shows it.
    """

    shapes: tuple[str, ...]
    words: str
    units: str
    colour: str
    held: bool = False


def movements(rig: Rig, adds: Sequence[Sequence[str]], holds: Sequence[str]) -> tuple[Movement, ...]:
    """Return the movements of an expression, those that are only held last.

    Args:
        rig: the face model.
        adds: names of the shapes, by movement.
        holds: names of shapes that are held.
    """
    made = [
        Movement(tuple(names), spoken(names), _units(rig, names), COLOURS[place % len(COLOURS)])
        for place, names in enumerate(adds)
    ]
    held = [Movement((name,), spoken([name]), _units(rig, [name]), HELD, held=True) for name in holds]
    return (*made, *held)


def spoken(names: Sequence[str]) -> str:
    """Return names of shapes as words: ``browDown.L`` with ``browDown.R`` is "brow down"."""
    bare = {_SIDE.sub("", name) for name in names}
    if len(names) > 1 and len(bare) == 1:
        return _words(bare.pop())
    return " + ".join(_words(_SIDE.sub("", name)) + _side(name) for name in names)


def _side(name: str) -> str:
    found = _SIDE.search(name)
    return "" if not found else ", left" if found[1] else ", right"


def _words(name: str) -> str:
    return _HUMP.sub(" ", name).strip().lower()


def _units(rig: Rig, names: Sequence[str]) -> str:
    """Return the codes of the genes of some shapes, as FACS writes them: AU 1+2, AD 34."""
    codes = [code for gene in rig.genes if set(gene.members) & set(names) for code in gene.action_units]
    told = [f"AU {code}" if code.isdigit() else f"{code[:2]} {code[2:]}" for code in dict.fromkeys(codes)]
    return "+".join(told).replace("+AU ", "+")
