"""A real server process with studies in it, and a real Chromium: what all browser tests and tools start from."""

from __future__ import annotations

import re
import sqlite3
import subprocess
from contextlib import closing, contextmanager
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path

from emogen_core.errors import EmogenError
from emogen_core.face.bundled import load_bundled_rig
from emogen_core.rendering.setup import make_renderer
from server.cli.chromium import chromium  # noqa: F401 - the browser of every test comes from here
from server.cli.local import served
from server.services.clock import digest
from server.services.config import DEMO, Emotion
from server.services.opening import open_house
from server.settings import Settings

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
BLOCKS = (
    {
        "kind": "questionnaire", "name": "about", "title": "About you",
        "items": (
            {"name": "age", "kind": "number", "text": "How old are you?", "least": 18, "most": 110},
            {"name": "gender", "kind": "single", "text": "What is your gender?", "options": ("woman", "man")},
            {"name": "mood", "kind": "scale", "text": "How are you?", "low": "Very bad", "high": "Very good"},
            {"name": "words", "kind": "text", "text": "Anything to add?", "required": False},
        ),
    },
    {"kind": "evolve", "name": "first"},
    {"kind": "rate", "name": "strength", "questions": ("intensity",)},
    {
        "kind": "categorise", "name": "reading", "labels": ("angry", "sad", "fearful", "happy", "disgusted"),
        # The faces of others, the default, would make a test as long as those before it left faces behind.
        "faces": {"sources": ("own",)},
    },
)  # fmt: skip
RIG = load_bundled_rig()
SURE = {
    "strategy": "preference", "stop_at": 0.5, "least_generations": 2, "activation": (1, 2),
    # Of two genes any choice tells enough.
    "excluded_genes": tuple(sorted({*RIG.gene_names} - {*RIG.emotion_sets["happy"].genes[:2]})),
}  # fmt: skip
STUDIES = {
    "full": {"portrait": {"width": 200}},
    "small": SMALL,
    "asking": {**SMALL, "none_is_close": True, "pause_ms": 900},
    "learning": {**SMALL, "search": {"strategy": "preference"}},
    "ending": {**SMALL, "generations": 4, "search": SURE},
    "ordered": {**SMALL, "places": "fixed"},
    "unrated": {**SMALL, "ratings": ()},
    "limited": {**SMALL, "maximum": 3, "minimum": 2},
    "dark": {**SMALL, "surround": "dark"},
    "pictures": {"title": "How do people picture emotions?", "texts": TEXTS, "identities": ("female",)},
    "blocks": {**SMALL, "practice": None, "generations": 1, "ratings": (), "blocks": BLOCKS},
    "closed": SMALL,
}


@dataclass
class Stage:
    """A running server."""

    folder: Path
    address: str
    setup: str
    process: subprocess.Popen
    links: dict[str, str] = field(default_factory=dict)

    def link(self, study, query=""):
        return f"{self.address}/s/{self.links[study]}{query}"

    def rows(self, sql, *values):
        with closing(sqlite3.connect(f"file:{self.folder / 'emogen.db'}?mode=ro", uri=True, timeout=10)) as database:
            return database.execute(sql, values).fetchall()

    def one(self, sql, *values):
        return self.rows(sql, *values)[0][0]


@cache
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
    with served(folder, **{"EMOGEN_RENDERER": drawing(), **environment}) as server:
        yield Stage(folder, server.address, server.setup, server.process, links)


def _make_studies(folder, studies):
    house = open_house(Settings(data_dir=folder), drawing=False)
    try:
        return {name: _link(house, name, changes) for name, changes in studies.items()}
    finally:
        house.close()


def _link(house, name, changes):
    config = DEMO.model_validate({**DEMO.model_dump(), **changes})
    status = "closed" if name.startswith("closed") else "recruiting"
    return house.studies.create(config, status).links[0]


def participation_of(stage, page):
    """Return the row id of the participation that a page shows."""
    token = re.search(r"/p/([\w-]+)", page.url)[1]
    return stage.one("SELECT id FROM participations WHERE token_hash = ?", digest(token))


def sent(page, button):
    """Send a form of a page without script, and wait for the page that answers."""
    with page.expect_navigation():
        page.locator(button).click()
