"""A computation in a process of its own."""

import math
import os
import threading
import time
from multiprocessing import active_children

import pytest

from server.services.errors import UnavailableError
from server.services.own_call import NICE, made_aside


def test_it_gives_what_the_function_gives_and_stands_back():
    assert made_aside(threading.Event(), math.pow, 2, 5) == 32
    assert made_aside(threading.Event(), os.nice, 0) == min(os.nice(0) + NICE, 19)
    assert not active_children()


def test_it_ends_at_once_where_the_server_does():
    stopped = threading.Event()
    begun = time.monotonic()
    threading.Timer(0.3, stopped.set).start()
    with pytest.raises(UnavailableError, match="is stopping"):
        made_aside(stopped, time.sleep, 120)
    assert time.monotonic() - begun < 60
    assert not active_children()


def test_a_process_that_fails_is_one_sentence():
    with pytest.raises(UnavailableError, match="ended before it was done"):
        made_aside(threading.Event(), math.sqrt, -1)
