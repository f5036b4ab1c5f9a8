"""Waiting for what is meant, never for a time that is hoped to be long enough."""

from __future__ import annotations

import time

STEP = 40
DOUBLE = 300
"""Milliseconds within which a second tap on a face is half of a double one."""
STORED = """async ([store, count]) => {
  const request = indexedDB.open("emogen");
  const database = await new Promise((done) => { request.onsuccess = () => done(request.result); });
  const all = database.transaction(store).objectStore(store).getAll();
  await new Promise((done) => { all.onsuccess = done; });
  database.close();
  return all.result.length >= count;
}"""
NOTE = """types => {
  window.noted = [];
  window.note ??= (event) => window.noted.push([event.timeStamp, performance.now()]);
  for (const type of types) addEventListener(type, window.note, true);
}"""
SPREAD = "() => Math.max(...[0, 1].map((clock) => window.noted.at(-1)[clock] - window.noted[0][clock]))"
TWO_FRAMES = "() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))"


def until(page, read, wanted, seconds=20):
    """Return what `read` says as soon as `wanted` holds for it; the page goes on meanwhile."""
    end = time.monotonic() + seconds
    while not wanted(found := read()):
        assert time.monotonic() < end, f"still {found!r}"
        page.wait_for_timeout(STEP)
    return found


def apart(page):
    """Let so much time of the page's clock pass that the next tap is a first one."""
    page.wait_for_function(
        "([since, double]) => performance.now() - since > double", arg=[page.evaluate("performance.now()"), DOUBLE]
    )


def quickly(page, act, types, milliseconds, again):
    """Do what people do within so little time, anew until this machine was as quick by the page's own events."""
    for _ in range(40):
        page.evaluate(NOTE, types)
        act()
        if page.evaluate(SPREAD) < milliseconds:
            return
        again()
    raise AssertionError(f"never {' and '.join(types)} within {milliseconds} ms")


def on_device(page, store, count):
    """Wait until the browser has so many items in a store of its own, and has done what was asked of it before."""
    page.wait_for_function(STORED, arg=[store, count])


def at_rest(page):
    """Wait until no ring grows any more, and what was drawn has been laid out."""
    page.wait_for_function("() => document.getAnimations().length === 0")
    page.evaluate(TWO_FRAMES)
