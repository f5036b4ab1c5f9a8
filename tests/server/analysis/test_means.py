"""Mean faces and what they are made of."""

import numpy as np
import pytest

from emogen_core.analysis.cells import lengths
from server.analysis.means import means
from tests.server.analysis.made import RIG, context, corrected, made, rows, template

MIND = template(1)


def test_the_mean_face_is_the_corrected_mean_of_the_genes():
    faces = made(MIND, 6)
    section = means(context(faces))
    (row,) = rows(section, "mean-weights")
    genes = np.array([row[f"gene_{name}"] for name in RIG.gene_names])
    weights = np.array([row[f"weight_{name}"] for name in RIG.shape_names])
    assert genes == pytest.approx(faces.genes.mean(0))
    assert weights == pytest.approx(corrected("female", faces.genes.mean(0)))
    assert not np.allclose(weights, faces.weights.mean(0))


def test_intensity_is_the_mean_length_and_ratings_are_told():
    rated = np.arange(6, dtype=float)
    faces = made(MIND, 6, ratings={"intensity": rated})
    section = means(context(faces))
    (row,) = rows(section)
    assert row["intensity"] == pytest.approx(lengths(faces.weights).mean())
    assert row["rated"] == rated.mean()
    assert f"For happy, mean intensity was {row['intensity']:.2f} (n = 6, 95 % CI [" in section.methods[1]


def test_retests_are_in_the_list_of_faces_but_not_in_means():
    once, again = made(MIND, 6), made(0 * MIND, 6, seed=2, repetition=1)
    told = context(once, again)
    assert rows(means(told)) == rows(means(context(once)))
    assert [row["repetition"] for row in rows(means(told), "faces")] == [0] * 6 + [1] * 6
    assert [row["face"] for row in rows(means(told), "faces")] == list(told.recording.face_ids)


def test_too_few_people_have_a_mean_but_no_interval():
    section = means(context(made(MIND, 4)))
    (row,) = rows(section)
    assert row["intensity"] is not None
    assert (row["intensity low"], row["intensity high"], row["spread"], row["rated"]) == (None,) * 4
    assert section.methods[1:] == ("No spread or interval of intensity is told for any of 1 cell: too few people.",)


def test_cells_whose_faces_are_all_the_same_are_named():
    section = means(context(made(MIND, 6, spread=0), made(MIND, 6, emotion="angry"), made(MIND, 1, emotion="sad")))
    (note,) = section.notes
    assert note.startswith("In 1 of 3 cells (happy) all faces are the same") and note in section.methods
    assert means(context(made(MIND, 6))).notes == ()
