"""From weights to what the graphics card reads: positions, normals and shading attributes of every render vertex.

One interleaved float32 row a render vertex, in the order that the shaders expect:
position (3), normal (3), texture (2), light (2: sight of the key light, translucency), tint (4).
On skin the tint is (occlusion, skin, gloss, wrinkle activation), on eyeballs (lid shadow, 0, strength of the
catchlight, way to the lower lid in radii); there the light is the way from the lamp's image, in radii.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from emogen_core.face.evaluate import vertices
from emogen_core.rendering.look import HAIR_DEPTH
from emogen_core.rendering.normals import NormalField
from emogen_core.rendering.recent import Recent
from emogen_core.rendering.worn import dropped_look, dropped_rig, worn_look, worn_rig

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from numpy.typing import NDArray

    from emogen_core.face.rig import Rig
    from emogen_core.rendering.camera import Camera
    from emogen_core.rendering.look import Look
    from emogen_core.rendering.worn import WornHead

POSITION, NORMAL, TEXTURE, LIGHT, TINT = slice(0, 3), slice(3, 6), slice(6, 8), slice(8, 10), slice(10, 14)
COLUMNS = 14
# Between lips at rest it is dark: how dark, and by how many millimetres they part until light gets in.
_CLOSED_MOUTH, _OPEN_MOUTH = 0.20, 2.4
# From so many millimetres behind the lips it grows dark, over so many more, and how much of the light is lost there.
_LIT_DEPTH, _DARK_DEPTH, _CAVITY = 14.0, 32.0, 0.80
# How dark an eyeball is right under the upper lid, and over what part of its radius the shadow runs out.
_LID_SHADOW, _LID_REACH = 0.34, 0.34
# How dark it is in the corners, where the lids meet, and from how many radii between the lids it is light.
_CORNER, _CORNER_REACH = 0.62, 0.60
# The upper lip shades what is behind it: by how much, and over how many millimetres the shadow runs out.
_LIP_SHADOW, _LIP_REACH = 0.42, 4.5
# What comes forward to the lips is in the open: from how many millimetres behind them on, and how light it is there.
_FORWARD, _OPEN_AIR = 12.0, 0.84
# The lamp's image on the eye: where on a wide eye that looks ahead and how large, in radii of the eyeball. It goes a
# part of the cornea's way with the gaze, slides down under a lowered lid and goes out as the eye shuts.
_CATCH, _WITH_GAZE = np.array([-0.17, 0.17]), 0.4
# Under half-shut lids the whole lamp would lie in the slit, a white dot: it fades before.
_CATCH_SIZE, _SHUT, _OPEN = 0.105, 0.12, 0.34
# How far the bust may move, millimetres, before what had faded out would show.
_STIRRED = 3.0


class Surface:
    """Computes render vertices of faces of one rig in one look."""

    def __init__(self, rig: Rig, look: Look, turn: float = 0.0) -> None:
        """Prepare for a rig.

        Args:
            rig: the face model.
            look: what it wears.
            turn: degrees by which heads look to the viewer's right, about the vertical axis between the eyes. The light
                stands still, but for shadows that were found without the turn (mouth, lids, what is baked).

        Raises:
            InvalidInputError: the look was made for another topology.
        """
        look.check(rig)
        self.rig, self.look = rig, look
        self._turn = _turning(turn) if turn else None
        self._normals = NormalField(_needed(rig, look), rig.offsets.shape[1])
        names = {name: i for i, name in enumerate(rig.shape_names)}
        self._wrinkle_gains = [_gains(drivers, names) for drivers in look.wrinkle_drivers]
        inside = look.layers["skin"].surface[:, 2]
        self._inside = np.flatnonzero(inside)
        self._depth_of_mouth = inside[self._inside]
        self._rest: Recent[str, float] = Recent()
        self._creased = np.flatnonzero(look.wrinkle_masks.any(axis=1))
        self._masks = np.ascontiguousarray(look.wrinkle_masks[self._creased].T)
        self._rests = look.wrinkle_rest or (1.0,) * len(look.wrinkle_drivers)
        self._eyeballs = _eyeballs(rig, look)
        self._hair: Recent[str, tuple[NDArray[np.intp], NDArray[np.float32]]] = Recent()
        self._templates: Recent[str, dict[str, NDArray[np.float32]]] = Recent()

    def wear(self, head: WornHead) -> None:
        """Take a head in; what is kept under its name stays right, for the name says what it is."""
        self.rig, self.look = worn_rig(self.rig, head), worn_look(self.look, head)

    def drop(self, name: str) -> None:
        """Let a head go."""
        self.rig, self.look = dropped_rig(self.rig, name), dropped_look(self.look, name)

    def faces(self, identity: str, weights: NDArray[np.float32]) -> Iterator[dict[str, NDArray[np.float32]]]:
        """Yield layer name -> (R, 14) float32 rows for each face of a (B, K) batch.

        Raises:
            InvalidInputError: bad weights, or an identity that the rig does not have.
        """
        for mesh, alpha in zip(vertices(self.rig, identity, weights), weights, strict=True):
            rows = self.dress(identity, alpha, mesh, self._normals(mesh))
            if self._turn is not None:
                for layer in rows.values():
                    layer[:, POSITION], layer[:, NORMAL] = (
                        layer[:, POSITION] @ self._turn,
                        layer[:, NORMAL] @ self._turn,
                    )
            yield rows

    def normals(self, mesh: NDArray[np.float32]) -> NDArray[np.float32]:
        """Return the (N, 3) unit normals of an (N, 3) mesh; zero or unfinished at vertices that no layer draws."""
        return self._normals(mesh)

    def dress(
        self, identity: str, alpha: NDArray[np.float32], mesh: NDArray[np.float32], normals: NDArray[np.float32]
    ) -> dict[str, NDArray[np.float32]]:
        """Return layer name -> (R, 14) float32 rows of one face, from its (K,) weights, mesh and normals."""
        rows = {name: template.copy() for name, template in self._template(identity).items()}
        for name, layer in self.look.layers.items():
            rows[name][:, POSITION] = mesh.take(layer.source, axis=0)
            # Normals lie a coordinate at a time (`NormalField`).
            rows[name][:, NORMAL] = normals.T.take(layer.source, axis=1).T
        self._comb(rows["skin"], identity)
        if "mouth_upper" in self.look.edges:
            self._light_mouth(rows["skin"], identity, mesh)
        self._crease(rows["skin"], identity, alpha)
        if "eyes" in rows and "left_upper" in self.look.edges:
            self._shade_eyes(rows["eyes"], mesh)
        return rows

    def neutral_skin(self, identity: str) -> NDArray[np.float32]:
        """Return the (n, 3) vertices of an identity's neutral skin, hair included: what the camera has to frame."""
        first, last = self.rig.parts["skin"]
        used = np.unique(self.rig.triangles[first:last])
        return self._neutral(identity)[np.isin(self.look.layers["skin"].source, used)]

    def framed_skin(self, identity: str, camera: Camera) -> NDArray[np.int32]:
        """Return the (t, 3) triangles of the skin layer that lie above where the bust has faded out."""
        neutral = self._neutral(identity)
        x, y, _ = (neutral if self._turn is None else neutral @ self._turn).T
        _, gone, sideward = camera.fade
        triangles = self.look.layers["skin"].triangles
        above = y - sideward * x**2 > gone - _STIRRED
        framed: NDArray[np.int32] = triangles[above[triangles].any(1)]
        return framed

    def _neutral(self, identity: str) -> NDArray[np.float32]:
        """Return the (R, 3) render vertices of an identity's neutral skin, hair included."""
        source, neutral = self.look.layers["skin"].source, self.rig.neutral(identity)
        rows = np.zeros((len(source), COLUMNS), np.float32)
        rows[:, POSITION], rows[:, NORMAL] = neutral[source], self._normals(neutral)[source]
        self._comb(rows, identity)
        dressed: NDArray[np.float32] = rows[:, POSITION]
        return dressed

    def _comb(self, rows: NDArray[np.float32], identity: str) -> None:
        """Lift the hair off the scalp."""
        haired, lift = self._hair.get(identity, lambda: self._lift(identity))
        rows[haired, POSITION] += lift * rows[haired, NORMAL]

    def _lift(self, identity: str) -> tuple[NDArray[np.intp], NDArray[np.float32]]:
        hair = self.look.bakes[self.look.style(identity).bake][:, 3]
        haired = np.flatnonzero(hair)
        return haired, HAIR_DEPTH * hair[haired, None]

    def _template(self, identity: str) -> dict[str, NDArray[np.float32]]:
        return self._templates.get(identity, lambda: dict(self._blank(identity)))

    def _blank(self, identity: str) -> Iterator[tuple[str, NDArray[np.float32]]]:
        for name, layer in self.look.layers.items():
            rows = np.zeros((len(layer.source), COLUMNS), np.float32)
            rows[:, TEXTURE] = layer.uv
            rows[:, 8], rows[:, 10], rows[:, 11:13] = 1, 1, layer.surface[:, :2]
            if name == "skin":
                bake = self.look.bakes[self.look.style(identity).bake]
                rows[:, 10], rows[:, LIGHT] = bake[:, 0], bake[:, 1:3]
            yield name, rows

    def _light_mouth(self, rows: NDArray[np.float32], identity: str, mesh: NDArray[np.float32]) -> None:
        rest = self._rest.get(identity, lambda: self._gap(self.rig.neutral(identity)))
        opening = float(_smooth(np.array((self._gap(mesh) - rest) / _OPEN_MOUTH)))
        lip = mesh[self.look.edges["mouth_upper"]]
        inside = np.ascontiguousarray(rows.take(self._inside, axis=0).T)
        x, y, z = inside[:3]
        behind = lip[:, 2].max() - z
        light = inside[[10, 8]]
        forward = _smooth(1 - behind / _FORWARD)
        light += np.maximum(_OPEN_AIR - light, 0) * (self._depth_of_mouth * forward)
        shaded = (1 - _smooth((np.interp(x, lip[:, 0], lip[:, 1]) - y) / _LIP_REACH)) * (1 - forward)
        light *= 1 - _LIP_SHADOW * self._depth_of_mouth * shaded
        light[0] *= 1 - self._depth_of_mouth * (1 - _CLOSED_MOUTH) * (1 - opening)
        light[0] *= 1 - _CAVITY * self._depth_of_mouth * _smooth((behind - _LIT_DEPTH) / _DARK_DEPTH)
        rows[self._inside, 10], rows[self._inside, 8] = light

    def _gap(self, mesh: NDArray[np.float32]) -> float:
        """Return how far the inner edges of the lips are apart, millimetres, where that is most."""
        upper, lower = mesh[self.look.edges["mouth_upper"]], mesh[self.look.edges["mouth_lower"]]
        return float((upper[:, 1] - np.interp(upper[:, 0], lower[:, 0], lower[:, 1])).max())

    def _crease(self, rows: NDArray[np.float32], identity: str, alpha: NDArray[np.float32]) -> None:
        style = self.look.style(identity)
        smooth = np.ones(len(self._creased), np.float32)
        for gain, mask, rest in zip(self._wrinkle_gains, self._masks, self._rests, strict=True):
            # The more muscles fold the same skin, the less each of them adds: strong faces stay apart.
            pull = max(0.0, float(alpha @ gain))
            folded = pull / (1 + pull**3) ** (1 / 3)
            calm = style.lines * rest
            active = style.wrinkles * (calm + (1 - calm) * folded)
            if active:
                smooth *= 1 - active * mask
        rows[self._creased, 13] = 1 - smooth

    def _shade_eyes(self, rows: NDArray[np.float32], mesh: NDArray[np.float32]) -> None:
        for side, (chosen, pupil) in self._eyeballs.items():
            upper, lower = mesh[self.look.edges[f"{side}_upper"]], mesh[self.look.edges[f"{side}_lower"]]
            points = np.ascontiguousarray(rows[chosen, :2].T)
            low, high = points.min(1), points.max(1)
            centre, radius = (low + high) / 2, (high[0] - low[0]) / 2
            below = (np.interp(points[0], upper[:, 0], upper[:, 1]) - points[1]) / radius
            above = (points[1] - np.interp(points[0], lower[:, 0], lower[:, 1])) / radius
            light = _LID_SHADOW + (1 - _LID_SHADOW) * _smooth(below / _LID_REACH)
            light *= _CORNER + (1 - _CORNER) * _smooth((above + below) / _CORNER_REACH)
            rows[chosen, 10] = light * (0.72 + 0.28 * _smooth(above / 0.16))
            gaze = (rows[pupil, :2].mean(0) - centre) / radius
            lamp, rows[chosen, 12] = _catch_light(centre, radius, gaze, (upper, lower))
            rows[chosen, LIGHT] = (points.T - centre) / radius - lamp
            rows[chosen, 13] = np.minimum(np.maximum(above, -1), 1)


def _turning(degrees: float) -> NDArray[np.float32]:
    """Return the (3, 3) matrix that turns rows to the viewer's right."""
    cosine, sine = np.cos(np.deg2rad(degrees)), np.sin(np.deg2rad(degrees))
    return np.array([[cosine, 0, -sine], [0, 1, 0], [sine, 0, cosine]], np.float32)


def _catch_light(
    centre: NDArray[np.float32],
    radius: float,
    gaze: NDArray[np.float32],
    lids: tuple[NDArray[np.float32], NDArray[np.float32]],
) -> tuple[NDArray[np.float32], float]:
    """Return where on the eyeball the lamp is mirrored, in radii from its middle, and how brightly, 0 to 1."""
    lamp = np.asarray(_CATCH + _WITH_GAZE * gaze, np.float32)
    at = float(centre[0] + lamp[0] * radius)
    top, bottom = (float((np.interp(at, lid[:, 0], lid[:, 1]) - centre[1]) / radius) for lid in lids)
    lamp[1] = min(float(lamp[1]), max(top - _CATCH_SIZE, (top + bottom) / 2))
    return lamp, float(_smooth(np.array((top - bottom - _SHUT) / (_OPEN - _SHUT))))


def _eyeballs(rig: Rig, look: Look) -> dict[str, tuple[NDArray[np.intp], NDArray[np.intp]]]:
    """Return each side's render vertices of the eyes, and those of them in the middle of the pupil."""
    if "eyes" not in look.layers:
        return {}
    layer = look.layers["eyes"]
    across = rig.neutral(rig.identities[0])[layer.source, 0]
    # Eyes are mapped polar about their pupils.
    away = np.linalg.norm(layer.uv - np.float32(0.5), axis=1)
    middle = away < away.min() + 1e-3
    sides = {"left": across > 0, "right": across <= 0}
    return {name: (np.flatnonzero(side), np.flatnonzero(side & middle)) for name, side in sides.items()}


def _needed(rig: Rig, look: Look) -> NDArray[np.int32]:
    """Return the (t, 3) triangles of the rig around vertices that are drawn."""
    drawn = np.zeros(rig.offsets.shape[1], bool)
    for layer in look.layers.values():
        drawn[layer.source] = True
    return rig.triangles[drawn[rig.triangles].any(1)]


def _gains(drivers: Mapping[str, float], names: Mapping[str, int]) -> NDArray[np.float32]:
    gains = np.zeros(len(names), np.float32)
    for name, gain in drivers.items():
        if name in names:
            gains[names[name]] = gain
    return gains


def _smooth(t: NDArray[Any]) -> NDArray[Any]:
    """Return smoothstep of t between 0 and 1."""
    # In half the time of `np.clip`.
    clipped = np.minimum(np.maximum(t, 0), 1)
    smooth: NDArray[Any] = clipped * clipped * (3 - 2 * clipped)
    return smooth
