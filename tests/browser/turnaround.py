"""From the choice to ten new decoded portraits, in Chromium against a server of its own: prints one JSON object.

`python -m tests.browser.turnaround --generations 30`. Two spans a generation: `turnaround` begins when the person asks
for the next faces, `faces` when the server's reply has been read. The person looks for `--look` seconds in between, in
which the server draws the random faces ahead.
"""

from __future__ import annotations

import argparse
import json
import os
import statistics
import tempfile
from pathlib import Path

from .player import Player
from .stage import STUDIES, chromium, drawing, running

SPANS = ("turnaround", "faces")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--generations", type=int, default=30)
    parser.add_argument("--look", type=float, default=1.5, help="seconds between two choices")
    parser.add_argument("--width", type=int, default=400, help="width of a portrait in pixels")
    wanted = parser.parse_args()
    study = {**STUDIES["pictures"], "generations": wanted.generations, "portrait": {"width": wanted.width}}
    with (
        tempfile.TemporaryDirectory() as folder,
        running(Path(folder), {"bench": study}) as stage,
        chromium() as browser,
    ):
        spans = measure(stage, browser, wanted)
    report = {"generations": wanted.generations, "look_s": wanted.look, "width": wanted.width}
    report |= {"renderer": drawing(), "cores": os.cpu_count(), "bar_median_ms": 500}
    print(json.dumps(report | {name: summary(values) for name, values in spans.items()}))


def measure(stage, browser, wanted):
    player = Player(browser.new_page(viewport={"width": 1280, "height": 800}))
    player.begin(stage.link("bench"))
    for number in range(1, wanted.generations + 1):
        player.page.wait_for_timeout(wanted.look * 1000)
        player.choose(number % 10, (number + 4) % 10, best=number % 10).next()
        player.wait_generation(f"Generation {number} of")
    return {name: durations(player.page, f"emogen-{name}")[-wanted.generations :] for name in SPANS}


def durations(page, name):
    return page.evaluate("name => performance.getEntriesByName(name).map(entry => entry.duration)", name)


def summary(values):
    ordered = sorted(values)
    return {
        "median_ms": round(statistics.median(ordered), 1),
        "p95_ms": round(ordered[min(len(ordered) - 1, int(len(ordered) * 0.95))], 1),
        "max_ms": round(ordered[-1], 1),
    }


if __name__ == "__main__":
    main()
