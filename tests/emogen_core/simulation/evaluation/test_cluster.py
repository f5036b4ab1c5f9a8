"""A Dask cluster gives the numbers of one process, and what ends it is one sentence."""

import os
from contextlib import closing
from functools import partial

import dask
import pytest
from dask.distributed import LocalCluster

from emogen_core.errors import EmogenError, WorkerError
from emogen_core.simulation.evaluation import cluster
from emogen_core.simulation.evaluation.cluster import DaskCluster
from emogen_core.simulation.evaluation.work import make
from tests.emogen_core.simulation.evaluation.test_work import (
    MANY,
    SPECS,
    assert_same,
    slow_laboratory,
    small_laboratory,
)


def local(workers):
    return LocalCluster(n_workers=workers, threads_per_worker=1, dashboard_address=None, silence_logs="CRITICAL")


def test_a_cluster_makes_the_same_numbers():
    with local(2) as there, closing(DaskCluster(there.scheduler_address)) as client:
        made = make(small_laboratory(), SPECS, 230, client)
    assert_same(made, make(small_laboratory(), SPECS, 230))


def test_a_worker_that_dies_of_a_task_ends_the_rest():
    laboratory = small_laboratory(partial(os._exit, 1))
    with (
        dask.config.set({"distributed.scheduler.allowed-failures": 0}),
        local(1) as there,
        closing(DaskCluster(there.scheduler_address)) as client,
        pytest.raises(WorkerError, match="no worker runs out of memory"),
    ):
        make(laboratory, SPECS, MANY, client)


def test_a_cluster_without_workers_is_said_so(monkeypatch):
    monkeypatch.setattr(cluster, "PATIENCE", "1s")
    with (
        local(0) as there,
        closing(DaskCluster(there.scheduler_address)) as client,
        pytest.raises(WorkerError, match="No valid workers found"),
    ):
        make(small_laboratory(), SPECS, 10, client)


def test_a_scheduler_that_goes_is_said_so(tmp_path):
    with (
        local(1) as there,
        closing(DaskCluster(there.scheduler_address)) as client,
        pytest.raises(WorkerError, match="does not go on"),
    ):
        make(slow_laboratory(tmp_path / "tally"), SPECS, MANY, client, lambda *_: there.close())


@pytest.mark.parametrize(
    ("address", "said"),
    [
        ("tcp://127.0.0.1:1", r"No Dask scheduler answers at tcp://127\.0\.0\.1:1: Timed out"),
        ("nonsense", "No Dask scheduler answers at nonsense: missing port number"),
    ],
)
def test_nobody_at_the_address_is_said_so(monkeypatch, address, said):
    monkeypatch.setattr(cluster, "PATIENCE", "1s")
    with pytest.raises(EmogenError, match=said):
        DaskCluster(address)


def test_without_dask_its_extra_is_named(monkeypatch):
    def missing(name):
        raise ImportError(name)

    monkeypatch.setattr(cluster.importlib, "import_module", missing)
    with pytest.raises(EmogenError, match=r"emogen-study\[dask\]"):
        DaskCluster("tcp://127.0.0.1:1")
