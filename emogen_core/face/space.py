"""The continuous space of heads: parameters in, a neutral head out.

A head is the base head plus weighted targets. Macro targets stand at the corners of a grid and are mixed by products:
``share(ancestry) * share(sex) * share(age)``; weight and muscle add what a heavy, light, strong or slack body of that
sex and age adds. Details are signed sliders, each with one target for either direction. The sum is then moved and
scaled so that the midpoint of its eyeballs is the origin and every eyeball has one radius, because all shapes of a
rig were made for that frame.

This module gives the bare head. `emogen_core.rigs.wear` makes it a head that a rig can wear: lips closed, lids
fitted, a neutral rest pose.

Symbols: ``N`` vertices of the render mesh, ``H`` of its left half, the middle included, ``E`` of an eyeball, ``Q``
points on the source's own eyeball, by which the head is placed and scaled.
"""

from __future__ import annotations

import hashlib
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from emogen_core.errors import InvalidInputError, expected

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

ANCESTRIES = ("african", "asian", "caucasian")
SEXES = ("female", "male")
# The years at which the source's age targets stand in its own scale.
AGES: Mapping[str, float] = {"child": 10.0, "young": 25.0, "old": 90.0}
ADULT = 18.0
# Shares of the heads that are named after a sex alone, and of heads that say nothing of ancestry.
DEFAULT_MIX: Mapping[str, float] = {"african": 0.2, "asian": 0.3, "caucasian": 0.5}
# Shares of ancestry may miss one by this much, for they are written with few decimals.
SHARE_TOLERANCE = 1e-3
BODY = ("weight", "muscle")
MACROS = frozenset({"sex", "age", *ANCESTRIES, *BODY})
"""Parameters that every space has; all others are details."""


@dataclass(frozen=True, slots=True)
class Parameter:
    """A number that describes a head: its name, the region it changes, its range, and what its ends look like."""

    name: str
    region: str
    low: float
    high: float
    default: float
    meaning: str


@dataclass(frozen=True, slots=True)
class Target:
    """Offsets (M, 3) float32 in source millimetres of some rows (M,) of the left half and the eyeball's points."""

    rows: NDArray[np.int32]
    offsets: NDArray[np.float32]


@dataclass(frozen=True, eq=False)
class IdentitySpace:
    """All heads that parameters can describe, on one render mesh.

    Attributes:
        topology: `topology_hash` of the rigs that can wear these heads.
        parameters: in the order in which they are shown; ancestry shares are named after `ANCESTRIES`.
        base: (H + Q, 3) float32 source millimetres: the base head's left half, then its eyeball's points.
        half: (H,) render vertices of the left half and the middle.
        twins: (H,) their mirror images; a vertex of the middle is its own.
        eyes: (2, E) render vertices of the left and the right eyeball.
        eyeball: (E, 3) float32 an eyeball about its centre, millimetres, the left one.
        targets: name -> offsets. ``ancestry-sex-age``, ``sex-age-weight+`` and the like; details as ``name+`` and
            ``name-``.
        low: (N,) float32 0 on the upper, 1 on the lower lip and jaw.
        lid_correctives: (corrective, method) of the correctives that are derived on every head anew.
        hash: SHA-256 of the content, hexadecimal; empty for a space that was never stored.
    """

    topology: str
    parameters: tuple[Parameter, ...]
    base: NDArray[np.float32]
    half: NDArray[np.int32]
    twins: NDArray[np.int32]
    eyes: NDArray[np.int32]
    eyeball: NDArray[np.float32]
    targets: Mapping[str, Target]
    low: NDArray[np.float32]
    lid_correctives: tuple[tuple[str, str], ...] = ()
    hash: str = field(default="")

    @cached_property
    def ranges(self) -> dict[str, Parameter]:
        """Parameter name -> parameter."""
        return {parameter.name: parameter for parameter in self.parameters}

    @property
    def details(self) -> tuple[str, ...]:
        """Names of the signed or one-sided sliders."""
        return tuple(parameter.name for parameter in self.parameters if parameter.name not in MACROS)

    @property
    def eye_radius(self) -> float:
        """Radius of the eyeball, its cornea aside, millimetres."""
        return float(np.linalg.norm(self.eyeball[-1]))

    def check(self, point: Mapping[str, float]) -> None:
        """Raise `InvalidInputError` unless a point names known parameters, in range, with shares that sum to one."""
        for name, value in point.items():
            if name not in self.ranges:
                raise InvalidInputError(f"head: {expected(f'a parameter among {sorted(self.ranges)}', name)}")
            known = self.ranges[name]
            if not known.low <= value <= known.high:
                raise InvalidInputError(f"{name}: {expected(f'a number in [{known.low:g}, {known.high:g}]', value)}")
        total = sum(point.get(name, self.ranges[name].default) for name in ANCESTRIES)
        if not abs(total - 1) <= SHARE_TOLERANCE:
            raise InvalidInputError(f"ancestry: {expected('shares that sum to 1', round(total, 6))}")

    def head(self, point: Mapping[str, float]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Return the bare head of a point.

        Args:
            point: parameter -> value; what is not named has its default.

        Returns:
            (N, 3) neutral, exactly mirror-symmetric, and the (3,) centre of its left eyeball, millimetres.

        Raises:
            InvalidInputError: as `check`.
        """
        self.check(point)
        rows = self.base.astype(np.float64)
        for name, weight in self.weights(point).items():
            target = self.targets[name]
            rows[target.rows] += weight * target.offsets
        count = len(self.half)
        centre, radius = fit_sphere(rows[count:])
        scale = self.eye_radius / radius
        eye_centre = centre * (scale, 0, 0)
        return self._assembled((rows[:count] - centre * (0, 1, 1)) * scale, eye_centre), eye_centre

    def weights(self, point: Mapping[str, float]) -> dict[str, float]:
        """Return target -> weight of a point, those of weight 0 left out."""
        value = {name: point.get(name, known.default) for name, known in self.ranges.items()}
        total = sum(value[name] for name in ANCESTRIES)
        found: dict[str, float] = {}
        for sex, of_sex in (("female", 1 - value["sex"]), ("male", value["sex"])):
            for age, of_age in age_shares(value["age"]).items():
                share = of_sex * of_age
                for ancestry in ANCESTRIES:
                    found[f"{ancestry}-{sex}-{age}"] = share * value[ancestry] / total
                for body in BODY:
                    found[f"{sex}-{age}-{body}{_sign(value[body])}"] = share * abs(value[body])
        for name in self.details:
            found[f"{name}{_sign(value[name])}"] = abs(value[name])
        return {name: weight for name, weight in found.items() if weight != 0}

    def _assembled(self, left: NDArray[np.float64], eye_centre: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the whole head of its (H, 3) left half."""
        mesh = np.zeros((len(self.low), 3))
        mesh[self.twins] = left * (-1, 1, 1)
        mesh[self.half] = np.where((self.half == self.twins)[:, None], left * (0, 1, 1), left)
        for vertices, side in zip(self.eyes, (1, -1), strict=True):
            mesh[vertices] = (self.eyeball + eye_centre) * (side, 1, 1)
        return mesh


def age_shares(years: float) -> dict[str, float]:
    """Return how much of each age's targets a head of so many years has; the shares sum to one."""
    places = np.array(list(AGES.values()))
    return {age: float(np.interp(years, places, row)) for age, row in zip(AGES, np.eye(len(AGES)), strict=True)}


def fit_sphere(points: NDArray[np.float64]) -> tuple[NDArray[np.float64], float]:
    """Return centre and radius of the least-squares sphere of (n, 3) points (|p|^2 = 2 p.c + r^2 - c.c)."""
    system = np.concatenate([2 * points, np.ones((len(points), 1))], 1)
    solution = np.linalg.lstsq(system, (points**2).sum(1), rcond=None)[0]
    centre = solution[:3]
    return centre, float(np.sqrt(solution[3] + centre @ centre))


def topology_hash(
    triangles: NDArray[np.integer], mirror: NDArray[np.integer], parts: Mapping[str, tuple[int, int]]
) -> str:
    """Return the SHA-256 of what a space has to know of a rig: its triangles, mirror table and parts."""
    digest = hashlib.sha256(np.ascontiguousarray(triangles, "<i4").tobytes())
    digest.update(np.ascontiguousarray(mirror, "<i4").tobytes())
    digest.update(repr(sorted((name, *map(int, rows)) for name, rows in parts.items())).encode())
    return digest.hexdigest()


def _sign(value: float) -> str:
    return "-" if value < 0 else "+"
