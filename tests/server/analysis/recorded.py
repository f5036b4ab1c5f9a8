"""Exports of simulated people: who made two faces twice and named some, and who saw a head of the study's own."""

from functools import partial

from typer.testing import CliRunner

from server.cli import app
from tests.server.cli.running import environment

FORMS = ("csv", "jsonl", "parquet", "psych-ds")
STUDY = """
title: Two emotions twice
texts: {minutes: 35, about: You made faces.}
emotions:
  - {adjective: happy, noun: happiness}
  - {adjective: angry, noun: anger}
identities: [female]
generations: 4
ratings: [intensity]
conditions:
  - {name: plain, changes: {}}
  - {name: longer, changes: {generations: 6}}
blocks:
  - {kind: evolve, name: first}
  - {kind: evolve, name: again, retest_of: first}
  - kind: categorise
    name: reading
    faces: {sources: [own, others, means], of: first, others: 1}
"""
HEAD = """
title: A head of our own
emotions: [{adjective: angry, noun: anger}]
identities: [female]
generations: 2
practice: null
conditions:
  - {name: ours, changes: {identities: [{format: emogen-identity, version: 1, name: Somebody, appearance: {},
      head: {sex: 1, age: 58, details: {nose-width: 0.6}}}]}}
  - {name: theirs, changes: {}}
"""


def export(data):
    """Fill a folder: a database, and the export in every format."""
    study = _taken_part(data, STUDY, 4)
    for form in FORMS:
        _told(data, "export", "--study", study, "--format", form, "--out", str(data / form))


def export_of_own_head(data):
    """Fill a folder: a database, and the export as Parquet; heads differ between conditions, the search does not."""
    study = _taken_part(data, HEAD, 2)
    _told(data, "export", "--study", study, "--format", "parquet", "--out", str(data / "parquet"))


def _taken_part(data, text, people):
    (data / "study.yaml").write_text(text, encoding="utf-8")
    told = partial(_told, data)
    study = told("study", "create", str(data / "study.yaml")).split()[-1]
    told("study", "start", study)
    told("simulate", "--study", study, "--participants", str(people))
    return study


def _told(data, *arguments):
    """Run a command here: in a process of its own, most of its time is its beginning."""
    done = CliRunner().invoke(app, arguments, env=environment(data))
    assert done.exit_code == 0, done.output
    return done.stdout
