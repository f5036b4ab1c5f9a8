"""Left and right of a foreign head's shapes made alike where they all but are.

Shapes that were drawn on both sides, or scanned, differ by tenths of a millimetre from their mirror images. Nobody sees
that, but a symmetric face of them is none: its mouth would be corrected by halves that differ, in twice the time.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from emogen_core.rigs.foreign.mirror import FLIP

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from emogen_core.rigs.foreign.model import Findings

    Offsets = NDArray[np.float32]

# Millimetres: what differs by more is meant to.
_SLIGHT = 0.5
# Shapes are mirror images where they differ by less than this share of their length.
_ALIKE = 0.2
# What differs by less is what files round off, and stays as it is.
_ROUNDED = 0.02
_NONE = -1


def evened(shapes: Mapping[str, Offsets], mirror: NDArray[np.integer]) -> dict[str, Offsets]:
    """Return shapes whose vertices move as their mirror images do, wherever the two differ slightly.

    Args:
        shapes: name -> (N, 3) float32 offsets, millimetres. Which of them, or whether itself, is a shape's mirror image
            is told by where they go.
        mirror: (N,) which vertex mirrors which; none for a head that is not symmetric, whose shapes stay as they are.
    """
    if not mirror.size or not shapes:
        return dict(shapes)
    names, offsets = [*shapes], np.stack([*shapes.values()])
    twins = _twins(offsets, mirror)
    made = {}
    for shape, name in enumerate(names):
        own, image = offsets[shape], offsets[twins[shape], mirror] * FLIP
        apart = np.linalg.norm(image - own, axis=1, keepdims=True)
        near = (apart > _ROUNDED) & (apart < _SLIGHT)
        mutual = twins[shape] != _NONE and twins[twins[shape]] == shape
        made[name] = np.where(near, (own + image) / 2, own) if mutual else shapes[name]
    return made


def say_evened(before: Mapping[str, Offsets], after: Mapping[str, Offsets], findings: Findings) -> None:
    """Say how many shapes were made alike, and by how much at most."""
    told = [most for name in before if (most := float(np.abs(after[name] - before[name]).max())) > 0]
    if told:
        findings.found.append(
            f"Left and right of {len(told)} shapes were made alike where they nearly were, by up to {max(told):.2f} mm."
        )


def _twins(offsets: Offsets, mirror: NDArray[np.integer]) -> NDArray[np.intp]:
    """Return (K,) which of the (K, N, 3) shapes is most like each one's mirror image, or `_NONE`."""
    flat = offsets.reshape(len(offsets), -1)
    images = (offsets[:, mirror] * FLIP).reshape(flat.shape)
    size = (flat.astype(np.float64) ** 2).sum(1)
    both = np.maximum(size[:, None] + size[None], 1e-12)
    # |a - b|^2 = |a|^2 + |b|^2 - 2 ab, and an image is as long as its shape.
    unlike = 1 - 2 * (flat @ images.T).astype(np.float64) / both
    twins = unlike.argmin(1)
    return np.where(unlike[np.arange(len(twins)), twins] < _ALIKE**2, twins, _NONE)
