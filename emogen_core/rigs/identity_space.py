"""Bakes the space of heads from MakeHuman's macro and detail targets, on the render mesh.

Every target is made mirror-symmetric, so half of the mesh is stored, and freed from what moves the whole head up or
forward, because a head is placed by its eyes. Ranges are those at which heads were looked at and are sane.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from emogen_core.face.space import (
    AGES,
    ANCESTRIES,
    BODY,
    DEFAULT_MIX,
    SEXES,
    IdentitySpace,
    Parameter,
    Target,
    topology_hash,
)
from emogen_core.rigs.base_mesh import MILLIMETRES, symmetric
from emogen_core.rigs.detail_table import DETAILS
from emogen_core.rigs.eyeballs import eyeball

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from emogen_core.rigs.detail_table import Detail
    from emogen_core.rigs.head_mesh import HeadGeometry
    from emogen_core.rigs.source import Source

_TARGETS = "mpfb2/targets"
_DESCRIPTION = {
    "sex": Parameter("sex", "macro", 0.0, 1.0, 0.0, "0 the source's female, 1 its male heads"),
    "age": Parameter("age", "macro", 10.0, 90.0, 25.0, "years in the source's scale: 10 child, 25 young, 90 old"),
    "weight": Parameter("weight", "macro", -1.0, 1.0, 0.0, "lean to heavy"),
    "muscle": Parameter("muscle", "macro", -1.0, 1.0, 0.0, "slack to strong"),
}
# The source's targets of weight leave the face as it is; these shares of details make it lean or heavy as well.
_FACE = {"weight": {"head-fat": 0.6, "neck-fullness": 0.4}}
# What moves less than this, millimetres, is not stored.
_SEEN = 0.02


def bake_space(source: Source, geometry: HeadGeometry, low: NDArray[np.float64]) -> IdentitySpace:
    """Return the space of heads on a render mesh.

    Args:
        source: the CC0 data.
        geometry: the render mesh.
        low: (N,) 0 on the upper, 1 on the lower lip.
    """
    baker = _Baker(source, geometry)
    return IdentitySpace(
        topology=topology_hash(geometry.triangles, geometry.mirror, geometry.parts),
        parameters=_parameters(),
        base=baker.rows(geometry.mesh.vertices * MILLIMETRES),
        half=baker.half.astype(np.int32),
        twins=geometry.mirror[baker.half].astype(np.int32),
        eyes=np.stack([geometry.part_vertices(part) for part in ("eye_left", "eye_right")]).astype(np.int32),
        eyeball=eyeball()[0].astype(np.float32),
        targets=baker.macros() | baker.details(),
        low=low.astype(np.float32),
    )


def _parameters() -> tuple[Parameter, ...]:
    shares = (
        Parameter(name, "macro", 0.0, 1.0, DEFAULT_MIX[name], f"share of the source's {name} preset")
        for name in ANCESTRIES
    )
    order = (_DESCRIPTION["sex"], _DESCRIPTION["age"], *shares, _DESCRIPTION["weight"], _DESCRIPTION["muscle"])
    return (*order, *(Parameter(d.name, d.region, d.low, d.high, 0.0, d.meaning) for d in DETAILS))


class _Baker:
    def __init__(self, source: Source, geometry: HeadGeometry) -> None:
        self._source = source
        self._geometry = geometry
        self._guides = np.unique(geometry.mesh.quads["helper-l-eye"])
        drawn = np.diff(geometry.operator.indptr) > 0
        left = geometry.positions[:, 0] > 1e-9
        self.half = np.flatnonzero(drawn & (left | (geometry.mirror == np.arange(len(left)))))

    def rows(self, base: NDArray[np.float64]) -> NDArray[np.float32]:
        """Return (H + Q, 3) of positions or offsets given on the (19158, 3) base mesh, made symmetric."""
        even = symmetric(self._geometry.mesh, base)
        render = self._geometry.operator @ even
        return np.concatenate([render[self.half], even[self._guides]]).astype(np.float32)

    def macros(self) -> dict[str, Target]:
        """Return the corner heads, and what weight and muscle change on each."""
        found = {}
        for sex in SEXES:
            for age in AGES:
                plain = self._macro(f"universal-{sex}-{age}-averagemuscle-averageweight")
                for ancestry in ANCESTRIES:
                    found[f"{ancestry}-{sex}-{age}"] = self._target(self._macro(f"{ancestry}-{sex}-{age}"))
                for body in BODY:
                    for sign, word in (("-", "min"), ("+", "max")):
                        levels = dict.fromkeys(BODY, "average") | {body: word}
                        name = f"universal-{sex}-{age}-{levels['muscle']}muscle-{levels['weight']}weight"
                        face = self._face(body, sign)
                        found[f"{sex}-{age}-{body}{sign}"] = self._target(self._macro(name) - plain + face)
        return found

    def details(self) -> dict[str, Target]:
        """Return every detail's two ends."""
        found = {}
        for detail in DETAILS:
            for sign in "+-":
                if detail.targets(sign):
                    found[f"{detail.name}{sign}"] = self._target(self._detail(detail, sign))
        return found

    def _face(self, body: str, sign: str) -> NDArray[np.float64] | float:
        shares = _FACE.get(body, {})
        return sum(shares[detail.name] * self._detail(detail, sign) for detail in DETAILS if detail.name in shares)

    def _macro(self, name: str) -> NDArray[np.float64]:
        return self._source.target(f"{_TARGETS}/macrodetails/{name}.target.gz")

    def _detail(self, detail: Detail, sign: str) -> NDArray[np.float64]:
        targets = [self._source.target(f"{_TARGETS}/{name}.target.gz") for name in detail.targets(sign)]
        return np.asarray(detail.scale * np.sum(targets, axis=0), np.float64)

    def _target(self, offsets: NDArray[np.float64]) -> Target:
        rows = self.rows(offsets * MILLIMETRES)
        rows -= rows[len(self.half) :].mean(0) * (0, 1, 1)
        moved = np.flatnonzero(np.abs(rows).max(1) > _SEEN)
        return Target(moved.astype(np.int32), rows[moved].astype(np.float32))
