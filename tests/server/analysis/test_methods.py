"""The text for a paper: numbers, what cannot be said, and exactly the works that it cites."""

import json
import math
import re
from dataclasses import replace

import numpy as np
import pytest

from server.analysis.files import comma_separated, plain
from server.analysis.methods import REFERENCES, methods
from server.analysis.sections import sections
from tests.conftest import small_study
from tests.server.analysis.made import FACTS, context, made, template
from tests.server.analysis.test_people import MINDS, judged

CITED = re.compile(r"\(([A-Z][^()]*?, \d{4})[;)]")


def whole(people):
    """Two emotions on two heads in two conditions, made twice, rated and named."""
    parts = []
    for condition in ("alone", "together"):
        for at, emotion in enumerate(("happy", "angry")):
            for head in ("female", "male"):
                for repetition in (0, 1):
                    parts.append(
                        made(
                            template(at), people, seed=len(parts), name=condition, emotion=emotion, identity=head,
                            condition=condition, repetition=repetition,
                            ratings={"intensity": np.arange(people, dtype=float) % 7},
                        )
                    )  # fmt: skip
    return context(*parts, judgements=judged(made(MINDS[:people], people, name="alone"), knows=True))


@pytest.fixture(scope="module", params=[2, 12])
def analysis(request):
    told = whole(request.param)
    return told, sections(told)


def test_every_part_is_there_and_says_something_for_a_paper(analysis):
    _, parts = analysis
    assert [part.name for part in parts] == [
        "means", "within", "proxy", "convergence", "between", "conditions", "genes", "differences", "map", "kinds",
        "nearest", "retest", "match", "heads", "process",
    ]  # fmt: skip
    silent = {part.name for part in parts if not part.methods}
    assert silent <= {"map", "nearest", "differences"}


def test_no_gap_is_written_as_a_number_or_a_name(analysis):
    told, parts = analysis
    text = "\n".join(methods(told, parts, FACTS))
    tables = "\n".join(comma_separated(sheet) for part in parts for sheet in (part.sheet, *part.files))
    words = [text, tables, *(one for part in parts for one in (*part.lacks, *part.notes, part.says))]
    assert not [one for one in words if re.search(r"\b(None|nan|inf|NaN)\b", one)]
    json.dumps(plain(parts, FACTS), allow_nan=False)
    numbers = [value for part in parts for row in part.sheet.rows for value in row if isinstance(value, float)]
    assert all(map(math.isfinite, numbers))


def test_what_cites_is_in_the_list_and_the_list_has_nothing_else(analysis):
    told, parts = analysis
    text = methods(told, parts, FACTS)
    works = [one for one in text if one in REFERENCES.values()]
    cited = {words for one in text if one not in works for words in REFERENCES if words in one}
    assert {REFERENCES[words] for words in cited} == set(works)
    assert text[-len(works) :] == works == sorted(works)
    plain_text = " ".join(one for one in text if one not in works)
    named = {word.split("; ")[-1] for word in CITED.findall(plain_text)}
    assert named <= set(REFERENCES), named - set(REFERENCES)


def test_a_report_without_conditions_does_not_cite_their_tests():
    told = context(made(template(1), 6))
    works = " ".join(one for one in methods(told, sections(told), FACTS) if one in REFERENCES.values())
    assert "EmoGen" in works
    for author in ("Anderson", "Benjamini", "Phipson", "Finn", "Mancl", "Kass"):
        assert author not in works


def test_with_two_people_a_cell_no_test_is_reported():
    told = whole(2)
    text = " ".join(methods(told, sections(told), FACTS)[:-9])
    assert not re.search(r"\b[pq] [=<]", text)
    assert "could be made: too few people." in text


def test_the_filters_of_the_export_are_part_of_the_first_sentence():
    told = context(made(template(1), 6))
    whole, part = FACTS, replace(FACTS, restricted="the condition “alone”", unchecked=True)
    (first, *_), (restricted, *_) = (methods(told, sections(told), facts) for facts in (whole, part))
    assert "completed the study “A study” made 6 faces for 1 emotion (happy) on 1 head (female)" in first
    assert "“A study”, in an export restricted to the condition “alone”, made 6 faces" in restricted
    assert "failed one" in restricted and "failed one" not in first


def test_a_head_of_the_study_is_named_with_its_place_in_the_tables():
    told = context(made(template(1), 6))
    text = " ".join(methods(told, sections(told), replace(FACTS, heads={"custom-1": "Somebody"})))
    assert "In the tables the head Somebody is custom-1, by the SHA-256 of its identity document." in text


def test_only_retests_are_no_faces_of_no_emotions():
    told = context(made(template(1), 6, repetition=1))
    first = methods(told, sections(told), FACTS)[0]
    assert first.startswith("0 of all who completed the study “A study” made 0 faces, and 6 faces once more as a")


def test_of_several_searches_it_is_said_which_condition_had_which():
    parts = [made(template(1), 5, name=name, condition=name) for name in ("alone", "together")]
    one, two = context(*parts), context(*parts, searches=["a", "b"])
    assert "With 3 generations" in methods(one, sections(one), FACTS)[1]
    text = methods(two, sections(two), FACTS)[1]
    assert "In the condition alone, with 3" in text and "In the condition together, with 3" in text


def test_a_search_that_is_not_the_paper_s_says_so_and_cites_its_own():
    told = context(made(template(1), 6))
    both = replace(FACTS, algorithms=("emogen/1", "preference/1"))
    text, before = (" ".join(methods(told, [], facts)) for facts in (both, FACTS))
    assert "search emogen/1, preference/1" in text
    assert "The search preference/1 makes the next faces not by the genetic algorithm" in text
    assert REFERENCES["Brochu et al., 2007"] in text
    assert "Brochu" not in before


def test_of_the_result_estimate_the_text_says_what_was_analysed():
    told = context(made(template(1), 6))
    texts = [
        " ".join(methods(told, [], replace(FACTS, algorithms=("preference/1",), result=result)))
        for result in ("elite", "estimate")
    ]
    assert "are those last chosen as best" in texts[0] and "are the estimates" not in texts[0]
    assert "are the estimates of that search" in texts[1] and "last chosen as best" not in texts[1]


def test_where_trials_may_end_early_the_text_says_when():
    told = context(made(template(0), 3), made(template(0), 3, emotion="b"))
    search = {"strategy": "preference", "stop_at": 0.15, "least_generations": 2}
    early = small_study(generations=7, search=search)
    recorded = replace(told.recording, configs=dict.fromkeys(told.recording.configs, early))
    text = "\n".join(methods(replace(told, recording=recorded), [], FACTS))
    assert "With at most 7 generations and" in text
    assert "from 2 on, before which the search expects its own estimate to be within a cosine distance of 0.15" in text
    assert "at most" not in "\n".join(methods(told, [], FACTS))
