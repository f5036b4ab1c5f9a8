"""Kinds of faces, maps and neighbours."""

import numpy as np
import pytest

from server.analysis.kinds import NEIGHBOURS, mixtures, neighbours, plane
from tests.server.analysis.made import context, made, rows, template

MIND, OTHER = template(1), template(2)


@pytest.fixture(scope="module")
def two_kinds():
    """Half of the people have another face in mind for happy; all have one for angry; few made sad."""
    minds = np.stack([MIND, OTHER] * 30)
    return context(
        made(minds, 60, spread=0.03), made(MIND, 60, spread=0.03, emotion="angry"),
        made(MIND, 10, emotion="sad", seed=3),
    )  # fmt: skip


def test_two_kinds_are_told_and_one_is_not_several(two_kinds):
    section = mixtures(two_kinds)
    happy, angry, sad = rows(section)
    assert (happy["components"], happy["several kinds"], happy["sizes"]) == (2, True, "30, 30")
    assert (angry["several kinds"], sad["components"], sad["several kinds"]) == (False, None, None)
    assert section.lacks == ("sad: a mixture needs at least 40 faces, got 10.",)
    told, untold = section.methods
    assert f"2 components for happy (n = 60, BIC lower by {happy['advantage']:.1f}" in told
    assert "very strong evidence)" in told.split("angry")[0] and "very strong evidence)" not in told.split("angry")[1]
    assert untold == "No mixture was fitted for sad (too few faces)."


def test_everybody_counts_once_in_a_mixture():
    heads = [made(MIND, 30, seed=seed, identity=head) for seed, head in enumerate(("female", "male"))]
    (row,) = rows(mixtures(context(*heads)))
    assert (row["faces"], row["components"]) == (30, None)


def test_the_map_has_every_face_and_its_axes_are_in_order(two_kinds):
    section = plane(two_kinds)
    assert [row["participation"] for row in rows(section, "map")] == two_kinds.faces.people.tolist()
    first, second = rows(section)
    assert first["share of the variance"] >= second["share of the variance"] > 0
    places = [(row["component 1"], row["emotion"], int(row["participation"][1:])) for row in rows(section, "map")]
    sides = [[x for x, emotion, at in places if emotion == "happy" and at % 2 == kind] for kind in (0, 1)]
    assert max(sides[0]) < min(sides[1]) or max(sides[1]) < min(sides[0])


def test_a_single_face_has_no_map():
    assert plane(context(made(MIND, 1))) is None


def test_neighbours_of_a_mean_face_are_the_nearest_first_and_name_their_face():
    happy, angry = made(MIND, 6, spread=0.02), made(OTHER, 6, seed=2, spread=0.02, emotion="angry")
    again = made(MIND, 6, seed=9, spread=0.0, repetition=1)
    told = context(again, happy, angry)
    found = [row for row in rows(neighbours(told)) if row["emotion"] == "happy"]
    assert [row["place"] for row in found] == list(range(1, NEIGHBOURS + 1))
    assert [row["cosine distance"] for row in found] == sorted(row["cosine distance"] for row in found)
    assert {row["made for"] for row in found} == {"happy"}
    first_faces = {f"f{at}" for at in range(6, 12)}  # those of the retest come before and are no neighbours
    assert {row["face"] for row in found} <= first_faces
