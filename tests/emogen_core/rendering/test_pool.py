"""The pool against a renderer that hangs, dies and errs on demand."""

import io
import os
import signal
import sys
import threading
import time
from concurrent.futures import wait
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from emogen_core.errors import InvalidInputError, MissingGLError, RenderingError
from emogen_core.rendering.pool import Priority, RenderPool
from emogen_core.rendering.protocol import RenderSettings

SIZE = RenderSettings(20, 24)
HERE = str(Path(__file__).parent)


@pytest.fixture(autouse=True)
def _find_the_fake(monkeypatch):
    monkeypatch.syspath_prepend(HERE)


@pytest.fixture
def pool():
    with RenderPool(2, "fake_backend:make", time_limit=2) as pool:
        yield pool


def shade(png):
    """Return which weight the fake renderer was given."""
    with Image.open(io.BytesIO(png)) as picture:
        assert picture.size == (20, 24)
        return picture.getpixel((0, 0))[0] / 255


def alpha(value):
    return np.array([value, 0], np.float32)


def test_every_face_comes_back_as_itself(pool):
    values = np.linspace(0, 1, 31)
    futures = [pool.submit("head", alpha(v), SIZE) for v in values]
    assert [shade(f.result(10)) for f in futures] == pytest.approx(list(values), abs=1 / 255)


def test_faces_asked_for_now_overtake_faces_drawn_ahead():
    done = []
    with RenderPool(1, "fake_backend:make") as pool:
        blocker = pool.submit("slow", alpha(0), SIZE)
        time.sleep(0.05)
        futures = [pool.submit("slow", alpha(0), SIZE, Priority.AHEAD) for _ in range(3)]
        futures += [pool.submit("slow", alpha(1), SIZE, Priority.NOW) for _ in range(3)]
        for future in futures:
            future.add_done_callback(lambda f: done.append(shade(f.result())))
        wait([blocker, *futures], 10)
    assert done == [1, 1, 1, 0, 0, 0]


def test_a_killed_worker_is_replaced_and_its_faces_are_drawn(pool):
    before = pool.process_ids
    futures = [pool.submit("slow", alpha(i / 10), SIZE) for i in range(10)]
    time.sleep(0.1)
    for process in before:
        os.kill(process, signal.SIGKILL)
    assert [shade(f.result(20)) for f in futures] == pytest.approx([i / 10 for i in range(10)], abs=1 / 255)
    assert not set(before) & set(pool.process_ids)


def test_a_worker_that_dies_in_one_face_draws_it_at_the_second_attempt(tmp_path, monkeypatch):
    monkeypatch.setenv("FAKE_BACKEND_FLAG", str(tmp_path / "died"))
    with RenderPool(1, "fake_backend:make") as pool:
        assert shade(pool.submit("die once", alpha(1), SIZE).result(20)) == 1


def test_a_face_that_always_kills_its_worker_fails_and_harms_no_other(pool):
    bad = pool.submit("die", alpha(0), SIZE)
    good = [pool.submit("head", alpha(1), SIZE) for _ in range(6)]
    with pytest.raises(RenderingError, match="3 attempts"):
        bad.result(30)
    assert [shade(f.result(20)) for f in good] == [1] * 6


def test_a_worker_that_hangs_is_given_up():
    with RenderPool(1, "fake_backend:make", time_limit=0.3) as pool:
        start = time.monotonic()
        with pytest.raises(RenderingError, match="no answer"):
            pool.submit("hang", alpha(0), SIZE).result(30)
        assert time.monotonic() - start < 15
        assert shade(pool.submit("head", alpha(1), SIZE).result(20)) == 1


def test_bad_input_is_told_and_costs_only_itself(pool):
    futures = [pool.submit("head", alpha(v), SIZE) for v in (0.2, 2.0, 0.4)]
    with pytest.raises(InvalidInputError, match=r"got 2\.0"):
        futures[1].result(10)
    assert [shade(futures[i].result(10)) for i in (0, 2)] == pytest.approx([0.2, 0.4], abs=1 / 255)


def test_a_bug_in_the_renderer_is_a_rendering_error(pool):
    with pytest.raises(RenderingError, match="ZeroDivisionError: a bug"):
        pool.submit("bug", alpha(0), SIZE).result(10)


def test_a_process_with_a_bug_is_replaced_and_its_traceback_is_told(capfd):
    with RenderPool(1, "fake_backend:make") as pool:
        (before,) = pool.process_ids
        with pytest.raises(RenderingError, match="a bug"):
            pool.submit("bug", alpha(0), SIZE).result(10)
        assert shade(pool.submit("head", alpha(1), SIZE).result(20)) == 1
        assert pool.process_ids != [before]
    told = capfd.readouterr().err
    assert "Traceback" in told and 'raise ZeroDivisionError("a bug")' in told


def test_a_refusal_is_no_bug_and_keeps_the_process(capfd):
    with RenderPool(1, "fake_backend:make") as pool:
        before = pool.process_ids
        with pytest.raises(InvalidInputError):
            pool.submit("head", alpha(2), SIZE).result(10)
        assert pool.process_ids == before
    assert "Traceback" not in capfd.readouterr().err


def test_closing_does_not_wait_for_a_worker_and_fails_what_is_left():
    pool = RenderPool(1, "fake_backend:make")
    futures = [pool.submit("hang", alpha(0), SIZE) for _ in range(5)]
    time.sleep(0.1)
    start = time.monotonic()
    pool.close()
    assert time.monotonic() - start < 3
    for future in futures:
        with pytest.raises(RenderingError, match="closed"):
            future.result(1)
    with pytest.raises(RenderingError, match="closed"):
        pool.submit("head", alpha(0), SIZE)
    assert pool.process_ids == []
    pool.close()


def test_a_waiting_face_can_be_cancelled():
    with RenderPool(1, "fake_backend:make") as pool:
        pool.submit("slow", alpha(0), SIZE)
        time.sleep(0.05)
        second = pool.submit("slow", alpha(0), SIZE)
        assert second.cancel()
        assert shade(pool.submit("head", alpha(1), SIZE).result(10)) == 1


def test_many_threads_may_submit(pool):
    results = {}

    def ask(i):
        results[i] = shade(pool.submit("head", alpha(i / 20), SIZE).result(20))

    threads = [threading.Thread(target=ask, args=(i,)) for i in range(20)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(20)
    assert results == {i: pytest.approx(i / 20, abs=1 / 255) for i in range(20)}


@pytest.mark.parametrize(
    ("backend", "error", "sentence"),
    [
        ("fake_backend:without_gl", MissingGLError, "no OpenGL"),
        ("fake_backend:broken", RenderingError, "cannot start"),
        ("no_such_module:make", RenderingError, "no_such_module"),
        ("crayon", InvalidInputError, "backend: expected one of"),
    ],
)
def test_a_failing_start_is_one_sentence_at_once(backend, error, sentence):
    with pytest.raises(error, match=sentence):
        RenderPool(2, backend)


def test_a_start_that_hangs_is_given_up():
    with pytest.raises(RenderingError, match="did not start"):
        RenderPool(1, "fake_backend:stuck", start_limit=0.5)


def test_workers_have_one_thread_each(pool):
    environment = Path(f"/proc/{pool.process_ids[0]}/environ")
    if not environment.exists():
        pytest.skip("no /proc here")
    variables = environment.read_bytes().split(b"\0")
    assert {b"LP_NUM_THREADS=0", b"OPENBLAS_NUM_THREADS=1", b"PYOPENGL_PLATFORM=egl"} <= set(variables)


def test_workers_end_with_their_parent(tmp_path):
    script = (
        f"import sys; sys.path[:0] = {[HERE, *sys.path]!r}\n"
        "from emogen_core.rendering.pool import RenderPool\n"
        "print(RenderPool(1, 'fake_backend:make').process_ids[0], flush=True)\n"
        "import os; os._exit(0)\n"
    )
    import subprocess

    out = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True, timeout=60)
    worker = int(out.stdout)
    deadline = time.monotonic() + 5
    while Path(f"/proc/{worker}").exists() and time.monotonic() < deadline:
        time.sleep(0.05)
    assert not Path(f"/proc/{worker}").exists(), "the worker outlived its pool"


def test_no_worker_is_refused():
    with pytest.raises(InvalidInputError, match="at least 1"):
        RenderPool(0)


def custom(number, like="female"):
    from emogen_core.rendering.worn import WornHead

    return WornHead(f"custom-{number}", np.zeros((2, 3), np.float32), None, {}, like)


def drawn(pool, head):
    """Return how many heads the worker had been handed when it drew this one."""
    return round(shade(pool.submit(head.name, alpha(0), SIZE, head=head).result(10)) * 255)


def test_a_head_is_handed_to_a_worker_once_and_again_after_it_was_replaced():
    with RenderPool(1, "fake_backend:make") as pool:
        first, second = custom(1), custom(2)
        assert [drawn(pool, head) for head in (first, first, second, first)] == [1, 1, 2, 2]
        os.kill(pool.process_ids[0], signal.SIGKILL)
        assert [drawn(pool, head) for head in (second, first, second)] == [1, 2, 2]


def test_a_worker_keeps_the_heads_drawn_last():
    with RenderPool(1, "fake_backend:make") as pool:
        assert [drawn(pool, custom(number)) for number in range(16)] == list(range(1, 17))
        assert drawn(pool, custom(0)) == 16
        assert drawn(pool, custom(16)) == 17, "one too many: the one drawn longest ago goes"
        assert drawn(pool, custom(0)) == 17
        assert drawn(pool, custom(1)) == 18


def test_a_head_that_cannot_be_dressed_costs_only_itself(pool):
    refused = custom(3, like="refused")
    with pytest.raises(InvalidInputError, match="appearance: expected"):
        pool.submit(refused.name, alpha(0), SIZE, head=refused).result(10)
    assert shade(pool.submit("head", alpha(1), SIZE).result(10)) == 1


def test_a_large_head_to_a_worker_that_listens_no_more_is_given_up(monkeypatch):
    monkeypatch.setattr("emogen_core.rendering.process._SEND_SECONDS", 1)
    with RenderPool(1, "fake_backend:make") as pool:
        from dataclasses import replace

        stopped = pool.process_ids[0]
        os.kill(stopped, signal.SIGSTOP)
        large = replace(custom(4), neutral=np.zeros((2**20, 3), np.float32))
        assert drawn(pool, large) == 1
        assert pool.process_ids != [stopped]
