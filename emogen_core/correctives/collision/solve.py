"""Weights of the collision correctives (EmoGen 2021, section III-A, eqs. 2 to 5), solved in rounds.

Every contact is one constraint: the correctives must open its pair by ``b = depth + margin``. ``A`` holds by how much
one unit of a corrective opens it: eq. 3 for lips (vertical), eq. 4 for teeth (outward). Eq. 5 is minimised within
bounds:

    C = w1 |A w - b|^2 + (1 - w1) M |w|^2,   w1 = 0.98, 0 <= w <= 1

Where both types collide, each type's constraints move only its own correctives; the other type's share is a constant
that the other type's own solve updates (alternated until it stands still). Where one type collides, the
other's correctives are disabled.

Ours, all measured (docs/collisions.md): lengths in millimetres, because w1 has a unit; detection is repeated and each
round solves for increments in [0, 1 - w], because solving anew oscillates; a margin; the best round is kept, so
a correction never deepens; and of a symmetric face only the left half is sampled, every constraint being doubled by
its mirror image, which halves the work and keeps the solution symmetric. Where the linear model itself says that a
round will leave a collision, only the anchors that met the lip are looked at after it; all are before a face is done.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from emogen_core.correctives.collision.bounded import box_least_squares
from emogen_core.correctives.collision.detect import TOLERANCE, Detection, detect
from emogen_core.correctives.collision.model import ZONES, collision_model
from emogen_core.correctives.collision.rays import OUT, UP
from emogen_core.correctives.collision.regions import LIPS, TEETH
from emogen_core.face.evaluate import checked_weights

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from emogen_core.correctives.collision.detect import Contacts
    from emogen_core.correctives.collision.model import CollisionModel
    from emogen_core.face.rig import Rig

    _System = tuple[slice, slice, NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]

DATA_WEIGHT = 0.98
MARGIN = 0.3
ROUNDS = 6

_COUNT = 2 * ZONES
_OWN = {LIPS: slice(0, ZONES), TEETH: slice(ZONES, _COUNT)}
_TWIN = np.array([3, 2, 1, 0, 7, 6, 5, 4])
_ALTERNATIONS = 8
_STILL = 1e-6
# A step that moves no lip by a hundredth of a millimetre: the correctives are at their bounds.
_NOTHING = 1e-3


@dataclass(frozen=True, eq=False)
class CollisionResult:
    """What the collision stage did to a batch of faces; stored with them.

    Attributes:
        weights: (B, 8) float32 weights of the collision correctives in [0, 1]; exactly 0 without a collision.
        depth_before: (B,) greatest depth of an anchor in the lower lip, millimetres, without correctives.
        depth_after: (B,) the same with them; never greater.
        collided: (B, 2) bool, which types collided: lips, teeth.
        rounds: (B,) how often a face was solved.
    """

    weights: NDArray[np.float32]
    depth_before: NDArray[np.float64]
    depth_after: NDArray[np.float64]
    collided: NDArray[np.bool_]
    rounds: NDArray[np.intp]


def solve_collisions(rig: Rig, identity: str, weights: NDArray[np.float32]) -> CollisionResult:
    """Return the collision correctives' weights for a batch of faces.

    Args:
        rig: a rig with the eight collision correctives.
        identity: the head that wears it.
        weights: (B, K) weights of all shapes in [0, 1]; those of the collision correctives are taken as 0.

    Raises:
        InvalidInputError: bad weights, unknown identity, or a rig without collision correctives.
    """
    alpha = checked_weights(weights, len(rig.shape_names)).copy()
    model = collision_model(rig, identity)
    alpha[:, -_COUNT:] = 0
    # One by one, not as one product: a face must not depend, in its last bits, on the batch that it came in.
    faces = [FaceSolver(model, row) for row in alpha]
    solved = [face.solve() for face in faces]
    return CollisionResult(
        np.array([w for w, _, _ in solved], np.float32).reshape(-1, _COUNT),
        np.array([face.before.depth for face in faces], np.float64),
        np.array([depth for _, depth, _ in solved], np.float64),
        np.array([[len(f.before.lips) > 0, len(f.before.teeth) > 0] for f in faces], bool).reshape(-1, 2),
        np.array([rounds for _, _, rounds in solved], np.intp),
    )


class FaceSolver:
    """One face while it is corrected; of a symmetric one only the left half is looked at."""

    def __init__(self, model: CollisionModel, weights: NDArray[np.float32]) -> None:
        """Take the face's (K,) weights, those of the collision correctives 0."""
        self.symmetric = model.is_symmetric(weights)
        self.model = model.half if self.symmetric else model
        self.patch, self.anchors = self.model.evaluate(weights)
        self.before = self.detect(np.zeros(_COUNT))

    def detect(self, weights: NDArray[np.float64], among: NDArray[np.intp] | None = None) -> Detection:
        """Detect with the collision correctives at (8,) weights; ``among`` as in `detect`."""
        patch, anchors = self.patch, self.anchors
        if weights.any():
            patch = patch + _sum(weights, self.model.unit_patch)
            anchors = anchors + _sum(weights, self.model.unit_anchors)
        return detect(anchors, self.model.kind, patch, self.model.triangles, among=among)

    def solve(self) -> tuple[NDArray[np.float64], float, int]:
        """Return the (8,) weights, the depth they leave, and the rounds it took."""
        weights, found, met, rounds = np.zeros(_COUNT), self.before, self.before.met, 0
        best, depth, sure = weights, found.depth, True
        while found.collides and rounds < ROUNDS:
            step, left = increments(self.model, found, weights, mirrored=self.symmetric)
            if step.max() < _NOTHING:
                break
            # Judged as stored: in single precision.
            weights = np.minimum(weights + step, 1).astype(np.float32).astype(np.float64)
            rounds += 1
            found, whole = self._looked(weights, met if left > TOLERANCE and rounds < ROUNDS else None)
            met = np.union1d(met, found.met) if whole else met
            if found.depth < depth:
                best, depth, sure = weights, found.depth, whole
        depth = depth if sure else self.detect(best).depth
        # What was seen among few anchors only may not hold.
        return (best, depth, rounds) if depth <= self.before.depth else (np.zeros(_COUNT), self.before.depth, rounds)

    def _looked(self, weights: NDArray[np.float64], among: NDArray[np.intp] | None) -> tuple[Detection, bool]:
        """Detect among some anchors, and among all where these find nothing; return also whether it was among all."""
        if among is not None and (found := self.detect(weights, among)).collides:
            return found, False
        return self.detect(weights), True


def _sum(weights: NDArray[np.float64], offsets: NDArray[np.float64]) -> NDArray[np.float64]:
    return (weights @ offsets.reshape(_COUNT, -1)).reshape(offsets.shape[1:])


def increments(
    model: CollisionModel, found: Detection, weights: NDArray[np.float64], *, mirrored: bool = False
) -> tuple[NDArray[np.float64], float]:
    """Return the (8,) increments in [0, 1 - weights] that minimise eq. 5, and the depth that they should leave.

    ``mirrored`` adds the mirror image of every constraint.
    """
    listed = ((LIPS, found.lips, UP), (TEETH, found.teeth, OUT))
    parts = [(kind, *constraints(model, pairs, axis)) for kind, pairs, axis in listed if len(pairs)]
    if mirrored:
        parts = [(kind, np.concatenate([a, a[:, _TWIN]]), np.concatenate([b, b])) for kind, a, b in parts]
    ridge = (1 - DATA_WEIGHT) * sum(len(b) for _, _, b in parts)
    step = _alternated([_normal_equations(kind, a, b, ridge) for kind, a, b in parts], 1 - weights)
    step = (step + step[_TWIN]) / 2 if mirrored else step
    return step, max((float((b - MARGIN - a @ step).max()) for _, a, b in parts), default=0.0)


def _alternated(systems: list[_System], room: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the (8,) solution within [0, room] of each type's equations, the other's share taken as it is."""
    step = np.zeros(_COUNT)
    for own, _, matrix, _, goal in systems:
        step[own] = np.linalg.solve(matrix, goal)
    step = np.clip(step, 0, room)
    for _ in range(_ALTERNATIONS if len(systems) > 1 else 1):
        last = step.copy()
        for own, other, matrix, shared, goal in systems:
            step[own] = box_least_squares(matrix, goal - shared @ step[other], room[own], step[own])
        if np.abs(step - last).max() < _STILL:
            break
    return step


def _normal_equations(kind: int, jacobian: NDArray[np.float64], b: NDArray[np.float64], ridge: float) -> _System:
    """Return of one type: its correctives, the other's, matrix, what a unit of the other's does to the goal, goal."""
    own, other = _OWN[kind], _OWN[1 - kind]
    weighted = DATA_WEIGHT * jacobian[:, own].T
    return own, other, weighted @ jacobian[:, own] + ridge * np.eye(ZONES), weighted @ jacobian[:, other], weighted @ b


def constraints(
    model: CollisionModel, contacts: Contacts, axis: int
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return ``A`` (M, 8) and ``b`` (M,) of one type, millimetres: eq. 3 along the vertical, eq. 4 outward."""
    corners = model.triangles[contacts.face]
    lower = np.einsum("umc,mc->mu", model.unit_patch[:, corners, axis], contacts.corners)
    anchor = model.unit_anchors[:, contacts.anchor, axis].T
    opened = anchor - lower if axis == UP else lower - anchor
    return opened, contacts.depth + MARGIN
