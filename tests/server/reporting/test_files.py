"""Files of a report take their places together."""

import pytest

from server.reporting.files import replace


def texts(folder):
    return {path.name: path.read_text(encoding="utf-8") for path in folder.iterdir()}


def test_files_replace_those_of_before_and_stale_ones_go(tmp_path):
    replace(tmp_path / "out", {"a.csv": "1", "b.csv": "2", "page.html": "p"})
    replace(tmp_path / "out", {"a.csv": "3", "page.html": "q"}, ["b.csv", "never.csv"])
    assert texts(tmp_path / "out") == {"a.csv": "3", "page.html": "q"}


def test_what_cannot_be_written_leaves_everything_as_it_was(tmp_path):
    replace(tmp_path, {"a.csv": "1", "page.html": "p"})
    with pytest.raises(OSError, match="no-folder"):
        replace(tmp_path, {"a.csv": "2", "no-folder/b.csv": "3", "page.html": "q"})
    assert texts(tmp_path) == {"a.csv": "1", "page.html": "p"}


def test_pictures_are_files_too(tmp_path):
    replace(tmp_path, {"a.png": b"\x89PNG\r\n\x1a", "page.html": "p"})
    assert (tmp_path / "a.png").read_bytes() == b"\x89PNG\r\n\x1a"
