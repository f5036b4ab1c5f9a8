import numpy as np
import pytest

from emogen_core.errors import InvalidInputError
from emogen_core.transfer.alignment import align
from tests.emogen_core.transfer.heads import REFLECTED, head, moved


def test_motion_and_size_are_undone():
    there, carried = moved(head().neutral, scale=0.01)
    found = align(head().neutral, there)
    assert found.scale == pytest.approx(0.01)
    assert np.allclose(found.onto_template(there), head().neutral)
    assert np.allclose(found.offsets_back(head().offsets), carried(head().offsets))


def test_a_reflected_head_is_turned_and_not_reflected():
    found = align(head().neutral, head().neutral * REFLECTED[[1, 0, 2]])
    assert np.linalg.det(found.rotation) == pytest.approx(1)
    tried = np.array([[1, 0, 0], [0, -1, 0], [0, 0, -1.0]])
    away = [((head().neutral @ turn - head().neutral * [1, -1, 1]) ** 2).sum() for turn in (found.rotation, tried)]
    assert away[0] <= away[1]


def test_no_similarity_lies_nearer():
    rng = np.random.default_rng(2)
    there = moved(head().neutral)[0] + rng.normal(size=head().neutral.shape)
    found = align(head().neutral, there)
    least = ((found.scale * head().neutral @ found.rotation + found.origin - there) ** 2).sum()
    for _ in range(20):
        twist = np.linalg.qr(np.eye(3) + 1e-3 * rng.normal(size=(3, 3)))[0]
        twist *= np.sign(np.diag(twist))
        shift = 1e-2 * rng.normal(size=3)
        other = found.scale * rng.normal(1, 1e-3) * head().neutral @ found.rotation @ twist + found.origin + shift
        assert ((other - there) ** 2).sum() > least


def test_the_way_there_and_back_is_the_same():
    rng = np.random.default_rng(5)
    there = moved(head().neutral)[0] + rng.normal(size=head().neutral.shape)
    found = align(head().neutral, there)
    assert np.allclose(found.rotation @ found.rotation.T, np.eye(3))
    shift = rng.normal(size=(7, 3))
    carried = found.onto_template(there[:7] + found.offsets_back(shift)) - found.onto_template(there[:7])
    assert np.allclose(carried, shift)
    assert np.allclose(found.onto_template(there).mean(0), head().neutral.mean(0))


def test_a_point_is_no_head():
    with pytest.raises(InvalidInputError, match="expected a head, got 'all vertices in one place'"):
        align(head().neutral, np.ones((625, 3)))
    with pytest.raises(InvalidInputError, match="expected a head"):
        align(np.ones((625, 3)), head().neutral)
