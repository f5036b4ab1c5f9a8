"""When a search has settled."""

import numpy as np
import pytest

from emogen_core.analysis.settling import NEVER, distances_to_last, median_settling, settled_at, share_settled

NAN = np.nan


def test_distances_leave_the_finished_face_out_and_mark_what_is_not_there():
    long = np.array([[1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
    short = np.array([[0.0, 1.0], [0.0, 2.0]])
    found = distances_to_last([long, short, long[:1]])
    assert found[0] == pytest.approx([1, 1 - np.sqrt(0.5)])
    assert found[1, 0] == pytest.approx(0)
    assert np.isnan(found[1, 1])
    assert np.isnan(found[2]).all()
    assert distances_to_last([]).shape == (0, 0)


@pytest.mark.parametrize(
    ("row", "at"),
    [
        ([0.1, 0.1, 0.1], 0),
        ([0.9, 0.1, 0.1], 1),
        ([0.1, 0.9, 0.1], 2),
        ([0.9, 0.9, 0.9], NEVER),
        ([0.1, 0.1, 0.21], NEVER),
        ([0.9, 0.2, NAN], 1),
        ([0.9, 0.9, NAN], NEVER),
        ([NAN, NAN, NAN], NEVER),
    ],
)
def test_settled_means_from_there_to_the_end(row, at):
    assert settled_at(np.array([row]), 0.2).tolist() == [at]


def test_a_lower_threshold_never_settles_earlier():
    distances = np.random.default_rng(5).random((200, 9))
    assert (settled_at(distances, 0.7) <= settled_at(distances, 0.4)).all()


def test_share_and_median_count_those_who_never_settled():
    generations = np.array([2.0, 4.0, NEVER, NEVER, 6.0])
    assert share_settled(generations) == pytest.approx(0.6)
    assert median_settling(generations) == 6
    assert median_settling(np.array([2.0, NEVER])) == NEVER
    assert median_settling(np.array([])) is None
    assert share_settled(np.array([])) is None
