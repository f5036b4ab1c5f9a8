"""Hashes that take memory and time: few at once, few that wait, and the rest are told to come again."""

import threading
from concurrent.futures import ThreadPoolExecutor, wait

import pytest

from server.services.errors import InvalidError, ThrottledError
from server.services.people import passwords
from server.services.people.passwords import AT_ONCE, WAITING, new_password, right_password

GOOD = "correct horse battery"


class Slow:
    """A hasher that can be held; remembers how many were at it together."""

    def __init__(self):
        self.gate, self.lock = threading.Event(), threading.Lock()
        self.now = self.most = 0

    def hash(self, password):
        with self.lock:
            self.now += 1
            self.most = max(self.most, self.now)
        assert self.gate.wait(20)
        with self.lock:
            self.now -= 1
        return password


def test_a_password_is_known_again_and_no_other():
    hashed = new_password(GOOD)
    assert GOOD not in hashed
    assert [right_password(one, GOOD) for one in (hashed, new_password(GOOD[::-1]), None)] == [True, False, False]


@pytest.mark.parametrize("bad", ["too short", "x" * 1001])
def test_a_password_has_a_length(bad):
    with pytest.raises(InvalidError):
        new_password(bad)


def test_a_flood_is_sent_away_and_leaves_room_behind(monkeypatch):
    slow = Slow()
    monkeypatch.setattr(passwords, "_hasher", slow)
    room = AT_ONCE + WAITING
    with ThreadPoolExecutor(room + 3) as pool:
        flood = [pool.submit(new_password, GOOD) for _ in range(room + 3)]
        refused, _ = wait(flood, 20, "FIRST_EXCEPTION")
        for one in refused:
            assert isinstance(one.exception(), ThrottledError)
        slow.gate.set()
        wait(flood, 20)
    assert sum(one.exception() is None for one in flood) >= room
    assert slow.most <= AT_ONCE
    assert new_password(GOOD) == GOOD
