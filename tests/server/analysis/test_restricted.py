"""A part of a study does not pass for all of it."""

import pytest

from server.analysis.restricted import filters, restricted, unchecked
from server.services.reports.tables.selection import Filters
from tests.conftest import small_study

CHECK = {"kind": "attention", "name": "check", "text": "Choose sad.", "options": ["sad", "happy"], "right": "sad"}


def test_of_a_whole_export_nothing_is_said():
    told = filters({"filters": {}, "since": None})
    assert (told, restricted(told)) == ({}, "")


def test_every_filter_has_words_with_its_value():
    told = {
        "condition": "alone", "kind": "pilot", "arrived_from": "2026-03-01 00:00:00+00:00",
        "arrived_before": "2026-04-01 00:00:00+00:00", "block": "first", "emotion": "angry",
    }  # fmt: skip
    assert set(told) == set(Filters.__dataclass_fields__), "a filter without words"
    assert restricted(filters({"filters": told, "since": "abc"})) == (
        "the condition “alone”, people of the pilot phase, arrivals from 2026-03-01 00:00:00 UTC on, arrivals before"
        " 2026-04-01 00:00:00 UTC, trials of the block “first”, trials of the emotion “angry” and participations"
        " that came or changed since an earlier export"
    )


@pytest.mark.parametrize("kind", ["people", "pilot", "simulated"])
def test_kinds_are_told_in_words(kind):
    assert kind in restricted({"kind": kind}) and restricted({"kind": kind}) != kind


def test_a_filter_that_this_version_does_not_know_is_told_as_it_is():
    assert restricted({"language": "{de}"}) == "language {de}"


@pytest.mark.parametrize(
    ("told", "outside"),
    [({}, False), ({"condition": "a"}, False), ({"emotion": "angry"}, True), ({"block": "first"}, True),
     ({"block": "check"}, False)],
)  # fmt: skip
def test_attention_checks_outside_of_the_export_are_noticed(told, outside):
    study = small_study(blocks=[{"kind": "evolve", "name": "first"}, CHECK])
    assert unchecked(told, [study]) == outside
    assert not unchecked(told, [small_study()]), "a study without any lacks none"
