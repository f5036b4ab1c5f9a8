"""Work that is shared out gives the same numbers, and whatever ends it ends all of its processes."""

import os
import signal
import subprocess
import sys
import time
from functools import partial
from multiprocessing import active_children

import numpy as np
import pytest

from emogen_core.errors import WorkerError
from emogen_core.search.params import search_params
from emogen_core.simulation.evaluation.laboratory import Laboratory
from emogen_core.simulation.evaluation.specs import RunSpec
from emogen_core.simulation.evaluation.work import SERIAL, Processes, engine, make, tasks
from emogen_core.simulation.observer import Observer
from tests.rig_factory import small_rig

SPECS = [RunSpec("target 1"), RunSpec("target 2", observer=Observer(noise=0.1))]
MANY = 20_000
"""Searches: 200 chunks of each run, of which only the first may be made where something ends the work."""


def small_laboratory(pause=None):
    rig = small_rig(genes=14)
    params = search_params(rig, activation=(2, 3), random_genes=3, generations=3, gaze=False)
    return Laboratory(rig, "female", 1, params, pause)


def slow_laboratory(tally):
    """Return one that takes its time and writes a letter to a file for each batch of faces: five a chunk."""
    return small_laboratory(partial(_tick, tally))


def _tick(tally):
    with tally.open("a") as file:
        file.write(".")
    time.sleep(0.01)


def chunks_made(tally):
    return len(tally.read_text()) / 5


def assert_same(made, wanted):
    assert made.keys() == wanted.keys()
    for key, elites in wanted.items():
        for name in ("genes", "weights", "right"):
            np.testing.assert_array_equal(getattr(made[key], name), getattr(elites, name))


def test_equal_runs_are_made_once_and_every_search_of_theirs():
    todo = tasks([SPECS[0], RunSpec("target 1"), SPECS[1]], 250)
    assert [(task.spec, task.number, task.searches) for task in todo] == [
        (spec, number, searches) for spec in SPECS for number, searches in ((0, 100), (1, 100), (2, 50))
    ]


def test_processes_make_the_numbers_of_one_and_are_gone_afterwards():
    told = []
    made = make(small_laboratory(), SPECS, 230, Processes(2), lambda *count: told.append(count))
    assert_same(made, make(small_laboratory(), SPECS, 230))
    assert [len(one.right) for one in made.values()] == [230, 230]
    assert told == [(count, 6) for count in range(1, 7)]
    assert not active_children()


def test_one_worker_is_this_process():
    assert engine(1) is SERIAL
    assert engine(3) == Processes(3)


def test_a_process_that_is_killed_is_one_sentence(tmp_path):
    def kill(*_):
        os.kill(active_children()[0].pid, signal.SIGKILL)

    with pytest.raises(WorkerError, match=r"ended from outside.*fewer --workers"):
        make(slow_laboratory(tmp_path / "tally"), SPECS, MANY, Processes(2), kill)
    assert not active_children()
    assert chunks_made(tmp_path / "tally") < 40


def test_an_error_in_one_chunk_ends_the_rest(tmp_path):
    (tmp_path / "tally").touch()
    with pytest.raises(KeyError, match="nobody"):
        make(slow_laboratory(tmp_path / "tally"), [RunSpec("nobody"), *SPECS], MANY, Processes(2))
    assert not active_children()
    assert chunks_made(tmp_path / "tally") < 40


def _tell_mask(told):
    told.write_text(str(signal.SIGINT in signal.pthread_sigmask(signal.SIG_BLOCK, ())))


def test_ctrl_c_is_kept_from_workers_and_from_nobody_else(tmp_path):
    # What runs in the background of a shell has it ignored from the start.
    before = signal.getsignal(signal.SIGINT)
    make(small_laboratory(partial(_tell_mask, tmp_path / "told")), SPECS, 10, Processes(1))
    assert (tmp_path / "told").read_text() == "True"
    assert signal.SIGINT not in signal.pthread_sigmask(signal.SIG_BLOCK, ())
    assert signal.getsignal(signal.SIGINT) is before


@pytest.mark.parametrize("moment", ["starting", "running"])
def test_ctrl_c_ends_every_process_without_a_word_of_theirs(tmp_path, moment):
    tally = tmp_path / "tally"
    tally.touch()
    # As the terminal does it: to this process and its workers at once.
    script = f"""if True:
        import os, signal, threading
        from multiprocessing import active_children
        from emogen_core.simulation.evaluation.work import Processes, make
        from pathlib import Path
        from tests.emogen_core.simulation.evaluation.test_work import MANY, SPECS, slow_laboratory

        signal.signal(signal.SIGINT, signal.default_int_handler)  # a shell's background has it ignored

        def interrupt(*_):
            os.killpg(0, signal.SIGINT)

        def watch():
            while not active_children():
                pass
            interrupt()

        if {moment == "starting"}:
            threading.Thread(target=watch, daemon=True).start()
        try:
            make(slow_laboratory(Path({str(tally)!r})), SPECS, MANY, Processes(2), interrupt)
        except KeyboardInterrupt:
            print("interrupted,", len(active_children()), "left")
    """
    done = subprocess.run(
        [sys.executable, "-c", script], capture_output=True, text=True, timeout=60, start_new_session=True, check=False
    )
    assert (done.stdout, done.stderr) == ("interrupted, 0 left\n", "")
    assert chunks_made(tally) < 40
