"""Faces of the report: mean faces as participants would see them, and where two of them differ."""

from __future__ import annotations

import io
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np
from PIL import Image

from emogen_core.analysis.heat import vertex_difference
from emogen_core.face.evaluate import vertices
from emogen_core.rendering.heat import HeatArtist
from emogen_core.rendering.protocol import RenderSettings

from ..reporting.pictures import inline, rounded_up
from ..services.faces.sketch import Sketch

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from ..services.faces.portraits import PortraitDrawer
    from ..services.faces.wardrobe import Wardrobe

    Floats = NDArray[np.float64]

SIZE = RenderSettings(200, 240)


@dataclass(frozen=True, slots=True)
class Two:
    """Two mean faces of one head that are compared."""

    label: str
    identity: str
    names: tuple[str, str]
    weights: tuple[Floats, Floats]


@dataclass(frozen=True, slots=True)
class Picture:
    """Pictures side by side, each an address that holds it and the words under it."""

    label: str
    parts: tuple[tuple[str, str], ...]


@dataclass(frozen=True, slots=True)
class Gallery:
    """Pictures with one scale: `limit` in millimetres has the last colour, 0 where no heat is shown."""

    pictures: tuple[Picture, ...]
    limit: float = 0.0


@dataclass(frozen=True)
class Studio:
    """Draws faces of every head of a study."""

    drawer: PortraitDrawer
    wardrobe: Wardrobe
    _artists: dict[str, HeatArtist] = field(default_factory=dict)

    def portraits(self, faces: Sequence[tuple[str, str, str, Floats]]) -> Gallery:
        """Return the pictures of faces: label, words, head, (K,) weights.

        Raises:
            RenderingError: this machine cannot draw.
        """
        drawn = self._drawn([(identity, weights) for _, _, identity, weights in faces])
        return Gallery(
            tuple(Picture(label, ((one, words),)) for (label, words, _, _), one in zip(faces, drawn, strict=True))
        )

    def differences(self, pairs: Sequence[Two]) -> Gallery:
        """Return pairs of faces, each with the distance of their surfaces as heat, all on one scale.

        Raises:
            RenderingError: this machine cannot draw.
        """
        apart = [
            vertex_difference(self.wardrobe.rig(two.identity), two.identity, *map(_ranged, two.weights))
            for two in pairs
        ]
        limit = rounded_up(max(float(one.max()) for one in apart))
        drawn = self._drawn([(two.identity, weights) for two in pairs for weights in two.weights])
        pictures = []
        for at, (two, values) in enumerate(zip(pairs, apart, strict=True)):
            heat = inline(self._artist(two.identity).draw(self._mesh(two), values, limit))
            words = (*two.names, f"apart (≤ {values.max():.1f} mm)")
            parts = tuple(zip((*drawn[2 * at : 2 * at + 2], heat), words, strict=True))
            pictures.append(Picture(two.label, parts))
        return Gallery(tuple(pictures), limit)

    def _drawn(self, faces: Sequence[tuple[str, Floats]]) -> list[str]:
        """Return faces as addresses, all of them asked for before the first is taken."""
        waiting = [
            self.drawer.submit(Sketch(identity, _ranged(weights), SIZE), 0, self.wardrobe.head(identity))
            for identity, weights in faces
        ]
        return [inline(Image.open(io.BytesIO(one.result())).convert("RGB")) for one in waiting]

    def _mesh(self, two: Two) -> NDArray[np.floating]:
        rig = self.wardrobe.rig(two.identity)
        return np.asarray(vertices(rig, two.identity, _ranged(two.weights[1])[np.newaxis])[0])

    def _artist(self, identity: str) -> HeatArtist:
        if identity not in self._artists:
            rig = self.wardrobe.rig(identity)
            start, end = rig.parts["skin"] if "skin" in rig.parts else (0, len(rig.triangles))
            skin = rig.neutral(identity)[np.unique(rig.triangles[start:end])]
            self._artists[identity] = HeatArtist(skin, rig.triangles, SIZE)
        return self._artists[identity]


def _ranged(weights: Floats) -> NDArray[np.float32]:
    return np.asarray(weights, np.float32).clip(0, 1)
