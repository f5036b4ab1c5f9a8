"""The process that makes reports: what it is given, what it says, and how it is ended."""

import sys
import threading
import time

import pytest

from server.services.errors import UnavailableError
from server.services.own_process import NICE
from server.services.reports.analyses.analyst import COMMAND, Analyst


def running(program, **options):
    return Analyst((sys.executable, "-c", program), **options)


def test_it_is_given_export_folder_and_options_and_stands_back(tmp_path):
    program = "import os, sys, time; time.sleep(.5); open(sys.argv[3], 'w').write(f'{os.nice(0)} {sys.argv[1:]}')"
    running(program)(tmp_path / "in.zip", tmp_path / "out", ["--pilot"])
    nice, told = (tmp_path / "out").read_text().split(" ", 1)
    assert told == str([str(tmp_path / "in.zip"), "--out", str(tmp_path / "out"), "--pilot"])
    assert int(nice) >= NICE


def test_the_last_sentence_says_why_it_failed(tmp_path):
    program = "import sys; print('Simulating', file=sys.stderr); print('Nobody counts.', file=sys.stderr); sys.exit(1)"
    with pytest.raises(UnavailableError, match=r"^Nobody counts\.$"):
        running(program)(tmp_path, tmp_path, [])


@pytest.mark.parametrize("program", ["raise SystemError('secret')", "import sys; sys.exit(3)"])
def test_a_trace_is_for_the_log_alone(tmp_path, program, caplog):
    with pytest.raises(UnavailableError, match=r"^The analysis failed; the server's log says why\.$"):
        running(program)(tmp_path, tmp_path, [])
    assert "emogen analyse ended with" in caplog.text


def test_much_to_say_does_not_block_it(tmp_path):
    program = "import sys; print('x' * 10**6, file=sys.stderr); open(sys.argv[3], 'w').close()"
    running(program)(tmp_path, tmp_path / "out", [])
    assert (tmp_path / "out").exists()


def test_it_is_ended_when_it_takes_too_long(tmp_path):
    with pytest.raises(UnavailableError, match="longer than"):
        running("import time; time.sleep(600)", most_seconds=0.3)(tmp_path, tmp_path, [])


def test_it_is_ended_with_the_server(tmp_path):
    analyst, begun = running("import time; time.sleep(600)"), time.monotonic()
    threading.Timer(0.3, analyst.stop).start()
    with pytest.raises(UnavailableError, match="stopped"):
        analyst(tmp_path, tmp_path, [])
    assert time.monotonic() - begun < 60, "it waited for the process instead of ending it"


def test_the_command_is_that_of_this_program(tmp_path):
    with pytest.raises(UnavailableError, match=r"none\.zip"):
        Analyst(COMMAND)(tmp_path / "none.zip", tmp_path / "out", [])
