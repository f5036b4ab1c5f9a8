"""What a server sees to by itself, at its start and on a timer."""

import threading

import pytest

from server.services.housekeeping import Housekeeping
from server.store.engine import StorageError


class Rounds:
    """Counts the sweeps; the second one finds the disk full."""

    def __init__(self):
        self.count = 0
        self.third = threading.Event()

    def sweep(self):
        self.count += 1
        if self.count == 2:
            raise StorageError("full")
        if self.count == 3:
            self.third.set()
        return 0


@pytest.fixture
def rounds():
    return Rounds()


def test_it_sweeps_at_the_start_and_again_and_again_whatever_the_disk_does(house, rounds):
    keeping = Housekeeping(house.journal, (rounds.sweep,), every=0.001)
    keeping.begin()
    assert rounds.third.wait(10)
    keeping.close()
    assert not keeping._thread.is_alive()


def test_it_ends_at_once(house, rounds):
    keeping = Housekeeping(house.journal, (rounds.sweep,))
    keeping.begin()
    keeping.close()
    assert rounds.count == 1
