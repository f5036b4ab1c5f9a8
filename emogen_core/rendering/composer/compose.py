"""The composer: mixes the shared layers into what one head wears. The same appearance gives the same bytes."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from emogen_core.rendering.composer.brows import Brows
from emogen_core.rendering.composer.eye import Eye
from emogen_core.rendering.composer.hair import lay_hair, thickness
from emogen_core.rendering.composer.layers import Layers, needed, unpack_grey
from emogen_core.rendering.composer.skin import bare_skin, lay_beard, lay_lids, lay_lips

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from emogen_core.face.appearance import Appearance

# What is left of red, green and blue where so much light gets in, 0 to 255: dark places are red.
_CAVITY = np.linspace(0, 1, 256, dtype=np.float32)[:, None] ** np.array([0.50, 0.74, 0.78], np.float32)
# How yellow teeth swallow light, at most.
_STAINED = np.array([0.06, 0.125, 0.23], np.float32)


class Composer:
    """Paints textures from the layers of one look. Decoding them takes its time once; painting keeps nothing."""

    def __init__(self, paint: Mapping[str, NDArray[np.generic]]) -> None:
        """Decode the layers of a look.

        Raises:
            RigFileError: a layer is missing.
        """
        self._fields = Layers(paint)
        self.size = round(len(self._fields.grey("blood")) ** 0.5)
        inside = unpack_grey(np.asarray(needed(paint, "inside"), np.uint8)) / np.float32(255)
        self._inside = np.moveaxis(inside.reshape(4, -1, inside.shape[1]), 0, -1)
        self._cheeks = np.asarray(needed(paint, "cheeks"), np.intp)
        self._scalp = np.asarray(needed(paint, "scalp"), np.float32)
        self._brows, self._eye = Brows(paint), Eye(paint)

    def skin(self, look: Appearance) -> NDArray[np.uint8]:
        """Return the (size, size, 3) uint8 albedo, in gamma 2."""
        colour = bare_skin(self._fields, look)
        lay_lips(colour, self._fields, look)
        lay_lids(colour, self._fields, look)
        lay_beard(colour, self._fields, look)
        lay_hair(colour, self._fields, look)
        colour *= _CAVITY[self._fields.grey("cavity")]
        image = colour.reshape(self.size, self.size, 3)
        top, left = self._brows.corner
        height, width = self._brows.shape
        self._brows.lay(image[top : top + height, left : left + width], look)
        self._lay_inside(image, look)
        return np.asarray(np.round(np.clip(image, 0, 1) * 255), np.uint8)

    def eye(self, look: Appearance) -> NDArray[np.uint8]:
        """Return the (512, 512, 4) uint8 eyeball, polar about the pupil; alpha is 1 on the cornea."""
        return self._eye.paint(look)

    def lashes(self, look: Appearance) -> NDArray[np.uint8]:
        """Return (256, 1024, 4) uint8 lashes; alpha is what covers."""
        return self._eye.lashes(look)

    def tone(self, look: Appearance) -> tuple[float, float, float]:
        """Return the mean colour of the bare cheeks, 0 to 1."""
        cheeks = {name: values[self._cheeks] for name, values in self._fields.items()}
        red, green, blue = bare_skin(cheeks, look).mean(0)
        return round(float(red), 4), round(float(green), 4), round(float(blue), 4)

    def hair(self, look: Appearance) -> NDArray[np.float32]:
        """Return (R,) millimetres by which hair lifts the skin layer's render vertices."""
        return thickness(self._scalp, look)

    def _lay_inside(self, image: NDArray[np.float32], look: Appearance) -> None:
        """Put mouth, tongue, teeth and sockets into the lower right corner: stored in colour and share of enamel."""
        height, width = self._inside.shape[:2]
        yellowed = self._inside[..., :3] * (1 - self._inside[..., 3:] * _STAINED * look.teeth)
        image[-height:, -width:] = yellowed
