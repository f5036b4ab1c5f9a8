"""From a template and a choice of options to the expressions, with the proof that no fewer would do."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from emogen_core.errors import InvalidInputError, expected
from emogen_core.transfer.packing.activity import binary_shapes, displacements, reaches
from emogen_core.transfer.packing.importance import (
    Importance,
    displacement_strength,
    similarities,
    triangle_distortion,
)
from emogen_core.transfer.packing.orders import greedy, minimal
from emogen_core.transfer.packing.poseability import Rules, poseable
from emogen_core.transfer.packing.solver import fewest
from emogen_core.transfer.packing.symmetry import find_mirrored, mirror_image
from emogen_core.transfer.packing.template import Template, check_template
from emogen_core.transfer.packing.units import make_units

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from emogen_core.transfer.packing.symmetry import Mirrored
    from emogen_core.transfer.packing.units import Units

ORDERS = ("greedy", "minimal")


@dataclass(frozen=True, slots=True)
class Options:
    """How a template is packed.

    Attributes:
        mu: see `binary_shapes`.
        alpha: share of displacement in the importance, in [0, 1]; the distortion of triangles has the rest.
        beta: weight of uniqueness in the importance, 0 or more.
        most: how many expressions are wanted at most; all of them without it.
        symmetric: whether mirror images are only worn together (eq. 3d).
        poseable: whether rules of `emogen_core.transfer.packing.poseability` hold as well.
        order: see `emogen_core.transfer.packing.orders`.
    """

    mu: float = 0.33
    alpha: float = 0.5
    beta: float = 0.0
    most: int | None = None
    symmetric: bool = True
    poseable: bool = True
    order: str = "greedy"

    def check(self) -> None:
        """Raise `InvalidInputError` unless every value can be meant; `binary_shapes` looks at ``mu``."""
        if not 0 <= self.alpha <= 1:
            raise InvalidInputError(f"alpha: {expected('a number in [0, 1]', self.alpha)}")
        if not 0 <= self.beta < np.inf:
            raise InvalidInputError(f"beta: {expected('a finite number of 0 or more', self.beta)}")
        if self.most is not None and self.most < 1:
            raise InvalidInputError(f"max: {expected('a whole number of 1 or more', self.most)}")
        if self.order not in ORDERS:
            raise InvalidInputError(f"order: {expected(f'one of {ORDERS}', self.order)}")


@dataclass(frozen=True, slots=True)
class Expression:
    """One expression to make: some shapes at weight 1, all others at 0.

    Attributes:
        adds: the shapes that this expression shows and no other does; those that go together stand together.
        holds: shapes that are worn besides, since the others cannot be posed without them.
        importance: sum of the added shapes' importance when it was chosen (eq. 3a).
    """

    adds: tuple[tuple[int, ...], ...]
    holds: tuple[int, ...]
    importance: float

    @property
    def shapes(self) -> tuple[int, ...]:
        """All shapes that are worn, ascending."""
        return tuple(sorted({*self.holds, *(shape for unit in self.adds for shape in unit)}))


@dataclass(frozen=True, slots=True, eq=False)
class Packing:
    """The expressions that show every shape of a template.

    Attributes:
        expressions: in their order; fewer than all where `Options.most` says so.
        needed: how many there would be without `Options.most`.
        minimum: with fewer than these no shape could be shown by itself: proven.
        importance: (K,) of every shape when its turn came (eq. 4).
        reach: (K, N) displacements as shares of a shape's greatest, see `reaches`.
        active: (K, N) the binary shapes.
        mirrored: mirror images among the shapes.
        rules: what every expression keeps.
    """

    expressions: tuple[Expression, ...]
    needed: int
    minimum: int
    importance: NDArray[np.float64]
    reach: NDArray[np.floating] = field(repr=False)
    active: NDArray[np.bool_] = field(repr=False)
    mirrored: Mirrored
    rules: Rules

    @property
    def weights(self) -> NDArray[np.float64]:
        """(J, K) weights of all shapes in every expression, 0 or 1 (eq. 3c)."""
        weights = np.zeros((len(self.expressions), len(self.active)))
        for row, expression in zip(weights, self.expressions, strict=True):
            row[[*expression.shapes]] = 1
        return weights


def pack(template: Template, options: Options | None = None) -> Packing:
    """Return the expressions to make so that every shape of a template is seen by itself.

    Args:
        template: the face model's shapes.
        options: how; the paper's recommendations without it.

    Raises:
        InvalidInputError: the template contradicts itself, or an option is out of its range.
    """
    chosen = options or Options()
    chosen.check()
    check_template(template)
    lengths = displacements(template.offsets)
    reach = reaches(lengths, template.visible)
    active = binary_shapes(reach, chosen.mu)
    mirrored = find_mirrored(template.offsets, reach, mirror_image(template.neutral))
    rules = _rules(template, chosen, active, mirrored)
    units = make_units(active, rules)
    importance = _importance(template, chosen, lengths, active)
    made, minimum = _ordered(units, importance, chosen)
    expressions, values = _valued(made, units, importance)
    return Packing(expressions[: chosen.most], len(made), minimum, values, reach, active, mirrored, rules)


def _rules(template: Template, options: Options, active: NDArray[np.bool_], mirrored: Mirrored) -> Rules:
    pairs = mirrored.pairs if options.symmetric else ()
    if not options.poseable:
        return Rules(pairs)
    rules = poseable(mirrored, template.offsets, active, template.neutral, template.gaze)
    others = tuple(pair for pair in pairs if not set(pair) & set(template.gaze))
    return Rules((*others, *rules.together), rules.apart, rules.holds)


def _importance(
    template: Template, options: Options, lengths: NDArray[np.floating], active: NDArray[np.bool_]
) -> Importance:
    count = len(template.offsets)
    target = template.neutral if template.target is None else template.target
    return Importance(
        strength=displacement_strength(lengths, active),
        distortion=triangle_distortion(active, template.triangles, template.neutral, target),
        similarity=similarities(template.offsets) if options.beta else np.zeros((count, count)),
        alpha=options.alpha,
        beta=options.beta,
    )


def _ordered(units: Units, importance: Importance, options: Options) -> tuple[list[tuple[int, ...]], int]:
    """Return the units of every expression, and the proven minimum of their number."""
    made = greedy(units, importance)
    # The units of a row need an expression each: where these are as many, nothing is left to prove.
    crowd = int(units.rows.sum(1).max(initial=1))
    minimum = len(made) if crowd == len(made) else fewest(units.rows)
    if options.order == "minimal" and minimum < len(made):
        made = minimal(units, importance, minimum)
    return made, minimum


def _valued(
    made: list[tuple[int, ...]], units: Units, importance: Importance
) -> tuple[tuple[Expression, ...], NDArray[np.float64]]:
    """Return the expressions, and the (K,) importance that each shape had when its turn came."""
    values, shown, found = np.zeros(len(importance.strength)), list[int](), []
    left = set(range(len(values)))
    for chosen in made:
        adds = units.shapes(chosen)
        values[adds] = importance.of(sorted(left), shown)[adds]
        held = units.shapes(sorted({other for unit in chosen for other in units.holds[unit]}))
        found.append(Expression(tuple(units.members[u] for u in chosen), tuple(held), float(values[adds].sum())))
        left -= set(adds)
        shown += adds
    return tuple(found), values
