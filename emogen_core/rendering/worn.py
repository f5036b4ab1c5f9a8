"""A head besides those of the rig file, as plain data, and how a rig and a look take it in.

Whoever fits heads hands them over like this, also to drawing processes, which then need to know neither the space of
heads nor any database. Heads that share an appearance share textures: their style is named after what it is made of.
"""

from __future__ import annotations

import hashlib
import json
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from emogen_core.face.appearance import Appearance

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from emogen_core.face.rig import Adjustment, Rig
    from emogen_core.rendering.look import Look


@dataclass(frozen=True, eq=False)
class WornHead:
    """A fitted head.

    Attributes:
        name: derived from its content, so that one name never means two heads.
        neutral: (N, 3) float32 neutral mesh, millimetres.
        adjustment: how its shapes differ from the rig's; none for a head that is only drawn at rest.
        appearance: document of an `Appearance`; empty for the style of ``like``.
        like: the identity of the look whose baked light it borrows.
    """

    name: str
    neutral: NDArray[np.float32]
    adjustment: Adjustment | None
    appearance: Mapping[str, Any]
    like: str

    @property
    def style(self) -> str:
        """Name of the style that it wears."""
        if not self.appearance:
            return self.like
        text = json.dumps([dict(self.appearance), self.like], sort_keys=True)
        return f"look-{hashlib.sha256(text.encode()).hexdigest()[:12]}"


def worn_rig(rig: Rig, head: WornHead) -> Rig:
    """Return a rig that can also wear a head."""
    own = {} if head.adjustment is None else {head.name: head.adjustment}
    return replace(rig, neutrals={**rig.neutrals, head.name: head.neutral}, adjustments={**rig.adjustments, **own})


def worn_look(look: Look, head: WornHead) -> Look:
    """Return a look that also dresses a head; one without paint dresses all heads alike.

    Raises:
        InvalidInputError: the appearance is not one.
    """
    if head.appearance and look.paint and head.style not in look.styles:
        look = look.with_style(head.style, Appearance.from_document(head.appearance), look.style(head.like).bake)
    return look.changed(styles={**look.styles, head.name: look.style(head.style)})


def apart(one: WornHead, other: WornHead) -> float:
    """Return how far two heads lie apart where they do most, in millimetres: at rest, or in what a shape moves."""
    far = _furthest(one.neutral - other.neutral)
    if one.adjustment is None or other.adjustment is None:
        return far
    if not np.array_equal(one.adjustment.shapes, other.adjustment.shapes):
        return float("inf")
    return max(far, _furthest(one.adjustment.offsets - other.adjustment.offsets))


def _furthest(steps: NDArray[np.float32]) -> float:
    return float(np.linalg.norm(steps, axis=-1).max(initial=0))


def dropped_rig(rig: Rig, name: str) -> Rig:
    """Return a rig without a head that it wore."""
    return replace(rig, neutrals=_without(rig.neutrals, name), adjustments=_without(rig.adjustments, name))


def dropped_look(look: Look, name: str) -> Look:
    """Return a look without a head that it dressed, and without the style that only this one wore."""
    styles = _without(look.styles, name)
    worn = look.styles.get(name)
    own = [other for other, style in styles.items() if style is worn and other.startswith("look-")]
    if own and sum(style is worn for style in styles.values()) == 1:
        styles = _without(styles, own[0])
        return look.changed(styles=styles, bakes=_without(look.bakes, own[0]))
    return look.changed(styles=styles)


def _without(values: Mapping[str, Any], name: str) -> dict[str, Any]:
    return {other: value for other, value in values.items() if other != name}
