"""Carries the shapes of a template to another head of the same mesh.

Every method works where the target is moved, turned and scaled onto the template, so what comes out moves, turns and
scales with the target. Methods, the best one first:

``fields``    a smooth warp of space (`warp`), and what training expressions differ from it by, given to the shapes
              that are worn in them by a prior of smooth gains and directions (`residuals`).
``ridge``     the same with a plain ridge at each vertex instead of the prior.
``warp``      the warp alone.
``examples``  example-based rigging (Li, Weise & Pauly 2010), on ``deformation``.
``deformation``  deformation transfer (Sumner & Popovic 2004).
``copy``      the template's offsets as they are.

Symbols: ``K`` shapes, ``N`` vertices, ``T`` triangles, ``E`` training expressions.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from emogen_core.errors import InvalidInputError, expected
from emogen_core.transfer.alignment import Alignment, align
from emogen_core.transfer.deformation import deformed, rigged_by_example
from emogen_core.transfer.residuals import Evidence, with_fields, with_ridge
from emogen_core.transfer.samples import bells, spread_samples
from emogen_core.transfer.warp import warp_jacobians

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from numpy.typing import NDArray

    Mesh = NDArray[np.float64]

_SAMPLES = 150


@dataclass(frozen=True, eq=False)
class Template:
    """The shapes to carry over; lengths are millimetres and the head's middle is x = 0.

    Attributes:
        neutral: (N, 3).
        offsets: (K, N, 3) shape minus neutral.
        triangles: (T, 3) vertex indices.
    """

    neutral: NDArray[np.floating]
    offsets: NDArray[np.floating]
    triangles: NDArray[np.integer]


@dataclass(frozen=True, eq=False)
class Training:
    """Expressions of the target head of which is known what was posed.

    Attributes:
        weights: (E, K) of every shape, 0 and above; the packing's are 0 or 1.
        meshes: (E, N, 3) in the target's frame and unit.
    """

    weights: NDArray[np.floating]
    meshes: NDArray[np.floating]


def transfer(
    template: Template, target: NDArray[np.floating], training: Training | None = None, method: str = "fields"
) -> Mesh:
    """Return the template's shapes on another head.

    Args:
        template: the face model.
        target: (N, 3) the other head's neutral, in any frame and unit, its vertices in the template's order.
        training: expressions of that head; ``copy``, ``warp`` and ``deformation`` do not look at them.
        method: see the module.

    Returns:
        (K, N, 3) offsets in the target's frame and unit.

    Raises:
        InvalidInputError: an array has another shape or is not finite, a weight is negative, the target is a point, or
            there is no such method.
    """
    if method not in METHODS:
        raise InvalidInputError(f"method: {expected(f'one of {list(METHODS)}', method)}")
    check_template(template)
    check_meshes("target", target, template.neutral.shape)
    if training is not None:
        _check_training(template, training)
    alignment = align(template.neutral, target)
    return alignment.offsets_back(METHODS[method](_Task(template, target, training, alignment)))


@dataclass(frozen=True, eq=False)
class _Task:
    """What methods work on: what was given, and from it, when a method asks, arrays of the template's frame."""

    given: Template
    target: NDArray[np.floating]
    training: Training | None
    alignment: Alignment

    @cached_property
    def neutral(self) -> Mesh:
        """(N, 3) the template at rest, millimetres."""
        return self.given.neutral.astype(np.float64)

    @cached_property
    def offsets(self) -> Mesh:
        """(K, N, 3) the template's shapes, millimetres from its neutral."""
        return self.given.offsets.astype(np.float64)

    @cached_property
    def aimed(self) -> Mesh:
        """(N, 3) the target at rest, laid onto the template, millimetres."""
        return self.alignment.onto_template(self.target)

    @cached_property
    def samples(self) -> NDArray[np.intp]:
        """(M,) vertices, spread evenly, on which smooth functions stand."""
        return spread_samples(self.neutral, _SAMPLES)

    @cached_property
    def evidence(self) -> Evidence:
        """The training expressions, laid onto the template with the target; none where none were given."""
        if self.training is None or not len(self.training.weights):
            return Evidence(np.zeros((0, len(self.offsets))), np.zeros((0, *self.neutral.shape)))
        shown = self.alignment.onto_template(self.training.meshes) - self.aimed
        return Evidence(self.training.weights.astype(np.float64), shown)


def _copied(task: _Task) -> Mesh:
    return task.offsets


def _warped(task: _Task) -> Mesh:
    turns = warp_jacobians(task.neutral, task.aimed, task.samples)
    moved: Mesh = task.offsets.swapaxes(0, 1) @ turns.swapaxes(1, 2)
    return moved.swapaxes(0, 1)


def _ridge(task: _Task) -> Mesh:
    return with_ridge(_warped(task), task.evidence)


def _fields(task: _Task) -> Mesh:
    return with_fields(_warped(task), task.evidence, bells(task.neutral, task.samples))


def _deformed(task: _Task) -> Mesh:
    return deformed(task.neutral, task.offsets, task.given.triangles, task.aimed)


def _by_example(task: _Task) -> Mesh:
    return rigged_by_example(task.neutral, task.offsets, task.given.triangles, task.aimed, task.evidence)


METHODS: Mapping[str, Callable[[_Task], Mesh]] = {
    "fields": _fields,
    "ridge": _ridge,
    "warp": _warped,
    "examples": _by_example,
    "deformation": _deformed,
    "copy": _copied,
}
"""Method -> what carries it out, the best one first."""


def check_template(template: Template) -> None:
    """Raise `InvalidInputError` unless shapes, vertices and triangles fit and are finite."""
    neutral, triangles = template.neutral, template.triangles
    check_meshes("neutral", neutral, (len(neutral), 3))
    check_meshes("offsets", template.offsets, (len(template.offsets), *neutral.shape))
    inside = triangles.ndim == 2 and triangles.shape[1] == 3 and triangles.size > 0
    if not inside or triangles.min() < 0 or triangles.max() >= len(neutral):
        wanted = expected(f"(triangles, 3) indices within {len(neutral)} vertices", triangles.shape)
        raise InvalidInputError(f"triangles: {wanted}")


def _check_training(template: Template, training: Training) -> None:
    count = len(training.meshes)
    check_meshes("expressions", training.meshes, (count, *template.neutral.shape))
    weights = training.weights
    if weights.shape != (count, len(template.offsets)):
        wanted = f"shape {(count, len(template.offsets))}, an expression a row and a shape a column"
        raise InvalidInputError(f"weights: {expected(wanted, weights.shape)}")
    if not (np.isfinite(weights).all() and (weights >= 0).all() and weights.any(1).all()):
        wanted = "finite weights of 0 and above, one of them above 0 in every expression"
        raise InvalidInputError(f"weights: {expected(wanted, 'others')}")


def check_meshes(what: str, array: NDArray[np.floating], shape: tuple[int, ...]) -> None:
    """Raise `InvalidInputError` unless an array has a shape and only finite lengths."""
    if array.shape != shape:
        told = "it has to be the template's mesh, vertex by vertex"
        raise InvalidInputError(f"{what}: {expected(f'shape {shape}', array.shape)}; {told}")
    if not np.isfinite(array).all():
        bad = np.argwhere(~np.isfinite(array))[0].tolist()
        raise InvalidInputError(f"{what}: {expected('finite lengths', f'{array[tuple(bad)]} at {bad}')}")
