"""What a table says."""

import numpy as np
import pytest

from emogen_core.simulation.evaluation.table import Cluster, Column, Finding, Row, Table


def table(*holds, why="", doubt=""):
    findings = tuple(Finding("It falls.", "It does.", one) for one in holds)
    return Table("noise", "Noise", "Table V", (Column("mean"), Column("n", 0)), (), findings, why, doubt)


@pytest.mark.parametrize(
    ("holds", "agreement"),
    [
        ((), "new"),
        ((True,), "agrees"),
        ((True, True, True), "agrees"),
        ((True, False), "agrees in trend"),
        ((True, False, False), "does not agree"),
        ((False,), "does not agree"),
    ],
)
def test_agreement_follows_from_the_findings(holds, agreement):
    assert table(*holds).agreement == agreement


def test_the_verdict_is_one_sentence_with_its_reason():
    assert table(True, False, why="we drew it").verdict == (
        "Agrees in trend: 1 of the 2 findings of the paper hold here; we drew it."
    )
    assert table(False).verdict == "Does not agree: the paper's finding does not hold here."
    assert table(True, True, True).verdict == "Agrees: all findings of the paper hold here."
    assert table(True, True).verdict == "Agrees: both findings of the paper hold here."
    assert table(True, doubt="we drew it").verdict == "Agrees: the paper's finding holds here."
    assert table(False, why="but it rains", doubt="we drew it").verdict == (
        "Does not agree: the paper's finding does not hold here; we drew it; but it rains."
    )
    assert table(why="A search ends near.").verdict == "A search ends near."


def test_numbers_are_shown_with_the_digits_of_their_column():
    assert table().shown((0.12345, 1234.4)) == ("0.123", "1,234")
    assert table().shown((None, 2)) == ("–", "2")
    assert Row("a", (1.0,)).paper == ()


def test_the_outline_of_a_cluster_is_where_its_distance_is_the_same():
    covariance = np.array([[4.0, 1.0], [1.0, 2.0]])
    outline = Cluster(np.zeros((1, 2)), np.array([1.0, -1.0]), covariance).outline(3.0)
    away = outline - (1.0, -1.0)
    mahalanobis = np.sqrt(np.einsum("ni,ij,nj->n", away, np.linalg.inv(covariance), away))
    np.testing.assert_allclose(mahalanobis, 3.0)
    np.testing.assert_allclose(outline[0], outline[-1])
