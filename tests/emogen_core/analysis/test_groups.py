"""Who is compared with whom."""

import numpy as np
import pytest

from emogen_core.analysis.groups import dispersions, grouped, intensities, ratings
from emogen_core.analysis.recorded import Faces
from emogen_core.designs.population import names
from emogen_core.errors import InvalidInputError
from tests.emogen_core.analysis.studies import drawn


def test_strangers_are_compared_between_people():
    found = grouped([np.arange(3.0), np.arange(4.0)], [names(3), names(4, "q")])
    assert (found.design, found.sizes, found.left_out) == ("between", (3, 4), 0)
    assert found.of(1).tolist() == [0, 1, 2, 3]


def test_the_same_people_are_compared_with_themselves_whatever_their_order():
    found = grouped([np.array([1.0, 2, 3]), np.array([30.0, 10, 20])], [np.array(list("abc")), np.array(list("cab"))])
    assert found.design == "within"
    assert found.of(0).tolist() == [1, 2, 3]
    assert found.of(1).tolist() == [10, 20, 30]


def test_of_a_mixed_design_only_those_in_all_groups_count():
    found = grouped([np.arange(4.0), np.arange(3.0)], [np.array(list("abcd")), np.array(list("cde"))])
    assert (found.design, found.sizes, found.left_out) == ("within", (2, 2), 3)
    assert found.of(0).tolist() == [2, 3]


def test_of_three_groups_of_which_two_share_people_nobody_is_in_all():
    found = grouped(
        [np.arange(2.0), np.arange(2.0), np.arange(1.0)], [np.array(list(one)) for one in ("ab", "bc", "d")]
    )
    assert (found.design, found.sizes, found.left_out) == ("within", (0, 0, 0), 4)


def test_several_faces_count_by_their_mean():
    found = grouped([np.array([[1.0], [3.0]]), np.array([[5.0]])], [np.array(["a", "a"]), np.array(["b"])])
    assert found.of(0).tolist() == [[2]]


def test_one_group_is_no_comparison():
    with pytest.raises(InvalidInputError, match="at least two"):
        grouped([np.arange(3.0)], [names(3)])


def test_who_did_not_answer_is_left_out():
    weights = np.ones((4, 2))
    base = drawn(weights)
    told = Faces(
        base.people, base.emotions, base.identities, base.conditions, base.repetitions, weights, weights,
        {"intensity": np.array([1, np.nan, 3, 4])},
    )  # fmt: skip
    found = ratings([told.take(np.arange(2)), told.take(np.arange(2, 4))], "intensity")
    assert [found.of(i).tolist() for i in (0, 1)] == [[1], [3, 4]]
    assert ratings([told, base], "intensity").sizes == (3, 0)


def test_intensity_is_the_length_and_dispersion_the_distance_from_the_own_mean():
    first, second = drawn([[3.0, 4.0], [0, 1.0]]), drawn([[1.0, 0], [1.0, 0]], names(2, "q"))
    assert intensities([first, second]).values.tolist() == [5, 1, 1, 1]
    found = dispersions([first, second])
    middle = np.array([1.5, 2.5]) / np.hypot(1.5, 2.5)
    assert found.of(0) == pytest.approx([2 * (1 - middle @ [0.6, 0.8]), 2 * (1 - middle[1])])
    assert found.of(1) == pytest.approx([0, 0], abs=1e-12)
