"""What the parts of a model are, by their names: skin, eyes, teeth, the rest of the mouth, lashes."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from emogen_core.rigs.foreign.model import Findings, HeadModel

ROLES = ("skin", "eyes", "teeth", "mouth", "lashes", "other")

# The first that matches decides: an eyelash is no eye, and the film of tears on it neither.
_WORDS = (
    ("lashes", re.compile(r"lash", re.IGNORECASE)),
    ("other", re.compile(r"brow|lid|blend|occlu|shadow|fluid|tear|wet|caruncle|hair|beard|glass", re.IGNORECASE)),
    ("eyes", re.compile(r"eye|sclera|iris|cornea|pupil", re.IGNORECASE)),
    ("mouth", re.compile(r"tongue|gum|mouth|socket", re.IGNORECASE)),
    ("teeth", re.compile(r"teeth|tooth|dent(al|ure|es)", re.IGNORECASE)),
    ("skin", re.compile(r"skin|face|head|body", re.IGNORECASE)),
)


def roles_of(model: HeadModel) -> dict[str, tuple[str, ...]]:
    """Return role (of `ROLES`) -> its parts. The largest part is skin where no name says so."""
    roles = {name: _role(name) for name in model.parts}
    if "skin" not in roles.values():
        largest = max(model.parts, key=lambda name: model.parts[name][1] - model.parts[name][0])
        roles[largest] = "skin"
    return {role: tuple(name for name, own in roles.items() if own == role) for role in ROLES}


def say_roles(model: HeadModel, findings: Findings) -> None:
    """Say which part was taken for what."""
    roles = roles_of(model)
    told = "; ".join(f"{role}: {', '.join(names)}" for role, names in roles.items() if names)
    findings.guessed.append(f"Parts by their names: {told}.")
    findings.missing.extend(f"No part is named as {role}." for role in ("eyes", "teeth") if not roles[role])


def eyeballs(model: HeadModel) -> tuple[NDArray[np.float64], NDArray[np.float64]] | None:
    """Return the (3,) centres of the two eyeballs, in no order, or none where no parts are eyes.

    They are told apart along the axis on which the eyes' parts reach furthest; axes need not be known.
    """
    points = model.vertices[model.part_vertices(*roles_of(model)["eyes"])].astype(np.float64)
    if not len(points):
        return None
    extent = np.ptp(points, axis=0)
    axis = int(extent.argmax())
    if extent[axis] < 1.5 * np.delete(extent, axis).max():
        return None
    middle = (points[:, axis].min() + points[:, axis].max()) / 2
    first = points[:, axis] > middle
    return _ball(points[first]), _ball(points[~first])


def _ball(points: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the centre of the sphere through (n, 3) points, by ``|p|² = 2 p·c + k``: eyes may lack their back."""
    solution = np.linalg.lstsq(np.column_stack([2 * points, np.ones(len(points))]), (points**2).sum(axis=1))[0]
    return np.asarray(solution[:3])


def _role(name: str) -> str:
    return next((role for role, words in _WORDS if words.search(name)), "other")
