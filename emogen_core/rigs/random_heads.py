"""Random points of the space of heads, for sheets to show and for checks to judge."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from emogen_core.face.identity import Identity
from emogen_core.face.space import ADULT, ANCESTRIES

if TYPE_CHECKING:
    from emogen_core.face.space import IdentitySpace

# So many details stand off their middle, normally distributed with this deviation.
DETAILS, SPREAD = 20, 0.4
# Of the Dirichlet distribution of ancestry shares: most heads are mostly of one preset.
_MIXING = 0.6


def random_head(space: IdentitySpace, seed: int) -> Identity:
    """Return an adult head of any sex, age, weight and ancestry, with `DETAILS` random details."""
    rng = np.random.default_rng(seed)
    point = {"sex": rng.random(), "age": rng.uniform(ADULT, 90), "weight": rng.uniform(-1, 1)}
    point |= dict(zip(ANCESTRIES, rng.dirichlet([_MIXING] * 3).tolist(), strict=True))
    for name in rng.choice(space.details, DETAILS, replace=False):
        known = space.ranges[name]
        point[str(name)] = float(np.clip(rng.normal(0, SPREAD), known.low, known.high))
    return Identity(f"random {seed}", point)
