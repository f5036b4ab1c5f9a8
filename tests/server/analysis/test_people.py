"""What people name beside what they made, and how they search."""

from dataclasses import replace

import numpy as np
import pytest

from emogen_core.analysis.matching import Judgements
from server.analysis.people import MEASURES, naming, searching
from tests.server.analysis.made import GENERATIONS, SHAPES, context, made, rows, template

MINDS = np.stack([template(seed) for seed in range(24)])
STIMULI = 12


def judged(faces, knows, seed=5):
    """Everybody judges the same stimuli, and names the half so that is nearest to their own face, or any."""
    rng = np.random.default_rng(seed)
    stimuli = np.clip(made(MINDS[:STIMULI], STIMULI).weights + 0.1 * rng.normal(size=(STIMULI, SHAPES)), 0, 1)
    unit = [one / np.linalg.norm(one, axis=1, keepdims=True) for one in (faces.weights, stimuli)]
    alike = unit[0] @ unit[1].T
    said = rng.random(alike.shape) if not knows else alike + 0.05 * rng.normal(size=alike.shape)
    named = said > np.median(said, axis=1, keepdims=True)
    people = np.repeat(faces.people, STIMULI)
    return Judgements(people, np.array(["happy"] * len(people)), np.tile(stimuli, (len(faces), 1)), named.ravel())


def test_people_who_go_by_their_own_face_are_found_to_do_so():
    faces = made(MINDS, 24, spread=0.02)
    section = naming(context(faces, judgements=judged(faces, knows=True)))
    (row,) = rows(section)
    assert row["p"] < 0.01 and row["odds ratio"] > row["low"] > 1
    assert (
        f"predicted naming (24 participants, {24 * STIMULI} judgements, p < .001; OR = {row['odds ratio']:.2f}"
        in (section.methods[1])
    )


def test_people_who_answer_at_random_are_not():
    faces = made(MINDS, 24, spread=0.02)
    section = naming(context(faces, judgements=judged(faces, knows=False)))
    (row,) = rows(section)
    assert row["p"] > 0.05 and row["low"] < 1 < row["high"]
    assert "did not significantly predict" in section.methods[1]


def test_every_condition_has_the_judgements_of_its_own_people():
    parts = [made(MINDS[:12], 12, seed=at, name=name, condition=name) for at, name in enumerate("ab")]
    both = [judged(one, knows=True) for one in parts]
    both[1].emotions[:STIMULI] = "angry"  # nobody made an angry face: whoever was asked cannot count
    together = Judgements(*(np.concatenate([getattr(one, name) for one in both])
                            for name in ("people", "emotions", "weights", "named")))  # fmt: skip
    found = rows(naming(context(*parts, judgements=together)))
    assert [(row["condition"], row["people"]) for row in found] == [("a", 12), ("b", 0)]


def test_with_too_few_people_no_match_is_told():
    faces = made(MINDS[:4], 4)
    section = naming(context(faces, judgements=judged(faces, knows=True)))
    (row,) = rows(section)
    assert (row["p"], row["odds ratio"], row["typical"]) == (None, None, None)
    assert "needs at least 5 people, got 4" in section.lacks[0]
    assert section.methods[1].startswith("Likeness to the own face could not be tested: a match needs at least 5")


def test_without_judgements_there_is_no_such_part():
    assert naming(context(made(MINDS, 24))) is None


def test_measures_of_a_way_in_equal_steps():
    section = searching(context(made(MINDS, 24)))
    found = {row["measure"]: row for row in rows(section)}
    assert set(found) == {name.replace("_", " ") for name in MEASURES}
    assert found["stability"]["mean"] == 0
    assert found["path"]["mean"] == pytest.approx(GENERATIONS * found["speed"]["mean"])
    still = {name for name, row in found.items() if row["low"] is None}
    assert still == {"stability", "peak generation"}, "of a measure that is the same for everybody there is no interval"
    assert all(row["low"] < row["mean"] < row["high"] for name, row in found.items() if name not in still)
    assert all(f"{name} " in section.methods[0] for name in found), "but its mean is told"
    each = rows(section, "process-trials")
    assert np.mean([row["speed"] for row in each]) == pytest.approx(found["speed"]["mean"])
    assert f"speed {found['speed']['mean']:.2f}" in section.methods[0]


def test_with_too_few_people_no_measure_is_in_the_text():
    section = searching(context(made(MINDS[:4], 4)))
    assert section.methods == ("No mean of a measure of search is told: too few people.",)
    assert section.lacks == ("happy: an interval needs at least 5 people, got 4.",)


def test_a_trial_whose_way_is_not_known_has_no_measures():
    faces = made(MINDS[:6], 6)
    unknown = type(faces)(
        faces.people, faces.emotions, faces.identities, faces.conditions, faces.repetitions, faces.genes, faces.weights
    )
    section = searching(context(unknown))
    assert {row["mean"] for row in rows(section)} == {None}
    assert section.methods == ("No mean of a measure of search is told: too few people.",)
    assert {row["speed"] for row in rows(section, "process-trials")} == {None}


def test_how_people_search_and_what_they_recognise_is_of_the_faces_they_chose():
    chosen = made(MINDS, 24, spread=0.02)
    guesses = np.flip(chosen.weights, 1)
    ways = tuple(np.vstack([way, guess]) for way, guess in zip(chosen.elites, guesses, strict=True))
    one = context(chosen, judgements=judged(chosen, knows=True))
    faces = replace(chosen, weights=guesses, elites=ways)
    other = replace(one, recording=replace(one.recording, faces=faces, result="estimate"))
    for section in (searching, naming):
        assert rows(section(one)) == rows(section(other))
    assert "last chosen as best" in naming(other).says
