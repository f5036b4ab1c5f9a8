"""Hair begins softly: skin along its edge and under it is in its shadow."""

import numpy as np
import pytest

from emogen_core.face.appearance import Appearance
from emogen_core.rendering.composer.hair import _shade_roots

INSIDE = np.array([-0.3, -0.12, -0.04, 0.05, 0.3], np.float32)


def shaded(**changes):
    colour = np.full((len(INSIDE), 3), 0.8, np.float32)
    _shade_roots(colour, INSIDE, Appearance(**changes))
    return colour.mean(1)


def test_skin_darkens_towards_the_hair_and_not_far_from_it():
    found = shaded(hair_length=1.0)
    assert found[0] == pytest.approx(0.8)
    assert (np.diff(found) < 0).all()


def test_shaven_and_bald_heads_have_no_such_shadow():
    assert shaded(hair_length=0.0) == pytest.approx(0.8)
    assert (shaded(balding=1.0) >= shaded(balding=0.0)).all()
