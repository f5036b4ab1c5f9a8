"""A real server process with studies in it, and a real Chromium: what all browser tests and tools start from."""

from __future__ import annotations

import os
import re
import shutil
import sqlite3
import subprocess
import sys
from contextlib import closing, contextmanager
from dataclasses import dataclass, field
from pathlib import Path

from playwright.sync_api import sync_playwright

from emogen_core.errors import EmogenError
from emogen_core.rendering.setup import make_renderer
from server.services.clock import digest
from server.services.config import DEMO, Emotion
from server.services.drawing import open_house
from server.settings import Settings

SWITCHES = [
    "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking",
    "--disable-component-update", "--disable-sync",
]  # fmt: skip
SMALL = {"emotions": (Emotion(adjective="angry", noun="anger"),), "generations": 2, "portrait": {"width": 200}}
TEXTS = {
    "organisation": "University of Westbrook",
    "contact_name": "Dr Ines Marchetti, Department of Psychology, University of Westbrook",
    "contact": "faces-study@westbrook.example",
    "ethics": "the Psychology Research Ethics Committee, PREC-2026-0417",
    "minutes": 25,
    "payment": "£4.20 via Prolific",
    "erase_until": "6 December 2026",
}
STUDIES = {
    "full": {"portrait": {"width": 200}},
    "small": SMALL,
    "limited": {**SMALL, "maximum": 3, "minimum": 2},
    "dark": {**SMALL, "surround": "dark"},
    "pictures": {"title": "How do people picture emotions?", "texts": TEXTS, "identities": ("female",)},
    "closed": SMALL,
}


@dataclass
class Stage:
    """A running server."""

    folder: Path
    address: str
    setup: str
    links: dict[str, str] = field(default_factory=dict)

    def link(self, study, query=""):
        return f"{self.address}/s/{self.links[study]}{query}"

    def rows(self, sql, *values):
        with closing(sqlite3.connect(f"file:{self.folder / 'emogen.db'}?mode=ro", uri=True, timeout=10)) as database:
            return database.execute(sql, values).fetchall()

    def one(self, sql, *values):
        return self.rows(sql, *values)[0][0]


def drawing():
    """Return what can draw on this machine: OpenGL where it works, else the slow fallback."""
    try:
        renderer, *_ = make_renderer("pyrender")
    except EmogenError:
        return "software"
    renderer.close()
    return "pyrender"


@contextmanager
def running(folder, studies=STUDIES, **environment):
    """Serve studies from a folder, in a process of its own."""
    links = _make_studies(folder, studies)
    with _process(folder, environment) as (address, setup):
        yield Stage(folder, address, setup, links)


def _make_studies(folder, studies):
    house = open_house(Settings(data_dir=folder), drawing=False)
    try:
        return {name: _link(house, name, changes) for name, changes in studies.items()}
    finally:
        house.close()


def _link(house, name, changes):
    config = DEMO.model_validate({**DEMO.model_dump(), **changes})
    status = "closed" if name == "closed" else "recruiting"
    return house.studies.create(config, status).links[0]


@contextmanager
def _process(folder, environment):
    """Start `emogen serve` on a free port; it says in its first lines where it listens and how to set it up."""
    told = {"EMOGEN_DATA_DIR": str(folder), "EMOGEN_PORT": "0", "EMOGEN_RENDERER": drawing(), **environment}
    command = [str(Path(sys.executable).parent / "emogen"), "serve"]
    with (folder / "server.log").open("w", encoding="utf-8") as log:
        process = subprocess.Popen(
            command, env={**os.environ, **told}, stdout=subprocess.PIPE, stderr=log, text=True, cwd=folder
        )
        with process:
            try:
                yield _links(process, folder)
            finally:
                process.terminate()


def _links(process, folder):
    assert process.stdout is not None
    for line in process.stdout:
        if found := re.search(r"(http://[\w.]+:\d+)/admin(\S*)", line):
            return found[1], found[0]
    raise RuntimeError((folder / "server.log").read_text(encoding="utf-8"))


@contextmanager
def chromium():
    """Start the system's Chromium, or the one that Playwright installed."""
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=shutil.which("chromium"), args=SWITCHES)
        try:
            yield browser
        finally:
            browser.close()


def participation_of(stage, page):
    """Return the row id of the participation that a page shows."""
    token = re.search(r"/p/([\w-]+)", page.url)[1]
    return stage.one("SELECT id FROM participations WHERE token_hash = ?", digest(token))
