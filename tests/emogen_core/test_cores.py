"""Cores: those that this process may use, not those that the machine has."""

import os
import sys

import pytest

from emogen_core.cores import cores


@pytest.mark.skipif(sys.platform != "linux", reason="elsewhere a process is not bound to cores")
def test_a_process_that_is_bound_to_fewer_cores_counts_those():
    before = os.sched_getaffinity(0)
    assert cores() == len(before)
    try:
        os.sched_setaffinity(0, {min(before)})
        assert cores() == 1
    finally:
        os.sched_setaffinity(0, before)


def test_elsewhere_all_are_counted(monkeypatch):
    monkeypatch.setattr(sys, "platform", "darwin")
    monkeypatch.setattr(os, "cpu_count", lambda: 6)
    assert cores() == 6
    monkeypatch.setattr(os, "cpu_count", lambda: None)
    assert cores() == 1
