"""The files of an analysis."""

import csv
import io
import json
from dataclasses import replace

from server.analysis.files import comma_separated, page, plain, write
from server.analysis.methods import Facts
from server.analysis.section import LONG, Column, Section, Sheet

FACTS = Facts(
    "emogen analyse x", "1", "1", "2026", "A <study>", "a", "rig", "f0", ("c0",), ("emogen/1",), "2", "none", 1, 500
)
SHEET = Sheet("some", (Column("what"), Column("value", 2), Column("so")), (("a, b", 1 / 3, True), ("c", None, False)))


def section(name="some", **more):
    return Section(name, f"Title of {name}", "Says.", Sheet(name, SHEET.columns, SHEET.rows), **more)


def test_numbers_in_a_csv_file_read_back_as_they_were():
    head, first, second = csv.reader(io.StringIO(comma_separated(SHEET)))
    assert head == ["what", "value", "so"]
    assert (first[0], float(first[1]), first[2]) == ("a, b", 1 / 3, "true")
    assert second == ["c", "", "false"]


def test_no_text_is_a_formula_for_a_spreadsheet_and_negative_numbers_stay_numbers():
    told = Sheet("odd", (Column("emotion"), Column("value")), (("=HYPERLINK(1)", -0.5),))
    assert list(csv.reader(io.StringIO(comma_separated(told))))[1] == ["'=HYPERLINK(1)", "-0.5"]


def test_people_read_rounded_numbers_and_gaps():
    assert SHEET.shown() == [["a, b", "0.33", "yes"], ["c", "–", "no"]]
    assert SHEET.numbers == (False, True, False)
    small = Sheet("p", (Column("p", 4),), ((0.00001,), (0.0,), (-0.00001,), (0.0001,)))
    assert [cell for (cell,) in small.shown()] == ["< 0.0001", "0.0000", "-0.0000", "0.0001"]


def test_what_cannot_be_said_is_on_the_page_and_in_the_facts(tmp_path):
    one = section(lacks=("happy: an interval needs at least 5 people, got 3.",))
    write([one], ["Text."], FACTS, tmp_path, faces=False)
    assert "needs at least 5 people, got 3" in (tmp_path / "report.html").read_text()
    assert "A &lt;study&gt;" in (tmp_path / "report.html").read_text()
    assert json.loads((tmp_path / "about.json").read_text()) == json.loads(json.dumps(plain([one], FACTS)))
    assert (tmp_path / "methods.txt").read_text() == "Text.\n"


def test_tables_of_an_earlier_analysis_go_and_other_files_stay(tmp_path):
    (tmp_path / "mine.csv").write_text("mine")
    write([section("some"), section("other")], [], FACTS, tmp_path, faces=True)
    write([section("some")], [], FACTS, tmp_path, faces=True)
    assert {path.name for path in tmp_path.iterdir()} == {
        "mine.csv",
        "some.csv",
        "methods.txt",
        "about.json",
        "report.html",
    }


def test_a_long_table_is_folded_and_says_how_many_rows_it_has():
    long = replace(section(), sheet=Sheet("some", SHEET.columns, SHEET.rows * LONG))
    folded = page([long], [], FACTS, faces=True)
    assert f"<summary>Numbers: {2 * LONG} rows</summary>" in folded
    assert folded.count("<tr>") == 2 * LONG + 1
    assert "<details" not in page([section()], [], FACTS, faces=True)


def test_simulated_people_are_named_before_anything_else():
    told = {
        share: page([section()], [], replace(FACTS, simulated=share), faces=True) for share in ("all", "some", "none")
    }
    assert "All participants are simulated" in told["all"].partition("What the finished faces say")[0]
    assert "Some participants are simulated" in told["some"].partition("What the finished faces say")[0]
    assert "are simulated" not in told["none"]


def test_what_the_export_was_restricted_to_is_said_before_anything_else():
    part = replace(FACTS, filters={"condition": "<a>"}, restricted="the condition “<a>”", unchecked=True)
    head = page([section()], [], part, faces=True).partition("What the finished faces")[0]
    assert "it holds the condition “&lt;a&gt;” only" in head and "failed one" in head
    assert "restricted" not in page([section()], [], FACTS, faces=True)
    told = plain([section()], part)
    assert (told["filters"], told["restricted"]) == ({"condition": "<a>"}, "the condition “<a>”")


def test_people_read_the_name_of_a_head_and_the_file_has_what_the_export_has():
    own = replace(section(), sheet=Sheet("some", (Column("emotion"), Column("head")), (("happy", "custom-1"),)))
    told = page([own], [], replace(FACTS, heads={"custom-1": "Some<body"}), faces=True)
    assert "<td>Some&lt;body</td>" in told and "<td>custom-1</td>" not in told
    assert "Head Some&lt;body" in told and "custom-1" in told
    assert "custom-1" in comma_separated(own.sheet)
