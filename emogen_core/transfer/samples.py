"""Points spread evenly over a head, and smooth functions around them."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from scipy.spatial.distance import cdist

from emogen_core.transfer.packing.symmetry import mirror_image

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Mesh = NDArray[np.float64]

# Millimetres: of a mesh whose every vertex is a sample, each stands for itself.
_NARROWEST = 1e-3


def spread_samples(neutral: Mesh, most: int) -> NDArray[np.intp]:
    """Return so many vertices of an (N, 3) head, sorted, each farthest from those before it, with its mirror image.

    Of a symmetric head they are symmetric, and so is what is made from them: where a mirror image is one too many, it
    is taken all the same. There are fewer where the head has fewer places.
    """
    mirror = mirror_image(neutral)
    chosen: list[int] = []
    away = np.full(len(neutral), np.inf)
    first = int(((neutral - neutral.mean(0)) ** 2).sum(1).argmax())
    while len(chosen) < min(most, len(neutral)) and away[first] > 0:
        for new in (first, int(mirror[first])):
            if away[new] > 0:
                chosen.append(new)
                away = np.minimum(away, ((neutral - neutral[new]) ** 2).sum(1))
        first = int(away.argmax())
    return np.array(sorted(chosen), np.intp)


def bells(neutral: Mesh, samples: NDArray[np.intp]) -> Mesh:
    """Return (N, M) shares that sum to 1 at every vertex: Gaussian bells, as wide as samples are apart."""
    distance = cdist(neutral, neutral[samples])
    width = max(float(distance.min(1).max()), _NARROWEST)
    # The nearest sample's bell is taken as 1, so that none of a far vertex's vanish together.
    depth = (distance**2 - distance.min(1, keepdims=True) ** 2) / (2 * width**2)
    share = np.exp(-depth)
    shares: Mesh = share / share.sum(1, keepdims=True)
    return shares
