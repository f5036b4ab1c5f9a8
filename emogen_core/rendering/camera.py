"""Where the camera stands: one place for all faces of an identity, found from its neutral head.

The crown lies at `CROWN` of the picture's height and the chin at `CHIN`, whatever the head's size, so that controls
may sit above and below a face without covering it. The camera is level, on the line x = 0, and looks along -z.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

CROWN = 0.07
CHIN = 0.765
FIELD_OF_VIEW = np.deg2rad(17.0)
NEAR = 200.0
FAR = 4000.0
# Where the bust starts to fade into the background and where it is gone, in heights of the picture above its lower
# edge, and how much earlier that is towards the sides: shoulders never reach the frame.
_FADE_FROM, _FADE_TO, _FADE_SIDEWARD = 0.145, 0.012, 0.58
_STEPS = 30


@dataclass(frozen=True, slots=True)
class Camera:
    """A level camera: height of its axis and distance from the origin along z, millimetres.

    ``bottom`` is the height (y, millimetres, in the plane z = 0) of the picture's lower edge.
    """

    height: float
    distance: float

    @property
    def bottom(self) -> float:
        """Height of the lower edge of the picture in the plane z = 0, millimetres."""
        return float(self.height - self.distance * np.tan(FIELD_OF_VIEW / 2))

    @property
    def fade(self) -> tuple[float, float, float]:
        """Heights (mm) where the bust starts to fade and where it is gone, and ``k``: both rise by ``k x^2``."""
        span = 2 * (self.height - self.bottom)
        return self.bottom + _FADE_FROM * span, self.bottom + _FADE_TO * span, _FADE_SIDEWARD / span

    def matrix(self, width: int, height: int) -> NDArray[np.float64]:
        """Return the (4, 4) projection from millimetres to clip space for a picture of this size."""
        focal = 1 / np.tan(FIELD_OF_VIEW / 2)
        depth = (FAR + NEAR) / (NEAR - FAR), 2 * FAR * NEAR / (NEAR - FAR)
        projection = np.array(
            [[focal * height / width, 0, 0, 0], [0, focal, 0, 0], [0, 0, *depth], [0, 0, -1, 0]], np.float64
        )
        view = np.eye(4)
        view[1, 3], view[2, 3] = -self.height, -self.distance
        return projection @ view

    def project(self, points: NDArray[np.floating], width: int, height: int) -> NDArray[np.float64]:
        """Return (n, 3): column, row (pixels, from the upper left) and depth in [-1, 1] of (n, 3) points."""
        homogeneous = np.column_stack([points, np.ones(len(points))]) @ self.matrix(width, height).T
        ndc = homogeneous[:, :3] / homogeneous[:, 3:]
        return np.column_stack([(ndc[:, 0] + 1) * width / 2, (1 - ndc[:, 1]) * height / 2, ndc[:, 2]])


def frame_head(skin: NDArray[np.floating]) -> Camera:
    """Return the camera that frames a neutral head.

    Args:
        skin: (n, 3) vertices of the skin, millimetres; head, neck and what there is of shoulders.
    """
    crown = skin[np.argmax(skin[:, 1])]
    chin = chin_point(skin)
    slope = np.tan(FIELD_OF_VIEW / 2)
    height, distance = 0.0, float(crown[1] - chin[1]) / slope
    for _ in range(_STEPS):
        # The silhouette's highest point depends on the camera: nearer vertices look higher.
        crown = skin[np.argmax((skin[:, 1] - height) / (distance - skin[:, 2]))]
        rise = np.array([(p[1] - height) / (distance - p[2]) / slope for p in (crown, chin)])
        wanted = 1 - 2 * np.array([CROWN, CHIN])
        distance *= float((rise[0] - rise[1]) / (wanted[0] - wanted[1]))
        rise = np.array([(p[1] - height) / (distance - p[2]) / slope for p in (crown, chin)])
        height += float((rise - wanted).mean() * slope * distance)
    return Camera(float(height), float(distance))


def chin_point(skin: NDArray[np.floating]) -> NDArray[np.floating]:
    """Return the (3,) lowest point of the chin in the midline of a neutral head whose eyes are at the origin."""
    crown = skin[:, 1].max()
    midline = skin[np.abs(skin[:, 0]) < 0.05 * crown]
    low = midline[(midline[:, 1] < -0.5 * crown) & (midline[:, 1] > -1.25 * crown)]
    front = low[np.argmax(low[:, 2] - low[:, 1])]
    under = low[(low[:, 2] > front[2] - 0.2 * crown) & (low[:, 1] > front[1] - 0.15 * crown)]
    point: NDArray[np.floating] = under[np.argmin(under[:, 1])]
    return point
