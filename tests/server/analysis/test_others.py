"""Distances to the mean of the others beside simulated groups of the same size."""

from dataclasses import replace

import numpy as np
import pytest
from scipy import stats

from emogen_core.similarity.cosine import cosine_distance
from server.analysis.others import SIZES, converging, proxies
from server.analysis.simulated import MOST, extents
from tests.conftest import small_study
from tests.server.analysis.made import GENERATIONS, context, crowd, made, rows, template

MIND = template(1)


def test_the_distance_is_to_the_mean_of_the_others():
    faces = made(MIND, 6)
    (row,) = rows(proxies(context(faces)))
    others = [np.delete(faces.weights, at, 0).mean(0) for at in range(6)]
    mean = np.mean([float(cosine_distance(one, other)) for one, other in zip(faces.weights, others, strict=True)])
    assert row["mean"] == pytest.approx(mean, abs=1e-9)
    assert row["mean low"] < mean < row["mean high"]


@pytest.mark.parametrize(("people", "simulated"), [(5, 5), (17, 17), (MOST + 20, MOST)])
def test_simulated_groups_are_as_large_as_the_cell(people, simulated):
    told = context(made(MIND, people), made(MIND, 9, emotion="angry"))
    row = rows(proxies(told))[0]
    own = crowd(simulated)
    assert row["simulated"] == own.faithful[-1].mean
    assert row["simulated with noise"] == own.noisy[-1].mean
    assert row["95th percentile"] == own.faithful[-1].most


def test_of_searches_that_learn_it_is_said_how_many_groups_there_are_and_how_large():
    told = context(made(MIND, 5), made(MIND, 6, emotion="sad"), searches=["one", "two"])
    assert proxies(told).notes == converging(told).notes == (SIZES,)
    learning = small_study(generations=10, search={"strategy": "preference", "activation": (2, 3)})
    for configs, end in (({"one": learning}, ""), ({"one": learning, "two": learning}, " Searches that learn share")):
        recording = replace(told.recording, configs={**told.recording.configs, **configs})
        extent, most = extents(recording.configs)["one"]
        _, note = proxies(replace(told, recording=recording)).notes
        assert f"there are {extent.minds} groups of a size, of at most {most} people.{end}" in note
        assert ("share the time" in note) == bool(end)


def test_who_is_far_from_all_others_is_beyond_both_or_only_beyond_people_who_never_err():
    minds = np.tile(MIND, (8, 1))
    minds[3] = np.where(MIND > 0, 0, 0.8)
    faces = made(minds, 8, spread=0.02)
    (row,) = rows(proxies(context(faces)))
    assert (row["beyond"], row["beyond with noise"], row["share"]) == (1, 1, 1 / 8)
    assert row["share low"] < 1 / 8 < row["share high"]
    far = float(cosine_distance(faces.weights[3], np.delete(faces.weights, 3, 0).mean(0)))
    level = 0.05 + far - 0.05 - row["95th percentile"]  # the percentile is .05 below it, with noise .05 above
    (row,) = rows(proxies(context(faces, levels={"a search": level})))
    assert (row["beyond"], row["beyond with noise"]) == (1, 0)


def test_p_is_adjusted_over_the_cells():
    minds = np.tile(MIND, (8, 1))
    minds[:3] = [template(seed) for seed in (11, 12, 13)]
    told = context(made(minds, 8, spread=0.02), made(MIND, 8, emotion="angry"), made(MIND, 3, emotion="sad"))
    found = rows(proxies(told))
    p = [row["p"] for row in found[:2]]
    assert p[0] < 0.05 < p[1]
    assert [row["q"] for row in found] == [*stats.false_discovery_control(p, method="bh"), None]


def test_the_last_generation_is_as_far_as_the_finished_faces_and_the_first_is_further():
    told = context(made(MIND, 6), made(MIND, 7, emotion="angry", seed=2))
    found = rows(converging(told))
    for row, emotion in zip(rows(proxies(told)), ("happy", "angry"), strict=True):
        course = [one for one in found if one["emotion"] == emotion]
        assert [one["generation"] for one in course] == list(range(GENERATIONS + 1))
        assert course[-1]["mean"] == pytest.approx(row["mean"], abs=1e-9)
        assert (course[-1]["simulated"], course[-1]["simulated with noise"]) == (
            row["simulated"], row["simulated with noise"],
        )  # fmt: skip
        assert course[0]["mean"] > course[-1]["mean"]
        assert [one["simulated"] for one in course] == [one.mean for one in crowd(row["people"]).faithful]


def test_with_too_few_people_nothing_is_told_and_that_is_said():
    told = context(made(MIND, 4))
    for section, what in ((proxies(told), "distance to the mean of the others"), (converging(told), "convergence")):
        assert len(section.lacks) == 1 and "needs at least 5 people, got 4" in section.lacks[0]
        assert section.figures == ()
        assert section.methods == (f"No {what} is told for any of 1 cell: too few people.",)
    (row,) = rows(proxies(told))
    assert {value for name, value in row.items() if name not in {"emotion", "head", "people"}} == {None}


def test_the_courses_of_people_and_of_both_simulations_are_drawn_over_the_interval():
    (figure,) = converging(context(made(MIND, 6))).figures
    assert [name for name, _ in figure.legend] == ["people", "95 % interval", "simulated", "simulated with noise"]
    drawn = str(figure.panels[0].svg)
    places = [drawn.index(f'class="{look}"') for look in ("band", "line s2", "line s3", "line s1")]
    assert places == sorted(places)
