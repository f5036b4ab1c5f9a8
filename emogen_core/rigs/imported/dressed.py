"""The bundled look on a foreign head: every vertex that is drawn takes what its place on the bundled head wears.

Nothing is painted anew. Skin, brows, hair, lips and wrinkles come with the texture's place; baked light, hair's
thickness and wrinkle masks come with them. So any appearance can be worn, and textures are those of the bundled head.
Teeth and tongue take the place of a bundled tooth and tongue; an eyeball is laid out about its own cornea.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
from scipy.spatial import cKDTree

from emogen_core.rendering.look import Layer, Look, topology_hash
from emogen_core.rendering.look_check import check_look
from emogen_core.rigs.eyeballs import RADIUS
from emogen_core.rigs.imported.match import Placed, islands, islands_of, nearest
from emogen_core.rigs.imported.openness import darkening, openness
from emogen_core.rigs.imported.overlay import Skin
from emogen_core.rigs.imported.parts import FLESH, pieces
from emogen_core.rigs.look.atlas import EYE_DEGREES, TEETH_A_JAW, teeth_box
from emogen_core.rigs.look.seen import seen_layers

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from numpy.typing import NDArray

    from emogen_core.face.rig import Rig
    from emogen_core.rigs.imported.gaze import Eyeball

    Floats = NDArray[np.float64]
    Indices = NDArray[np.intp]

# Lashes are never shown quite at their roots: there the texture of the other lid's begins.
_LASH_EDGE = 0.05
# Lids meet so far below the middle of the eye, millimetres.
_LIDS_MEET = -2.0
# Where crowns lie on the box of a jaw's teeth, as shares of its height.
_CROWN = (0.60, 0.90)
_OPENINGS = 9.0  # millimetres


@dataclass(frozen=True, eq=False)
class _Piece:
    """A part of the skin layer: rig vertices, (t, 3) triangles into them, and where they are on the bundled layer."""

    source: Indices
    triangles: Indices
    placed: Placed


@dataclass(frozen=True, eq=False)
class Dresser:
    """What a foreign head is dressed from.

    Attributes:
        rig: the foreign rig.
        look: the bundled one.
        template: the bundled rig.
        warped: its skin, lying on the foreign head's.
        flesh: the foreign head's skin, with what lies in mouth and sockets.
        eyes: ``left`` and ``right``.
    """

    rig: Rig
    look: Look
    template: Rig
    warped: Skin
    flesh: Skin
    eyes: Mapping[str, Eyeball]

    def dressed(self, style: str, edges: Mapping[str, NDArray[np.int32]]) -> Look:
        """Return the look of the foreign rig.

        Args:
            style: the bundled identity whose skin, eyes and hair are worn where nobody says otherwise.
            edges: see `Look.edges`.
        """
        parts = [*self._flesh(), *self._teeth(), *self._tongue()]
        layers = {"skin": _joined(self.look.layers["skin"], parts)}
        layers |= {name: layer for name, layer in (("eyes", self._eyes()), ("lashes", self._lashes())) if layer}
        placed = Placed(
            np.concatenate([part.placed.corners for part in parts]),
            np.concatenate([part.placed.shares for part in parts]),
        )
        kept, left = seen_layers(self.rig, layers)
        at = Placed(placed.corners[left["skin"]], placed.shares[left["skin"]])
        made = Look(
            name=f"{self.look.name} on {self.rig.name}",
            topology=topology_hash(self.rig),
            layers=kept,
            styles=self.look.styles,
            default=style,
            textures=self.look.textures,
            bakes=self._bakes(kept["skin"], at),
            wrinkle_masks=at.of(self.look.wrinkle_masks).astype(np.float32),
            wrinkle_drivers=self.look.wrinkle_drivers,
            wrinkle_rest=self.look.wrinkle_rest,
            edges=edges,
            paint={**self.look.paint, "scalp": at.of(self.look.paint["scalp"]).astype(np.float16)},
        )
        check_look(made)
        return made

    def _bakes(self, layer: Layer, at: Placed) -> dict[str, NDArray[np.float32]]:
        """Return the bundled light at the layer's vertices, dimmed where this head is deep and that one is not."""
        skin = np.unique(self.rig.triangles[slice(*self.rig.parts["skin"])]).astype(np.intp)
        flesh = self.rig.triangles[: max(self.rig.parts[name][1] for name in FLESH)]
        dim = np.ones(self.rig.offsets.shape[1])
        dim[skin] = darkening(openness(self.rig.neutral(self.rig.identities[0]), flesh, skin))
        # Eyelids and lips are deep in themselves; the bundled head's are as deep.
        dim[self._near_openings(skin)] = 1
        dimmed = {}
        for name, bake in self.look.bakes.items():
            light = at.of(bake).astype(np.float32)
            light[:, :2] *= dim[layer.source, None]
            dimmed[name] = light
        return dimmed

    def _near_openings(self, skin: Indices) -> Indices:
        """Return the vertices of the skin next to where it ends, at the lips and the lids."""
        neutral = self.rig.neutral(self.rig.identities[0])
        rims = np.intersect1d(skin, np.concatenate([_vertices(self.rig, name) for name in ("mouth", "sockets")]))
        if not len(rims):
            return skin[:0]
        return skin[cKDTree(neutral[rims]).query(neutral[skin])[0] < _OPENINGS]

    def _flesh(self) -> Iterator[_Piece]:
        """Yield the skin, mouth and sockets, an island of the texture at a time."""
        template = islands(self.look.layers["skin"], self.warped)
        first, last = zip(*(self.rig.parts[name] for name in FLESH), strict=True)
        triangles = self.rig.triangles[: max(last)]
        rows = np.arange(len(triangles))
        own = {name: (rows >= a) & (rows < b) for name, a, b in zip(FLESH, first, last, strict=True)}
        target = Skin(self.flesh.vertices, triangles, self.flesh.drop)
        number = islands_of(target, template, own)
        features = self.flesh.features()
        for island in range(len(template.part)):
            chosen = triangles[number == island]
            if len(chosen):
                source, local = np.unique(chosen, return_inverse=True)
                surface = replace(template.surface, triangles=template.surface.triangles[template.number == island])
                placed = nearest(surface, features[source], target.vertices[source])
                yield _Piece(source.astype(np.intp), local.reshape(-1, 3), placed)

    def _teeth(self) -> Iterator[_Piece]:
        """Yield each jaw's teeth: crowns everywhere, as white as the bundled ones so far from the middle.

        The bundled gums and the dark lines between its teeth are painted, and would fall anywhere on others.
        """
        layer = self.look.layers["skin"]
        for name in ("teeth_upper", "teeth_lower"):
            theirs = np.flatnonzero(np.isin(layer.source, _vertices(self.template, name)))
            left, bottom, right, top = teeth_box(name)
            across = (layer.uv[theirs, 0] - left) / (right - left) * TEETH_A_JAW % 1
            down = (layer.uv[theirs, 1] - bottom) / (top - bottom)
            crown = (np.abs(across - 0.5) < 0.3) & (down > _CROWN[0]) & (down < _CROWN[1])
            yield from self._along(name, theirs[crown], axes=(0,))

    def _tongue(self) -> Iterator[_Piece]:
        layer = self.look.layers["skin"]
        yield from self._along("tongue", np.flatnonzero(np.isin(layer.source, _vertices(self.template, "tongue"))))

    def _along(self, part: str, theirs: Indices, axes: tuple[int, ...] = (0, 1, 2)) -> Iterator[_Piece]:
        """Yield a part whose vertices each take the place of one of theirs, at the same share of the extent."""
        rows = self.rig.triangles[slice(*self.rig.parts.get(part, (0, 0)))]
        if not len(rows):
            return
        layer = self.look.layers["skin"]
        source, local = np.unique(rows, return_inverse=True)
        here = _shares(self.rig.neutral(self.rig.identities[0])[source][:, axes])
        there = _shares(self.template.neutral(self.template.identities[0])[layer.source[theirs]][:, axes])
        found = theirs[cKDTree(there).query(here)[1]]
        placed = Placed(np.repeat(found[:, None], 3, 1), np.tile([1.0, 0.0, 0.0], (len(found), 1)))
        yield _Piece(source.astype(np.intp), local.reshape(-1, 3), placed)

    def _eyes(self) -> Layer | None:
        """Return the eyeballs, each laid out about the axis of its cornea."""
        names = [f"eye_{side}" for side in self.eyes]
        rows = [self.rig.triangles[slice(*self.rig.parts[name])] for name in names]
        if not rows:
            return None
        source, local = np.unique(np.concatenate(rows), return_inverse=True)
        uv = np.full((len(source), 2), 0.5)
        neutral = self.rig.neutral(self.rig.identities[0])
        for side, eye in self.eyes.items():
            chosen = np.isin(source, _vertices(self.rig, f"eye_{side}"))
            uv[chosen] += _polar(neutral[source[chosen]] - eye.centre, eye, 1 if side == "left" else -1)
        surface = np.tile(np.array([0, 1, 0], np.float32), (len(source), 1))
        return Layer(source.astype(np.int32), uv.astype(np.float32), local.reshape(-1, 3).astype(np.int32), surface)

    def _lashes(self) -> Layer | None:
        """Return the lashes: along by their place between the corners of the eye, up by how far off the skin."""
        rows = self.rig.triangles[slice(*self.rig.parts.get("lashes", (0, 0)))]
        if not len(rows) or len(self.eyes) < 2:
            return None
        source, local = np.unique(rows, return_inverse=True)
        neutral = self.rig.neutral(self.rig.identities[0]).astype(np.float64)
        points = neutral[source]
        off = np.asarray(cKDTree(self.flesh.vertices[self.flesh.used]).query(points)[0], np.float64)
        uv = np.zeros((len(source), 2))
        # A lash belongs to one lid as a whole, wherever its ends are.
        number = np.zeros(len(source), np.intp)
        number[local.reshape(-1, 3)] = pieces(rows)[:, None]
        middle = np.bincount(number, points[:, 1]) / np.maximum(np.bincount(number), 1)
        for piece in _sides(points, middle[number], self.eyes):
            across = np.asarray(np.abs(points[piece, 0]), np.float64)
            along = (across - across.min()) / max(float(np.ptp(across)), 1e-6)
            up = np.clip(off[piece] / max(float(np.quantile(off[piece], 0.98)), 1e-6), _LASH_EDGE, 1)
            centre = float(np.mean([eye.centre[1] for eye in self.eyes.values()]))
            upper = middle[number[piece]].mean() > centre + _LIDS_MEET
            uv[piece] = np.column_stack([along, (0.5 if upper else 0.0) + 0.5 * up])
        surface = np.tile(np.array([0.3, 0, 0], np.float32), (len(source), 1))
        return Layer(source.astype(np.int32), uv.astype(np.float32), local.reshape(-1, 3).astype(np.int32), surface)


def _sides(points: Floats, heights: Floats, eyes: Mapping[str, Eyeball]) -> Iterator[Indices]:
    """Yield the vertices of each lid's lashes: left and right, by (n,) heights above and below the middle."""
    for eye in eyes.values():
        own = np.sign(points[:, 0]) == np.sign(eye.centre[0])
        for above in (True, False):
            chosen = np.flatnonzero(own & ((heights > eye.centre[1] + _LIDS_MEET) == above))
            if len(chosen):
                yield chosen


def _polar(points: Floats, eye: Eyeball, sign: int) -> Floats:
    """Return (n, 2) where on the eye's texture points about an eyeball's centre lie, from its middle."""
    length = np.maximum(np.linalg.norm(points, axis=1, keepdims=True), 1e-9)
    across = np.cross([0.0, 1.0, 0.0], eye.axis)
    across /= np.linalg.norm(across)
    up = np.cross(eye.axis, across)
    cosine = np.clip((points / length) @ eye.axis, -1, 1)
    degrees = np.minimum(np.degrees(np.arccos(cosine)) * eye.radius / RADIUS, EYE_DEGREES)
    way = np.stack([sign * (points @ across), points @ up], 1)
    way /= np.maximum(np.linalg.norm(way, axis=1, keepdims=True), 1e-9)
    return np.asarray(degrees[:, None] / EYE_DEGREES / 2 * way)


def _shares(points: NDArray[np.floating]) -> Floats:
    """Return (n, k) where points lie in the box around them, 0 to 1."""
    low, high = points.min(0), points.max(0)
    return np.asarray((points - low) / np.maximum(high - low, 1e-9), np.float64)


def _vertices(rig: Rig, part: str) -> NDArray[np.int32]:
    return np.unique(rig.triangles[slice(*rig.parts[part])])


def _joined(worn: Layer, parts: list[_Piece]) -> Layer:
    starts = np.cumsum([0, *(len(part.source) for part in parts)])
    placed = [part.placed for part in parts]
    return Layer(
        np.concatenate([part.source for part in parts]).astype(np.int32),
        np.concatenate([each.of(worn.uv) for each in placed]).astype(np.float32),
        np.concatenate([part.triangles + start for part, start in zip(parts, starts, strict=False)]).astype(np.int32),
        np.concatenate([each.of(worn.surface) for each in placed]).astype(np.float32),
    )
