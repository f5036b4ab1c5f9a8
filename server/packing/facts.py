"""What a packing is, in numbers and words: for the page, the JSON file and the screen."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Iterable

    from emogen_core.transfer.packing.pack import Options, Packing

    from .making import Made


@dataclass(frozen=True, slots=True)
class Facts:
    """Where a packing comes from.

    Attributes:
        command: what makes the same files again.
        version: of Emogen.
        rig: name of the face model.
        rig_hash: SHA-256 of the face model.
        head: who poses on the cards, and with whom triangles are compared.
    """

    command: str
    version: str
    rig: str
    rig_hash: str
    head: str


def document(made: Made, options: Options, facts: Facts) -> dict[str, Any]:
    """Return everything as what JSON can hold."""
    packing, names = made.packing, made.names
    return {
        **asdict(facts),
        "options": asdict(options),
        "minimum": packing.minimum,
        "needed": packing.needed,
        "importance": sum(expression.importance for expression in packing.expressions),
        "expressions": _expressions(made),
        "shapes": dict(zip(names, packing.importance.tolist(), strict=True)),
        "together": _named(names, packing.rules.together),
        "apart": _named(names, packing.rules.apart),
        "left_out": list(made.left_out),
    }


def _expressions(made: Made) -> list[dict[str, Any]]:
    return [
        {
            "name": card.name,
            "adds": _named(made.names, expression.adds),
            "holds": [made.names[k] for k in expression.holds],
            "importance": expression.importance,
            "share": card.share,
        }
        for expression, card in zip(made.packing.expressions, made.cards, strict=True)
    ]


def _named(names: tuple[str, ...], groups: Iterable[Iterable[int]]) -> list[list[str]]:
    return [[names[k] for k in group] for group in groups]


def proof(packing: Packing) -> str:
    """Return how the number of expressions compares with the least possible one, as a sentence."""
    if packing.needed == packing.minimum:
        return f"{packing.minimum} is the least possible number: proven."
    return f"{packing.minimum} would be the least possible number, proven: --order minimal finds them."


def told(made: Made) -> str:
    """Return a packing as lines of text: what each expression adds, its importance, and the share shown so far."""
    count, shown = len(made.cards), ""
    if count < made.packing.needed:
        shown = f", of which these are the first {count}"
    lines = [f"{made.packing.needed} expressions show {len(made.names)} shapes{shown}. {proof(made.packing)}"]
    for card in made.cards:
        movements = "; ".join(one.words + (" (held)" if one.held else "") for one in card.movements)
        lines.append(f"{card.number:3} {card.importance:6.2f} {card.share:5.0%}  {movements}")
    return "\n".join(lines)
