import numpy as np

from emogen_core.transfer.samples import bells, spread_samples
from tests.emogen_core.transfer.heads import head, mirror


def test_samples_are_symmetric_and_spread():
    found = spread_samples(head().neutral, 60)
    assert set(mirror()[found]) == set(found)
    assert 60 <= len(found) <= 61
    points = head().neutral[found]
    apart = np.linalg.norm(points[:, None] - points, axis=2) + 1e9 * np.eye(len(points))
    away = np.linalg.norm(head().neutral[:, None] - points, axis=2).min(1)
    assert away.max() < 2 * apart.min()


def test_no_vertex_is_taken_twice():
    doubled = np.repeat(head().neutral[:7], 3, 0)
    assert len(spread_samples(doubled, 50)) <= 7
    assert len(np.unique(spread_samples(head().neutral, 10_000))) == 625


def test_samples_do_not_depend_on_where_a_head_lies_or_how_large_it_is():
    found = spread_samples(2 * head().neutral + [0, 64, -32], 60)
    assert np.array_equal(found, spread_samples(head().neutral, 60))


def test_bells_share_every_vertex_even_far_ones():
    far = np.r_[head().neutral, [[1e4, 0, 0]]]
    shares = bells(far, np.arange(0, 625, 20))
    assert np.allclose(shares.sum(1), 1)
    assert (shares >= 0).all()
    assert shares[40].argmax() == 2


def test_bells_fall_off_evenly():
    points = np.array([[0.0, 0, 0], [2, 0, 0], [1, 0, 0], [0.5, 0, 0]])
    shares = bells(points, np.array([0, 1]))
    assert np.allclose(shares[2], 0.5)
    assert np.allclose(np.log(shares[3, 0] / shares[3, 1]), (1.5**2 - 0.5**2) / 2)
