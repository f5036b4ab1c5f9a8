"""Heads of the study's own are called what their documents say, and no two the same."""

from dataclasses import replace

from server.analysis.groups import compared
from server.analysis.head_names import head_names
from server.analysis.kinds import plane
from server.analysis.means import means
from tests.server.analysis.made import context, made, rows, template

ONE, TWO = "custom-aaaaaaaaaaaa", "custom-bbbbbbbbbbbb"


class Study:
    """All that is asked of a study here."""

    def __init__(self, **names):
        self.documents = {head: {"name": name} for head, name in names.items()}


def test_a_head_is_called_by_the_name_in_its_document():
    study = Study(**{ONE: "Somebody", TWO: "Nobody made a face on it"})
    assert head_names([study, Study()], ["female", ONE]) == {ONE: "Somebody"}


def test_heads_that_would_be_called_the_same_keep_their_hash():
    study = Study(**{ONE: "Ann", TWO: "Ann"})
    assert head_names([study], [ONE, TWO]) == {ONE: f"Ann ({ONE})", TWO: f"Ann ({TWO})"}
    assert head_names([Study(**{ONE: "female"})], ["female", ONE]) == {ONE: f"female ({ONE})"}


def test_people_read_the_name_and_tables_have_what_the_export_has():
    parts = [made(template(1), 6, identity=head, condition=name, name=name)
             for head in ("female", ONE) for name in ("a", "b")]  # fmt: skip
    told = context(*parts)
    told = replace(told, recording=replace(told.recording, studies=(Study(**{ONE: "Somebody"}),)))
    cell = told.summaries[-1].cell
    assert told.label(cell) == "happy, Somebody, b"
    assert {row["head"] for row in rows(means(told))} == {"female", ONE}
    assert [one.label for one in compared(told)] == ["happy, female", "happy, Somebody"]
    assert [panel.name for figure in plane(told).figures for panel in figure.panels] == ["female", "Somebody"]
