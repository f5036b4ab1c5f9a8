"""Files: the numbers as CSV, where they come from, and an earlier report that stays whole when writing fails."""

import csv
import json
from pathlib import Path

import pytest

from server.evaluation.files import comma_separated, markdown, write
from tests.server.evaluation.tables import FACTS, every, lines, noise, settings, threshold


def contents(folder):
    return {path.name: path.read_bytes() for path in folder.iterdir()}


def test_a_file_has_every_number_in_full_and_gaps_are_empty():
    for table in every():
        head, *rows = csv.reader(lines(comma_separated(table)))
        names = [column.name for column in table.columns]
        assert head[: len(names) + 1] == ["label", *names]
        for written, row in zip(rows, table.rows, strict=True):
            assert len(written) == len(head)
            back = dict(zip(head[1:], (float(one) if one else None for one in written[1:]), strict=True))
            assert written[0] == row.label
            assert [back[name] for name in names[: len(row.ours)]] == list(row.ours)
            for name, value in zip(names, row.paper, strict=False):
                assert back[f"{name} (paper)"] == value


def test_columns_that_the_paper_lacks_are_not_there():
    assert comma_separated(settings()).splitlines()[0] == 'label,mean,sd,"mean, noise .1","sd, noise .1"'
    assert comma_separated(noise()).splitlines()[0] == "label,mean,sd,mean (paper),sd (paper)"
    assert comma_separated(noise()).splitlines()[-1] == "threshold,1234.5678,,,0.065"


def test_the_numbers_keep_their_origin(tmp_path):
    write(every(), FACTS, tmp_path / "new" / "folder")
    told = json.loads((tmp_path / "new" / "folder" / "about.json").read_text(encoding="utf-8"))
    assert {name: told[name] for name in FACTS.__slots__} == {name: getattr(FACTS, name) for name in FACTS.__slots__}
    assert [(one["name"], one["agreement"]) for one in told["tables"]] == [
        ("noise", "agrees in trend"), ("separability", "agrees"), ("settings", "new"), ("threshold", "new"),
    ]  # fmt: skip
    assert told["tables"][0]["columns"] == {"mean": "", "sd": "of all <searches>"}
    assert {path.name for path in (tmp_path / "new" / "folder").iterdir()} == {
        "about.json", "report.html", "tables.md", *(one["file"] for one in told["tables"]),
    }  # fmt: skip


def test_the_same_tables_are_the_same_bytes(tmp_path):
    for name in "ab":
        write(every(), FACTS, tmp_path / name)
    assert contents(tmp_path / "a") == contents(tmp_path / "b")


def test_files_of_tables_that_are_no_more_go_and_others_stay(tmp_path):
    write([noise(), settings()], FACTS, tmp_path)
    (tmp_path / "mine.csv").write_text("kept")
    write([threshold()], FACTS, tmp_path, known=["noise", "settings", "threshold", "never made"])
    assert set(contents(tmp_path)) == {"about.json", "report.html", "tables.md", "threshold.csv", "mine.csv"}


@pytest.mark.parametrize("last", range(5))
def test_a_failing_write_leaves_the_earlier_report_whole(tmp_path, monkeypatch, last):
    write([noise(), settings()], FACTS, tmp_path)
    before, write_bytes, done = contents(tmp_path), Path.write_bytes, []

    def full(path, content):
        if len(done) == last:
            write_bytes(path, content[:10])
            raise OSError(28, "No space left on device")
        done.append(path)
        return write_bytes(path, content)

    monkeypatch.setattr(Path, "write_bytes", full)
    with pytest.raises(OSError, match="No space left"):
        write([noise(seed=9), settings(), threshold()], FACTS, tmp_path, known=["noise", "settings"])
    assert contents(tmp_path) == before


def test_the_page_is_put_in_place_last(tmp_path, monkeypatch):
    moved, replace = [], Path.replace
    monkeypatch.setattr(Path, "replace", lambda path, to: moved.append(path.name) or replace(path, to))
    write([noise(), settings()], FACTS, tmp_path)
    assert moved == ["noise.csv", "settings.csv", "about.json", "tables.md", "report.html"]


def test_a_document_has_every_number_as_the_page_has_it_and_the_papers_in_brackets():
    told = markdown(every(), FACTS)
    for table in every():
        assert table.verdict in told
        for row in table.rows:
            (line,) = (line for line in told.splitlines() if line.startswith(f"| {row.label} |"))
            written = [one.strip() for one in line.split("|")[2:-1]]
            assert len(written) == len(table.columns)
            for text, ours in zip(written, table.shown(row.ours), strict=False):
                assert text.split(" (")[0] == ours
    assert "(0.065)" in told
    assert FACTS.command in told
