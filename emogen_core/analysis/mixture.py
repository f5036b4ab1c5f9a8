"""Are faces of one kind or of several? A mixture of Gaussians, its number of components by BIC.

Fitted on the first principal components of weights scaled to length 1. Full covariances in all weights would have more
numbers than there are faces; and weights as they are spread with intensity, which is no Gaussian: simulated results
for one face in mind had more than one component then.

BIC is -2 log L + q log n for q free numbers (Schwarz 1978); how much a difference means is said by Kass and
Raftery 1995 (doi:10.1080/01621459.1995.10476572): 2 to 6 positive, 6 to 10 strong, more than 10 very strong.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from threadpoolctl import threadpool_limits

from emogen_core.analysis.distances import unit
from emogen_core.analysis.enough import FACES, VARIETY, Result, too_few
from emogen_core.analysis.maps import face_map

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

COMPONENTS = 6
"""Greatest number of components that is tried."""
FACES_EACH = 20
"""Faces that a component needs: no mixture with fewer than twice as many, and one component for each so many."""
AXES = 2
STARTS = 10
"""How often each mixture is fitted from another start; the best fit counts."""
STRONG = 10.0
"""Difference of BIC from which on more than one component is told."""


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class Mixture(Result):
    """How many kinds of faces there are.

    Attributes:
        bics: of 1, 2, ... components; the smallest is best.
        components: the number with the smallest BIC; None with too few faces.
        advantage: how much smaller the best BIC is than that of one component.
        labels: (n,) the most likely component of each face, the largest component first; empty with too few.
        certainty: (n,) its probability.
        sizes: faces in each.
    """

    bics: tuple[float, ...] = ()
    components: int | None = None
    advantage: float | None = None
    labels: NDArray[np.intp]
    certainty: Floats
    sizes: tuple[int, ...] = ()

    @property
    def several(self) -> bool | None:
        """Whether there is very strong evidence of more than one component; None with too few faces."""
        return None if self.advantage is None else self.advantage > STRONG


def mixture(weights: NDArray[np.floating], seed: int, greatest: int = COMPONENTS, axes: int = AXES) -> Mixture:
    """Return the mixture of (n, K) faces, one a person, that BIC prefers.

    Args:
        weights: of the faces.
        seed: of the starts of the fit.
        greatest: number of components.
        axes: number of principal components that it is fitted on.
    """
    # It takes half a second to load, which every command that does not need it would pay.
    from sklearn.mixture import GaussianMixture  # noqa: PLC0415

    different = len(np.unique(np.asarray(weights), axis=0)) if len(weights) else 0
    lacks = too_few(len(weights), 2 * FACES_EACH, FACES) or too_few(different, 2 * FACES_EACH, VARIETY)
    if lacks:
        return Mixture(labels=np.zeros(0, np.intp), certainty=np.zeros(0), lacks=lacks)
    places = face_map(unit(weights), axes).places
    counts = range(1, min(greatest, len(places) // FACES_EACH) + 1)
    with threadpool_limits(1):  # the products are small: threads only get in each other's way
        fits = [GaussianMixture(count, n_init=STARTS, random_state=seed).fit(places) for count in counts]
    bics = [float(fit.bic(places)) for fit in fits]
    best = int(np.argmin(bics))
    chances = fits[best].predict_proba(places)
    # The largest first, so that names of components do not depend on the start.
    order = np.argsort(-np.bincount(chances.argmax(1), minlength=best + 1), kind="stable")
    chances = chances[:, order]
    labels = chances.argmax(1)
    return Mixture(
        bics=tuple(bics), components=best + 1, advantage=bics[0] - bics[best], labels=labels,
        certainty=chances.max(1), sizes=tuple(np.bincount(labels, minlength=best + 1).tolist()),
    )  # fmt: skip
