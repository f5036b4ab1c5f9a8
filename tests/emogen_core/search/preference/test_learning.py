"""The ten faces of a turn, whatever is believed: as many, all to be seen, unlike each other while they have to be."""

from __future__ import annotations

from itertools import combinations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from emogen_core.search import Choice
from emogen_core.search.preference import prior
from emogen_core.search.preference.learning import MOST_ALIKE, VARIED, Turn, faces_of, turn_of
from emogen_core.search.preference.proposals import GRID, LEAST_STRONGEST, VISIBLE
from emogen_core.search.preference.sample import Sample
from emogen_core.search.preference.utility import COSINE, VERTEX, Space

GENES, LAST = 46, 10


def wide() -> Space:
    """As many genes as a face has, some of them pairs, whose meshes overlap a little."""
    offsets = np.random.default_rng(5).normal(size=(GENES, 400))
    pairs = np.where(np.arange(GENES) % 3, 2.0, 1.0)
    return Space(np.stack([np.diag(pairs), offsets @ offsets.T * pairs.sum() / GENES / 400]))


@st.composite
def beliefs(draw: st.DrawFn) -> tuple[Sample, np.ndarray]:
    """Draws, wide or nearly all the same, strong or faint, of one metric or of both; and an elite."""
    rng = np.random.default_rng(draw(st.integers(0, 2**32)))
    sample = prior.drawn(rng.random((64, 3 + 2 * GENES)))
    genes = sample.genes
    genes[np.arange(64), rng.integers(GENES, size=64)] = rng.random(64)
    if draw(st.booleans()):
        genes = genes[:1] * (1 - 1e-3 * rng.random((64, 1)))
    genes = genes * draw(st.sampled_from([1.0, 0.1, 1e-3]))
    metric = draw(st.sampled_from([np.zeros(64), np.ones(64), np.arange(64) % 2])).astype(np.intp)
    elite = prior.drawn(rng.random((1, 3 + 2 * GENES))).genes[0] * draw(st.sampled_from([0.0, 0.05, 1.0]))
    return Sample(genes, sample.log_tau, metric), np.rint(elite * GRID) / GRID


@given(beliefs(), st.integers(1, LAST), st.booleans())
def test_ten_faces_that_can_all_be_seen(belief: tuple[Sample, np.ndarray], generation: int, best_only: bool) -> None:
    sample, elite = belief
    faces, origins = faces_of(wide(), sample, elite, Turn(generation, LAST, best_only), np.random.default_rng(1))
    assert faces.shape == (10, GENES)
    assert faces.max(axis=1).min() >= VISIBLE
    if elite.max() >= VISIBLE:
        assert origins[0] == "elite"
        assert np.array_equal(faces[0], elite)
    else:
        assert origins[0] == "posterior-mean"
    assert "elite" not in origins[1:]
    if (sample.metric == COSINE).mean() >= 0.5:
        assert faces[int(origins[0] == "elite") :].max(axis=1).min() >= LEAST_STRONGEST - 1 / GRID


@given(beliefs(), st.integers(1, VARIED - 1), st.booleans())
def test_early_faces_are_as_unlike_as_the_published_search_s(
    belief: tuple[Sample, np.ndarray], generation: int, best_only: bool
) -> None:
    space, (sample, elite) = wide(), belief
    faces, _ = faces_of(space, sample, elite, Turn(generation, LAST, best_only), np.random.default_rng(1))
    directions = faces * np.sqrt(space.multiplicities)
    directions /= np.linalg.norm(directions, axis=1, keepdims=True)
    alike = np.mean([one @ other for one, other in combinations(directions, 2)])
    leading = COSINE if (sample.metric == COSINE).mean() >= 0.5 else VERTEX
    assert alike <= MOST_ALIKE[leading][generation] + 1e-9


def test_only_the_best_is_told_as_long_as_every_choice_has_one_face() -> None:
    one, two = Choice((3,), 3), Choice((3, 5), 5)
    assert turn_of([one, one], LAST) == Turn(2, LAST, best_only=True)
    assert turn_of([one, two, one], LAST) == Turn(3, LAST, best_only=False)


@given(beliefs(), st.integers(1, LAST - 1))
def test_where_a_trial_ends_early_all_faces_are_near_what_is_meant_with_all_their_genes(
    belief: tuple[Sample, np.ndarray], generation: int
) -> None:
    (sample, elite), space = belief, wide()
    early, origins = faces_of(space, sample, elite, Turn(generation, LAST, sure=True), np.random.default_rng(1))
    full, those = faces_of(space, sample, elite, Turn(LAST, LAST), np.random.default_rng(1))
    assert np.array_equal(early, full), "as at the end of a full trial"
    assert origins == those
    assert set(origins) <= {"elite", "posterior-mean", "draws-mean"}
