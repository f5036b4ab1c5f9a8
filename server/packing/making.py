"""From a rig and options to the cards, before anything is drawn."""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import accumulate
from typing import TYPE_CHECKING

import numpy as np

from emogen_core.transfer.packing.of_rig import template_of
from emogen_core.transfer.packing.pack import pack

from .cards import Card
from .studio import painted
from .words import movements

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from emogen_core.face.rig import Rig
    from emogen_core.transfer.packing.pack import Options, Packing

    from .studio import Studio


@dataclass(frozen=True, slots=True, eq=False)
class Made:
    """A packing of a rig, told by names.

    Attributes:
        packing: of the shapes.
        names: of the shapes that are packed.
        left_out: names of the core shapes that are not.
        shapes: names of all core shapes.
        weights: (J, C) their weights in every expression.
        cards: one an expression, without pictures.
    """

    packing: Packing
    names: tuple[str, ...]
    left_out: tuple[str, ...]
    shapes: tuple[str, ...]
    weights: NDArray[np.float64]
    cards: tuple[Card, ...]

    def drawn(self, studio: Studio) -> tuple[Card, ...]:
        """Return the cards with pictures."""
        return tuple(
            replace(card, views=studio.views(row, painted(self.packing, self.names, card.movements)))
            for card, row in zip(self.cards, self.weights, strict=True)
        )


def make(rig: Rig, head: str, options: Options) -> Made:
    """Return the packing of a rig's core shapes for a head that it wears.

    Raises:
        InvalidInputError: nothing to pack, or an option is out of its range.
    """
    template = template_of(rig, rig.neutral(head))
    packing = pack(template, options)
    weights = np.zeros((len(packing.expressions), len(rig.core_shapes)))
    weights[:, [rig.core_shapes.index(name) for name in template.names]] = packing.weights
    left_out = tuple(name for name in rig.core_shapes if name not in template.names)
    return Made(packing, template.names, left_out, rig.core_shapes, weights, _cards(rig, template.names, packing))


def _cards(rig: Rig, names: tuple[str, ...], packing: Packing) -> tuple[Card, ...]:
    whole = packing.importance.sum()
    shares = accumulate(expression.importance / whole for expression in packing.expressions)
    return tuple(
        Card(
            number=number,
            of=len(packing.expressions),
            movements=movements(rig, [[names[k] for k in unit] for unit in one.adds], [names[k] for k in one.holds]),
            importance=one.importance,
            share=min(share, 1.0),
        )
        for number, (one, share) in enumerate(zip(packing.expressions, shares, strict=True), start=1)
    )
