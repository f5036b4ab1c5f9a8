"""Identities: blends of MakeHuman's macro targets, brought to one scale and mended until eyes and lips fit.

The ancestry targets are graphic presets, not anthropometrically validated. Every head is made mirror-symmetric,
moved so that the midpoint of its fitted eyeballs is the origin, and scaled to one eyeball radius; the units, which
were made for the base head, then fit all of them.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from emogen_core.rigs.base_mesh import symmetric
from emogen_core.rigs.eyeballs import RADIUS

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from emogen_core.rigs.base_mesh import BaseMesh
    from emogen_core.rigs.source import Source

_MACRO = "mpfb2/targets/macrodetails"


@dataclass(frozen=True, slots=True)
class Blend:
    """A head as shares of corner heads: (ancestry, sex, age) -> share, summing to one."""

    shares: Mapping[tuple[str, str, str], float]


def _defaults(sex: str) -> Blend:
    mix = {"caucasian": 0.5, "asian": 0.3, "african": 0.2}
    return Blend({(ancestry, sex, "young"): share for ancestry, share in mix.items()})


IDENTITIES: Mapping[str, Blend] = {
    "female": _defaults("female"),
    "male": _defaults("male"),
    **{
        f"{ancestry}-{sex}-{age}": Blend({(ancestry, sex, age): 1.0})
        for ancestry in ("african", "asian", "caucasian")
        for sex in ("female", "male")
        for age in ("young", "old")
    },
}


@dataclass(frozen=True, slots=True)
class Fitted:
    """A head in the rig's frame: (19158, 3) base vertices and the left eyeball's centre, millimetres."""

    vertices: NDArray[np.float64]
    eye_centre: NDArray[np.float64]


def blend_vertices(source: Source, mesh: BaseMesh, blend: Blend) -> NDArray[np.float64]:
    """Return the (19158, 3) vertices of a blend in the base mesh's own frame, decimetres."""
    vertices = mesh.vertices.copy()
    for (ancestry, sex, age), share in blend.shares.items():
        for name in (f"{ancestry}-{sex}-{age}", f"universal-{sex}-{age}-averagemuscle-averageweight"):
            vertices += share * source.target(f"{_MACRO}/{name}.target.gz")
    return symmetric(mesh, vertices)


def fit(mesh: BaseMesh, vertices: NDArray[np.float64]) -> Fitted:
    """Move and scale a symmetric head (any unit) so that its eyeballs are those of `eyeballs.py`."""
    centre, radius = fit_sphere(vertices[np.unique(mesh.quads["helper-l-eye"])])
    scale = RADIUS / radius
    return Fitted((vertices - centre * (0, 1, 1)) * scale, centre * (1, 0, 0) * scale)


def fit_sphere(points: NDArray[np.float64]) -> tuple[NDArray[np.float64], float]:
    """Return centre and radius of the least-squares sphere of (n, 3) points (|p|^2 = 2 p.c + r^2 - c.c)."""
    system = np.concatenate([2 * points, np.ones((len(points), 1))], 1)
    solution = np.linalg.lstsq(system, (points**2).sum(1), rcond=None)[0]
    centre = solution[:3]
    return centre, float(np.sqrt(solution[3] + centre @ centre))
