"""Puts a head of the space on a rig: a new rig value with one identity more, its shapes and its hash untouched.

`fit_head` gives the same head as plain data, for whoever hands it on to drawing processes.
"""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING, Any

import numpy as np

from emogen_core.errors import InvalidInputError, expected
from emogen_core.face.identity import identity_hash, require_adult, worn_as
from emogen_core.face.space import ANCESTRIES, topology_hash
from emogen_core.rendering.worn import WornHead, worn_rig
from emogen_core.rigs.adapt import Fitter
from emogen_core.rigs.default_look import default_appearance
from emogen_core.rigs.identities import IDENTITIES
from emogen_core.rigs.look.presets import presets

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from emogen_core.face.identity import Identity
    from emogen_core.face.rig import Rig
    from emogen_core.face.space import IdentitySpace

# Years that count as much as the other sex or another ancestry when presets are compared.
_YEARS = 65.0


def wear(rig: Rig, space: IdentitySpace, identity: Identity, *, children: bool = False) -> tuple[Rig, str]:
    """Return a rig that can also wear an identity, and the name under which it does.

    Args:
        rig: the face model that the space was made for.
        space: the space of heads.
        identity: the head; its name is derived from its content, so the same identity has the same name everywhere.
        children: whether heads below adult age may be worn.

    Raises:
        InvalidInputError: the space was made for another mesh.
        IdentityError: the identity is no point of the space, or a child's where none may be worn.
    """
    if not children:
        require_adult(identity, space)
    name = worn_name(identity, space)
    if name in rig.neutrals:
        return rig, name
    return worn_rig(rig, fit_head(rig, space, identity)), name


def fit_head(rig: Rig, space: IdentitySpace, identity: Identity, *, moving: bool = True) -> WornHead:
    """Return a fitted head with its look, whatever its age.

    Args:
        rig: the face model that the space was made for.
        space: the space of heads.
        identity: the head; without an appearance it wears the default of `emogen_core.rigs.default_look`.
        moving: whether its shapes are fitted too, which takes longest; a neutral portrait is the same without. Such
            a head is not the head yet, so its name ends in ``-still``.

    Raises:
        InvalidInputError: the space was made for another mesh.
        IdentityError: the identity is no point of the space.
    """
    name, known = worn_name(identity, space), fitter(rig, space)
    like = nearest_preset(identity.head, space)
    look = _look(identity, space, like)
    if not moving:
        return WornHead(f"{name}-still", known.neutral(identity.head), None, look, like)
    return WornHead(name, *known.fit(identity.head), look, like)


def worn_name(identity: Identity, space: IdentitySpace) -> str:
    """Return the name under which rigs wear an identity; raises `IdentityError` where it is no point of the space."""
    return worn_as(identity_hash(identity, space))


@lru_cache(maxsize=2)
def fitter(rig: Rig, space: IdentitySpace) -> Fitter:
    """Return what fits heads of a space to a rig, made once.

    Raises:
        InvalidInputError: the space was made for another mesh.
    """
    found = topology_hash(rig.triangles, rig.mirror, rig.parts)
    if found != space.topology:
        raise InvalidInputError(f"rig: {expected(f'the mesh {space.topology[:12]} of the space', found[:12])}")
    return Fitter(rig, space)


def nearest_preset(point: Mapping[str, float], space: IdentitySpace) -> str:
    """Return the preset whose sex, age and ancestry come nearest to a point's."""
    place = _place(point, space)
    return min(IDENTITIES, key=lambda name: np.abs(_place(IDENTITIES[name], space) - place).sum())


def _place(point: Mapping[str, float], space: IdentitySpace) -> NDArray[np.float64]:
    """Return what presets are compared by, (5,): sex, shares of ancestry, and age in units of `_YEARS`."""
    value = {name: point.get(name, space.ranges[name].default) for name in ("sex", *ANCESTRIES, "age")}
    return np.array([*value.values()]) / (1, 1, 1, 1, _YEARS)


def _look(identity: Identity, space: IdentitySpace, like: str) -> Mapping[str, Any]:
    """Return the document of what a head wears; empty where that is the style of the preset that it is like."""
    if identity.appearance:
        return identity.appearance
    look = default_appearance(identity.head, space)
    return {} if look == presets()[like] else look.to_document()
