"""A head seen from the front, and the places on it that every head has: what two heads are laid over each other by.

The head is drawn on a grid, without perspective. Where the picture changes from lid to eyeball, and where what the jaw
takes along begins, are the openings of the eyes and the line of the mouth; the rest is read off the profile.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from emogen_core.rendering.raster import rasterise

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

PITCH = 0.5  # millimetres
_LEFT, _RIGHT, _TOP, _BOTTOM = -110.0, 110.0, 130.0, -150.0
_MOUTH = (-30.0, -105.0)  # millimetres below the eyes
# A step of so much of the jaw's whole way, over so many rows, is the line of the mouth.
_STEP, _ROWS = 0.15, 2
_LID_SHARES = (0.15, 0.35, 0.5, 0.65, 0.85)
_LIP_SHARES = np.linspace(0.0, 1.0, 9)
_FOREHEAD = (25.0, 45.0, 65.0)
_CHEEK, _WING = 28.0, 0.25
_BEHIND = 25.0  # millimetres; corners of a mouth lie no farther behind its middle
_UNDER = 12.0  # millimetres behind the chin
_CAP = 8.0  # millimetres of what stands out most, of which the middle is taken


@dataclass(frozen=True, eq=False)
class Front:
    """A head at rest.

    Attributes:
        vertices: (N, 3) millimetres, the origin between the eyes.
        skin: (t, 3) triangles of skin, what lies in mouth and eye sockets included.
        eyes: (e, 3) triangles of both eyeballs; none for a head without.
        drop: (N,) how far an open jaw takes a vertex down, as a share of the farthest; zeros where it is unknown.
    """

    vertices: Floats
    skin: NDArray[np.integer]
    eyes: NDArray[np.integer]
    drop: Floats

    def landmarks(self) -> dict[str, Floats]:
        """Return name -> (3,) of all places that are found; both heads need the same names to be compared."""
        found: dict[str, Floats] = {}
        for part in (self._eyes, self._mouth, self._profile, self._outline):
            found |= {name: point for name, point in part() if np.isfinite(point).all()}
        return found

    @cached_property
    def _picture(self) -> tuple[NDArray[np.int32], Floats, Floats]:
        """Return (h, w) triangle, -1 for none, (h, w, 3) places, (h, w) drop; NaN where there is nothing."""
        triangles = np.concatenate([self.skin, self.eyes])
        x, y, z = self.vertices.T
        points = np.stack([(x - _LEFT) / PITCH, (_TOP - y) / PITCH, -z], 1)
        width, height = round((_RIGHT - _LEFT) / PITCH), round((_TOP - _BOTTOM) / PITCH)
        face, shares = rasterise(points, triangles, width, height)
        corners, nothing = triangles[face], face < 0
        place = np.einsum("hwc,hwcd->hwd", shares, self.vertices[corners])
        drop = np.einsum("hwc,hwc->hw", shares, self.drop[corners])
        place[nothing], drop[nothing] = np.nan, np.nan
        return face, place, drop

    def _eyes(self) -> Iterator[tuple[str, Floats]]:
        face, place, _ = self._picture
        shown = face >= len(self.skin)
        middle = shown.shape[1] // 2
        for side, columns in (("left", slice(middle, None)), ("right", slice(0, middle))):
            yield from self._opening(side, shown[:, columns], place[:, columns])

    def _opening(self, side: str, shown: NDArray[np.bool_], place: Floats) -> Iterator[tuple[str, Floats]]:
        across = np.flatnonzero(shown.sum(0) > 1)
        if len(across) < 10:
            return
        for share in _LID_SHARES:
            # Counted from the nose on either side.
            column = round(float(np.quantile(across, share if side == "left" else 1 - share)))
            rows = np.flatnonzero(shown[:, column])
            if len(rows):
                yield f"{side} lid above {share}", place[rows[0] - 1, column]
                yield f"{side} lid below {share}", place[rows[-1] + 1, column]
        for name, column in (("first", across[0]), ("last", across[-1])):
            corner = {"leftfirst": "inner", "rightlast": "inner"}.get(side + name, "outer")
            row = round(float(np.flatnonzero(shown[:, column]).mean()))
            yield f"{side} {corner} corner", place[row, column]

    def mouth_line(self) -> Floats:
        """Return (n, 3) where the lips meet, from the right corner to the left; none where no jaw tells."""
        return self._picture[1][self._lip_rows()]

    def _mouth(self) -> Iterator[tuple[str, Floats]]:
        line = self.mouth_line()
        if len(line) < 20:
            return
        # Between lips that stand apart the back of the mouth is seen.
        lips = line[:, 2] > np.median(line[:, 2]) - _BEHIND
        for share in _LIP_SHARES:
            place = round(share * (len(line) - 1))
            if lips[place]:
                yield f"mouth {share:.3f}", line[place]

    def edges(self) -> dict[str, NDArray[np.int32]]:
        """Return what a look's moving shadows need: vertices of lids and lips next to their openings, by x.

        Keys are those of `Look.edges`; empty unless both eyes and the mouth are found.
        """
        found: dict[str, NDArray[np.int32]] = {}
        face, _, _ = self._picture
        shown = face >= len(self.skin)
        middle = shown.shape[1] // 2
        columns = np.flatnonzero(shown.sum(0) > 1)
        for side, own in (("left", columns[columns >= middle]), ("right", columns[columns < middle])):
            rows = [np.flatnonzero(shown[:, column]) for column in own]
            found[f"{side}_upper"] = self._next_to([row[0] - 1 for row in rows], own)
            found[f"{side}_lower"] = self._next_to([row[-1] + 1 for row in rows], own)
        row, columns = self._lip_rows()
        found["mouth_upper"] = self._next_to(row - _ROWS, columns)
        found["mouth_lower"] = self._next_to(row + _ROWS, columns)
        return found if min(map(len, found.values())) > 2 else {}

    def _next_to(self, rows: Iterable[int] | NDArray[np.intp], columns: NDArray[np.intp]) -> NDArray[np.int32]:
        """Return the vertices nearest to some cells of the picture, once each, by x."""
        face, place, _ = self._picture
        at = np.array([*rows], np.intp), columns
        on_skin = (face[at] >= 0) & (face[at] < len(self.skin))
        corners = self.skin[face[at][on_skin]]
        away = np.linalg.norm(self.vertices[corners] - place[at][on_skin][:, None], axis=2)
        found = np.unique(corners[np.arange(len(corners)), away.argmin(1)])
        return found[np.argsort(self.vertices[found, 0], kind="stable")].astype(np.int32)

    def _lip_rows(self) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
        """Return rows and columns of the picture where the lips meet, from right to left."""
        drop = self._picture[2]
        first, last = (round((_TOP - y) / PITCH) for y in _MOUTH)
        step = np.nan_to_num(drop[first + _ROWS : last] - drop[first : last - _ROWS])
        row, known = step.argmax(0) + first + _ROWS // 2, step.max(0) > _STEP
        middle = step.shape[1] // 2
        if not known[middle]:
            return np.zeros(0, np.intp), np.zeros(0, np.intp)
        end = middle + int(np.argmin(known[middle:]))
        begin = middle - int(np.argmin(known[middle::-1])) + 1
        columns = np.arange(begin, end)
        return row[columns], columns

    def _profile(self) -> Iterator[tuple[str, Floats]]:
        """Yield tip, root and base of the nose, lips, chin and forehead, on the midline."""
        _, place, _ = self._picture
        line = place[:, place.shape[1] // 2]
        line = line[np.isfinite(line).all(1)]
        y, z = line[:, 1], line[:, 2]
        tip = _most(z, (y < -5) & (y > -70))
        yield "nose tip", line[tip]
        yield "nose root", line[_most(-z, (y < 20) & (y > y[tip] + 15))]
        mouth = self.mouth_line()
        level = float(np.median(mouth[:, 1])) if len(mouth) else y[tip] - 32
        base = _most(-z, (y < y[tip] - 6) & (y > level + 8))
        yield "nose base", line[base]
        yield "upper lip", line[_most(z, (y < y[base] - 5) & (y > level + 1))]
        lower = _most(z, (y < level - 1) & (y > level - 14))
        yield "lower lip", line[lower]
        fold = _most(-z, (y < y[lower]) & (y > level - 24))
        yield "chin fold", line[fold]
        chin = _most(z, (y < y[fold] - 4) & (y > level - 50))
        yield "chin", line[chin]
        # The last row of the chin and not the first below it: that may be a neck, far behind.
        under = np.flatnonzero((y < y[chin]) & (z < z[chin] - _UNDER))
        yield "under chin", line[under[0] - 1] if len(under) else np.full(3, np.nan)
        for height in _FOREHEAD:
            yield f"forehead {height:g}", line[int(np.abs(y - height).argmin())]

    def _outline(self) -> Iterator[tuple[str, Floats]]:
        """Yield the crown, the ears, and the wings of the nose."""
        used = np.unique(self.skin)
        points = self.vertices[used]
        yield "crown", _middle(points, points[:, 1]) * (0, 1, 1)
        level = points[(points[:, 1] < 30) & (points[:, 1] > -45)]
        for side, sign in (("left", 1), ("right", -1)):
            yield f"{side} ear", _middle(level, sign * level[:, 0])
        found = dict(self._profile())
        height = 0.2 * found["nose base"][1] + 0.8 * found["nose tip"][1]
        row = self._picture[1][round((_TOP - height) / PITCH)]
        for side, sign in (("left", 1), ("right", -1)):
            yield f"{side} nose wing", _wing(row[np.isfinite(row[:, 0])], sign)


def _wing(row: Floats, sign: int) -> Floats:
    """Return where a row across the nose has fallen from its ridge nearly to the cheek."""
    out = row[(sign * row[:, 0] >= 0) & (sign * row[:, 0] < _CHEEK)]
    out = out[np.argsort(sign * out[:, 0])]
    cheek = out[-1, 2] if len(out) else 0.0
    if len(out) < 4 or out[0, 2] <= cheek:
        return np.full(3, np.nan)
    return np.asarray(out[np.flatnonzero(out[:, 2] > cheek + _WING * (out[0, 2] - cheek))[-1]])


def _middle(points: Floats, out: Floats) -> Floats:
    """Return the middle of what stands out most: on round things the farthest vertex itself is a matter of chance."""
    cap = points[out > out.max() - _CAP]
    return np.asarray((cap.min(0) + cap.max(0)) / 2)


def _most(values: Floats, where: NDArray[np.bool_]) -> int:
    """Return the index of the greatest value in a stretch; of the nearest to it where it is empty."""
    return int(np.where(where, values, -np.inf).argmax())
