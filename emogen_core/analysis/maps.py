"""A map of faces: their first principal components.

The axes are the eigenvectors of the faces' covariance: there are many more faces than weights. The sign of each is
set so that its entry of greatest size is positive, since the mathematics leave it open and a map must not flip from
one day to the next.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from emogen_core.errors import InvalidInputError, expected

if TYPE_CHECKING:
    from numpy.typing import NDArray


@dataclass(frozen=True, slots=True, eq=False)
class FaceMap:
    """Where faces lie on a map.

    Attributes:
        centre: (K,) mean of all faces.
        axes: (c, K) orthonormal.
        places: (n, c) coordinates of the faces.
        shares: (c,) share of the variance that each axis explains; 0 where there is none.
    """

    centre: NDArray[np.float64]
    axes: NDArray[np.float64]
    places: NDArray[np.float64]
    shares: NDArray[np.float64]

    def place(self, faces: NDArray[np.floating]) -> NDArray[np.float64]:
        """Return the (..., c) coordinates of further (..., K) faces."""
        return np.asarray((np.asarray(faces, np.float64) - self.centre) @ self.axes.T)


def face_map(faces: NDArray[np.floating], components: int = 2) -> FaceMap:
    """Return the map of (n, K) faces by their first principal components.

    Raises:
        InvalidInputError: fewer faces or fewer weights than components, or fewer than two faces.
    """
    given = np.asarray(faces, np.float64)
    if given.ndim != 2 or len(given) < max(2, components) or given.shape[1] < components:
        raise InvalidInputError(f"faces: {expected(f'(n, K), both at least {max(2, components)}', given.shape)}")
    centre = given.mean(axis=0)
    centred = given - centre
    variances, found = np.linalg.eigh(centred.T @ centred)
    variances, axes = np.maximum(variances[::-1], 0), found.T[::-1][:components]
    greatest = np.abs(axes).argmax(axis=1)
    axes = axes * np.where(axes[np.arange(components), greatest] < 0, -1.0, 1.0)[:, None]
    total = float(variances.sum())
    shares = variances[:components] / total if total > 0 else np.zeros(components)
    return FaceMap(centre, axes, centred @ axes.T, shares)
