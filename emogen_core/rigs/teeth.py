"""Single teeth as linear combinations of MakeHuman's plain teeth strips, so that units and identities carry them.

A helper strip is a grid of 17 columns round the jaw and four rows: inside, tip, middle, gum. A point of the
new strip is a cubic spline through the columns, a parabola from gum to tip, and a step along (middle - inside),
which is the outward direction here; all three are linear in the helper's vertices.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from scipy.interpolate import CubicSpline

from emogen_core.rigs.grids import grid_of

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from emogen_core.rigs.base_mesh import BaseMesh

# Crown widths from the middle to the first molar, millimetres (means of anatomy text books).
UPPER_WIDTHS = (8.6, 6.8, 7.8, 7.2, 7.0, 10.4)
LOWER_WIDTHS = (5.4, 5.9, 6.9, 7.0, 7.1, 11.0)

_ACROSS = np.array([-1.0, -0.86, -0.55, -0.2, 0.2, 0.55, 0.86])
# Gum to tip is 0..1, tip to inside 1..2. Above 0.34 the strip would stand out of the cheek.
_DOWN = np.array([0.34, 0.44, 0.52, 0.60, 0.72, 0.84, 0.94, 1.0, 1.12, 1.4, 2.0])
# Side teeth stand this far further in, millimetres, or they shine through the corners of closed lips.
_CORRIDOR = 1.6


def tooth_strip(
    mesh: BaseMesh, group: str, widths: tuple[float, ...]
) -> tuple[NDArray[np.float64], NDArray[np.intp], NDArray[np.float64]]:
    """Make the strip of one jaw.

    Returns:
        (R * C, 19158) dense-row weights of the source vertices; the (R, C) grid of their indices, from right to
        left; and (R * C, 3) surface coordinates: tooth (0 at the midline's left, negative to the right), place across
        the tooth in [-1, 1], place down the tooth (0 gum, 1 tip, 2 inside).
    """
    helper = grid_of(mesh.quads[group])
    points = mesh.canonical()[helper]
    helper = helper if points[:, :, 2].mean(1)[0] < points[:, :, 2].mean(1)[-1] else helper[::-1]
    helper = helper if mesh.vertices[helper[0, 0], 0] < mesh.vertices[helper[0, -1], 0] else helper[:, ::-1]
    arc, tooth, across = _columns(widths)
    spline = _spline(mesh.canonical()[helper[2]], arc)
    outward = np.linalg.norm(spline @ (mesh.canonical()[helper[2]] - mesh.canonical()[helper[0]]), axis=1)
    setback = np.clip((np.abs(arc) / arc[-1] - 0.45) / 0.3, 0, 1)
    weights = np.zeros((len(_DOWN), len(arc), len(mesh.vertices)))
    for row, down in enumerate(_DOWN):
        step = (_step(across, down) - _CORRIDOR * setback) / outward
        for source, part in zip(helper, _profile(down, step), strict=True):
            weights[row][:, source] += part[:, None] * spline
    surface = [np.stack([tooth, across, np.full(len(arc), down)], 1) for down in _DOWN]
    grid = np.arange(len(_DOWN) * len(arc)).reshape(len(_DOWN), -1)
    return weights.reshape(grid.size, -1), grid, np.concatenate(surface)


def _columns(widths: tuple[float, ...]) -> tuple[NDArray[np.float64], ...]:
    """Return arc length, tooth and place across the tooth of every column, right to left, symmetric."""
    edges = np.concatenate([[0], np.cumsum(widths)])
    starts = np.concatenate([-edges[:0:-1], edges[:-1]])
    spans = np.concatenate([widths[::-1], widths])
    arc = (starts[:, None] + spans[:, None] * (_ACROSS + 1) / 2).ravel()
    tooth = np.repeat(np.arange(-len(widths), len(widths)), len(_ACROSS))
    across = np.tile(_ACROSS, 2 * len(widths))
    return np.append(arc, edges[-1]), np.append(tooth, len(widths) - 1.0), np.append(across, 1.0)


def _spline(columns: NDArray[np.float64], arc: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return (arcs, 17) weights of the columns at given arc lengths from the middle column."""
    chord = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(columns, axis=0), axis=1))])
    chord -= chord[len(chord) // 2]
    return np.asarray(CubicSpline(chord, np.eye(len(columns)))(arc), np.float64)


def _profile(down: float, step: NDArray[np.float64]) -> list[NDArray[np.float64]]:
    """Return the weights of the rows inside, tip, middle and gum at one height, moved outward by ``step``."""
    ones = np.ones(len(step))
    if down <= 1:
        gum, middle, tip = (1 - down) * (1 - 2 * down), 4 * down * (1 - down), down * (2 * down - 1)
        return [-step, tip * ones, middle + step, gum * ones]
    return [(down - 1) * ones - step, (2 - down) * ones, step, 0 * ones]


def _step(across: NDArray[np.float64], down: float) -> NDArray[np.float64]:
    """Return millimetres outward: bulging crowns with grooves between, a smooth gum, a rounded edge."""
    gum_line = 0.50 + 0.07 * across**2
    rise = np.clip((down - gum_line + 0.06) / 0.12, 0, 1)
    crown = rise * rise * (3 - 2 * rise)
    bulge = 1.1 - 1.7 * across**4
    edge = np.clip((down - 0.84) / 0.16, 0, 1) ** 2
    back = np.clip(down - 1, 0, 1)
    outward: NDArray[np.float64] = (0.3 * (1 - crown) + crown * (bulge - 0.5 * edge)) * (1 - back)
    return outward
