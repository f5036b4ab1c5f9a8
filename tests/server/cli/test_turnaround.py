"""The figures of the turnaround, and what is said where no browser can be driven."""

import sys

import pytest
import typer

from server.cli.chromium import chromium
from server.cli.turnaround import report


def span(start, answer, draw, rest, paint):
    requested = start + answer
    decoded = requested + draw + rest
    return {"start": start, "requested": requested, "decoded": decoded, "onset": decoded + paint, "drawn": draw or None}


def test_the_parts_add_up_to_the_whole():
    found = report([span(100, 20, 80, 10, 30), span(900, 30, 0, 20, 20), span(2000, 40, 100, 30, 10)])
    assert found["n"] == 3
    assert (found["turnaround_ms"]["median"], found["turnaround_ms"]["max"]) == (110, 170)
    assert found["shown_ms"]["max"] == 180
    assert {name: part["max"] for name, part in found["split_ms"].items()} == {
        "answer": 40, "draw": 100, "transfer_and_decode": 30, "paint": 30,
    }  # fmt: skip
    assert found["holds"]


@pytest.mark.parametrize(("slow", "holds"), [(1, True), (3, False), (20, False)])
def test_the_bar_is_for_the_median_and_the_95th_percentile(slow, holds):
    spans = [span(0, 50, 100, 10, 20)] * (40 - slow) + [span(0, 50, 900, 10, 20)] * slow
    assert report(spans)["holds"] == holds


def test_drawing_that_began_before_the_reply_counts_from_the_reply_on():
    early = {**span(0, 50, 60, 5, 20), "drawn": 400.0}
    assert report([early])["split_ms"]["draw"]["max"] == 65
    assert report([early])["split_ms"]["transfer_and_decode"]["max"] == 0


def test_without_playwright_one_line_says_what_to_install(monkeypatch, capsys):
    monkeypatch.setitem(sys.modules, "playwright.sync_api", None)
    with pytest.raises(typer.Exit) as ended, chromium():
        pass
    assert ended.value.exit_code == 1
    said = capsys.readouterr().err
    assert "extra 'bench'" in said and said.count("\n") == 1
