"""What the database says about the participation that a page shows."""

from __future__ import annotations

import json

from server.services.opening import open_house
from server.settings import Settings
from tests.browser.stage import participation_of

CHOICES = (
    "SELECT g.attempt, g.number, c.selected, c.elite_face_id FROM choices c"
    " JOIN generations g ON g.id = c.generation_id"
    " JOIN trials t ON t.id = g.trial_id WHERE t.participation_id = ? AND NOT t.practice"
    " ORDER BY t.position, g.attempt, g.number"
)
EVENTS = (
    "SELECT e.type, e.at_ms, e.duration_ms, e.face_id, e.arrived_at FROM events e"
    " JOIN generations g ON e.generation_id = g.id JOIN trials t ON g.trial_id = t.id"
    " WHERE e.participation_id = ? AND NOT t.practice AND g.number = ? ORDER BY e.arrived_at, e.at_ms"
)


def chosen(stage, page):
    """Numbers of the generations that have a choice, in order."""
    return [number for _, number, *_ in stage.rows(CHOICES, participation_of(stage, page))]


def choices(stage, page):
    """Selected faces and the best of each choice."""
    return [(json.loads(selected), elite) for *_, selected, elite in stage.rows(CHOICES, participation_of(stage, page))]


def answers(stage, page):
    """How many answers are stored."""
    return stage.one("SELECT count(*) FROM answers WHERE participation_id = ?", participation_of(stage, page))


def outcome(stage, page):
    return stage.one("SELECT outcome FROM participations WHERE id = ?", participation_of(stage, page))


def events(stage, page, generation=0):
    """Events of a generation in their order, but for those that the window system sends."""
    rows = stage.rows(EVENTS, participation_of(stage, page), generation)
    return [row for row in rows if row[0] not in {"blur", "focus", "hidden", "visible"}]


def must_be_whole(stage, page, generations=2):
    """One choice a generation and no gap; every face is the one that an undisturbed run of this seed would show."""
    who = participation_of(stage, page)
    assert chosen(stage, page) == list(range(generations + 1))
    doubled = "SELECT count(*) FROM (SELECT generation_id FROM choices GROUP BY generation_id HAVING count(*) > 1)"
    assert stage.one(doubled) == 0
    assert stage.one(
        "SELECT count(*) FROM trials WHERE participation_id = ? AND kind = 'evolve' AND final_face_id IS NULL", who
    ) == 0  # fmt: skip
    house = open_house(Settings(data_dir=stage.folder), drawing=False)
    try:
        assert house.replay.participation(who).difference is None
    finally:
        house.close()
