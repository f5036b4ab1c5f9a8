"""What commands share: a rig by its file or the bundled one, a report as lines or JSON, and a bar of what is done."""

import json

import pytest

from emogen_core.errors import RigFileError
from emogen_core.face.bundled import load_bundled_rig
from server.cli.common import progress, report_text, rig_of


def test_a_report_is_a_line_an_entry_or_the_same_as_json():
    report = {"faces": 10, "seconds": 0.5, "method": "fields"}
    assert report_text(report, as_json=False) == "faces: 10\nseconds: 0.5\nmethod: fields"
    assert json.loads(report_text(report, as_json=True)) == report


def test_without_a_file_the_rig_is_the_bundled_one():
    assert rig_of(None) is load_bundled_rig()


def test_a_file_that_is_no_rig_is_refused_and_never_replaced_by_the_bundled_one(tmp_path):
    (tmp_path / "head.rig").write_bytes(b"no rig")
    with pytest.raises(RigFileError):
        rig_of(tmp_path / "head.rig")


def test_progress_goes_to_standard_error_alone(capsys):
    with progress("Replaying") as done:
        for count in range(4):
            done(count, 3)
    told = capsys.readouterr()
    assert told.out == ""
    assert "Replaying" in told.err
