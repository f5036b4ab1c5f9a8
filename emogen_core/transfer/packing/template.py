"""The face model as packing sees it: arrays, and nothing else."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from emogen_core.errors import InvalidInputError, expected

if TYPE_CHECKING:
    from numpy.typing import NDArray


@dataclass(frozen=True, eq=False)
class Template:
    """Shapes to pack. The head faces +z, its left is x > 0 and its middle x = 0; lengths are millimetres.

    Attributes:
        names: of the K shapes.
        neutral: (N, 3).
        offsets: (K, N, 3) shape minus neutral.
        triangles: (T, 3) vertex indices.
        target: (N, 3) neutral of the head that the expressions are made for; the template's own without it.
        visible: (N,) the vertices that count, see `reaches`; all without it.
        gaze: indices of the shapes that turn an eye.
    """

    names: tuple[str, ...]
    neutral: NDArray[np.floating]
    offsets: NDArray[np.floating]
    triangles: NDArray[np.integer]
    target: NDArray[np.floating] | None = None
    visible: NDArray[np.bool_] | None = None
    gaze: tuple[int, ...] = ()


def check_template(template: Template) -> None:
    """Raise `InvalidInputError` unless everything fits, every number is finite, and every shape moves something."""
    count, vertices = len(template.names), len(template.neutral)
    if not count:
        raise InvalidInputError(f"shapes: {expected('one or more', 0)}; pack a face model that has blendshapes")
    _shaped("neutral", template.neutral, (vertices, 3))
    _shaped("offsets", template.offsets, (count, vertices, 3))
    if template.target is not None:
        _shaped("target", template.target, (vertices, 3))
    triangles = template.triangles
    if triangles.ndim != 2 or triangles.shape[1] != 3 or not _within(triangles, vertices):
        wanted = expected(f"(triangles, 3) indices within {vertices} vertices", triangles.shape)
        raise InvalidInputError(f"triangles: {wanted}")
    still = [name for name, mesh in zip(template.names, template.offsets, strict=True) if not mesh.any()]
    if still:
        raise InvalidInputError(f"shapes: {expected('offsets other than 0', still)}; leave these shapes out")


def _shaped(what: str, array: NDArray[np.floating], shape: tuple[int, ...]) -> None:
    if array.shape != shape:
        raise InvalidInputError(f"{what}: {expected(f'shape {shape}', array.shape)}; vertices have to be the same ones")
    if not np.isfinite(array).all():
        bad = np.argwhere(~np.isfinite(array))[0].tolist()
        raise InvalidInputError(f"{what}: {expected('finite millimetres', f'{array[tuple(bad)]} at {bad}')}")


def _within(indices: NDArray[np.integer], count: int) -> bool:
    return not indices.size or bool(indices.min() >= 0 and indices.max() < count)
