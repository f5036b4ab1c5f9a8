"""Whether people name faces by how much these are like their own."""

from dataclasses import replace
from itertools import permutations

import numpy as np
import pytest
from statsmodels.discrete.conditional_models import ConditionalLogit

from emogen_core.analysis.distances import cosine_matrix
from emogen_core.analysis.matching import Judgements, match
from emogen_core.analysis.recorded import Faces, joined
from emogen_core.designs.population import names
from emogen_core.errors import InvalidInputError
from tests.emogen_core.analysis.studies import drawn, judgements

FACES = np.random.default_rng(1).random((200, 6))


def rng(seed=1):
    return np.random.default_rng(seed)


def by_hand(people=5, each=7):
    """Return judgements of one emotion at random, and own faces."""
    named = rng(2).random(people * each) < 0.5
    judged = Judgements(np.repeat(names(people), each), np.full(people * each, "happy"), FACES[: people * each], named)
    return judged, drawn(FACES[100 : 100 + people], names(people))


def test_all_ways_to_exchange_own_faces_are_made():
    judged, own = by_hand()
    found = match(judged, own, rng())
    answers = judged.named.reshape(5, 7) - judged.named.reshape(5, 7).mean(1, keepdims=True)
    alike = (1 - cosine_matrix(own.weights, judged.weights)).reshape(5, 5, 7)
    score = np.array([sum(answers[i] @ alike[to[i], i] for i in range(5)) for to in permutations(range(5))])
    more, less = (score >= score[0] - 1e-9).mean(), (score <= score[0] + 1e-9).mean()
    assert (found.exact, found.permutations) == (True, 120)
    assert found.p == pytest.approx(min(1, 2 * min(more, less)))


def test_the_same_answers_twice_are_no_more_certain():
    judged, own = judgements(rng(7), people=20, own=4.0)
    twice = Judgements(
        *(np.concatenate([one, one]) for one in (judged.people, judged.emotions, judged.weights, judged.named))
    )
    once, again = (match(one, own, rng(), resamples=99).own for one in (judged, twice))
    assert (again.value, again.low, again.high) == pytest.approx((once.value, once.low, once.high), rel=1e-6)


@pytest.mark.filterwarnings("ignore:Dropped")
def test_the_odds_ratio_agrees_with_a_conditional_regression():
    judged, own = judgements(rng(3), people=40, own=8.0)
    found = match(judged, own, rng(), resamples=99)
    of = {emotion: own.only(emotion) for emotion in ("happy", "angry")}
    alike = np.array([
        1 - cosine_matrix(of[emotion].weights, face[None])[:, 0]
        for emotion, face in zip(judged.emotions, judged.weights, strict=True)
    ])  # fmt: skip
    person = np.searchsorted(names(40), judged.people)
    mine = alike[np.arange(len(alike)), person]
    others = (alike.sum(1) - mine) / 39
    strata = np.char.add(judged.people, judged.emotions)
    told = ConditionalLogit(judged.named.astype(float), np.stack([mine, others], 1), groups=strata).fit(disp=0)
    assert np.log(found.own.value) / 0.1 == pytest.approx(told.params[0], rel=0.3)
    assert found.own.low > 1
    assert found.typical.low < 1 < found.typical.high


def test_the_face_that_somebody_made_is_left_out_when_they_are_shown_it():
    with_own, own = judgements(rng(4), people=12, show_own=True)
    found = match(with_own, own, rng(), resamples=99)
    assert (found.shown_own, found.judgements) == (24, 12 * 16)


def test_people_without_a_face_of_their_own_are_left_out():
    judged, own = judgements(rng(5), people=12)
    fewer = own.take(~((own.people == names(12)[3]) & (own.emotions == "angry")))
    found = match(judged, fewer, rng(), resamples=99)
    assert (found.left_out, found.people, found.judgements) == (1, 11, 11 * 16)
    alone = judged.take(judged.people != names(12)[3])
    told = match(alone, own.take(own.people != names(12)[3]), rng(), resamples=99)
    assert found == replace(told, left_out=1)


def test_several_own_faces_count_by_their_mean():
    judged, own = by_hand()
    doubled = joined(own, drawn(own.weights * 0.5, own.people))
    assert match(judged, doubled, rng()).p == pytest.approx(
        match(judged, drawn(own.weights * 0.75, own.people), rng()).p
    )


def test_what_cannot_be_said():
    judged, own = by_hand()
    few = match(judged.take(np.isin(judged.people, names(4))), own, rng())
    assert (few.p, few.lacks.what, few.own) == (None, "people", None)
    enough = match(judged, own, rng())
    assert (enough.enough, enough.own, enough.odds_lack.what) == (True, None, "people")
    always = Judgements(judged.people, judged.emotions, judged.weights, np.ones(35, bool))
    assert match(always, own, rng()).lacks.what == "judgements of the rarer answer"
    rare = by_hand(people=12)
    seldom = Judgements(rare[0].people, rare[0].emotions, rare[0].weights, np.arange(84) < 5)
    assert match(seldom, rare[1], rng(), 99).odds_lack.what == "judgements of the rarer answer"
    nobody = match(judged, own.take(np.zeros(5, bool)), rng())
    assert (nobody.people, nobody.left_out, nobody.enough) == (0, 5, False)
    with pytest.raises(InvalidInputError, match="judgements: expected"):
        Judgements(judged.people[:3], judged.emotions, judged.weights, judged.named)


def test_answers_that_are_foretold_without_error_have_no_odds_ratio():
    judged, own = judgements(rng(6), people=12)
    mine = np.array([
        1 - cosine_matrix(own.only(emotion).take(own.only(emotion).people == who).weights, face[None])[0, 0]
        for who, emotion, face in zip(judged.people, judged.emotions, judged.weights, strict=True)
    ])  # fmt: skip
    strata = np.char.add(judged.people, judged.emotions)
    middle = {one: mine[strata == one].mean() for one in np.unique(strata)}
    foretold = Judgements(judged.people, judged.emotions, judged.weights, mine > [middle[one] for one in strata])
    found = match(foretold, own, rng(), resamples=99)
    assert found.p <= 0.05
    assert (found.own, found.odds_lack.what) == (None, "estimates that are finite")


def test_who_always_answers_the_same_about_an_emotion_tells_nothing():
    rng = np.random.default_rng(4)
    people = np.repeat([f"p{i}" for i in range(6)], 2)
    emotions = np.tile(["happy", "sad"], 6)
    own = Faces(people, emotions, ["h"] * 12, ["c"] * 12, [0] * 12, rng.random((12, 3)), rng.random((12, 5)))
    asked = np.repeat(emotions, 3)
    told = match(Judgements(np.repeat(people, 3), asked, rng.random((36, 5)), asked == "happy"), own, rng)
    assert (told.p, told.own) == (None, None)
    assert "answered differently" in str(told.lacks)
