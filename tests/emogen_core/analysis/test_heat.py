"""Where two faces differ."""

import numpy as np
import pytest

from emogen_core.analysis.heat import vertex_difference
from emogen_core.errors import InvalidInputError
from emogen_core.similarity.linear import vertex_rms
from tests.emogen_core.simulation.evaluation.laboratories import SMALL

FIRST, SECOND = np.random.default_rng(1).random((2, len(SMALL.shape_names)))


def test_it_is_the_distance_of_every_vertex():
    found = vertex_difference(SMALL, "female", FIRST, SECOND)
    rms = vertex_rms(SMALL.shape_offsets("female"))
    assert np.sqrt((found**2).mean()) == pytest.approx(float(rms(FIRST, SECOND)), rel=1e-4)
    assert (vertex_difference(SMALL, "female", FIRST, FIRST) == 0).all()
    assert np.allclose(found, vertex_difference(SMALL, "female", SECOND, FIRST))


def test_what_is_no_face_is_refused():
    with pytest.raises(InvalidInputError, match="weights: expected"):
        vertex_difference(SMALL, "female", FIRST, SECOND * 3 + 1)
