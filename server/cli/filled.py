"""Rows of a database that is filled for a measurement."""

from __future__ import annotations

from datetime import timedelta
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from datetime import datetime

SETS = 4
DEVICES = ("computer", "phone", "tablet")
Row = dict[str, Any]


def participation_row(number: int, study: str, arrived: datetime) -> Row:
    """Return a participation, every ninth of which left."""
    left, ended = number % 9 == 0, arrived + timedelta(minutes=24)
    name = f"{study}-{number}"
    return {
        "id": name, "number": number, "token_hash": name, "algorithm": "", "config_hash": "", "simulated": False,
        "pilot": False, "preview": False, "condition": ("female", "male")[number % 2],
        "head": ("female", "male")[number % 2], "order_row": 0, "language": "en", "seed": "0",
        "trial_order": ["happy", "sad", "angry", "fearful"], "recruiter": {"PROLIFIC_PID": name},
        "device": {"kind": DEVICES[number % 3], "viewport": [1280, 720]}, "step": "ended" if left else "debrief",
        "position": number % SETS if left else SETS, "outcome": "stopped" if left else "complete",
        "completion_code": None, "withdrawal_code": name, "arrived_at": arrived, "consented_at": arrived,
        "last_answer_at": ended, "lease_until": ended, "ended_at": ended, "erased_at": None,
    }  # fmt: skip


def trial_row(person: Row, position: int) -> Row:
    """Return a trial of a participation."""
    return {
        "id": f"{person['id']}-{position}", "participation_id": person["id"], "position": position, "block": "evolve",
        "kind": "evolve", "practice": False, "emotion": "happy", "identity": person["head"], "seed": "0", "attempt": 0,
        "generation": 10, "last_generation": None, "state": None, "started_at": person["arrived_at"],
        "ended_at": person["ended_at"], "final_face_id": None,
    }  # fmt: skip


def generation_row(trial: Row, number: int) -> Row:
    """Return a generation of a trial."""
    made = trial["started_at"] + timedelta(minutes=6 * trial["position"], seconds=30 * number)
    return {
        "id": f"{trial['id']}-{number}", "trial_id": trial["id"], "attempt": 0, "number": number, "made_at": made,
        "discarded_at": None,
    }  # fmt: skip


def face_row(generation: str) -> Row:
    """Return a face without numbers, the only one of its generation."""
    return {
        "id": generation, "generation_id": generation, "slot": 1, "place": 1, "origin": "elite", "parents": [],
        "identity": "female", "genes": b"", "weights": b"", "portrait_key": generation, "collided_lips": None,
        "collided_teeth": None, "depth_before": None, "depth_after": None,
    }  # fmt: skip


def choice_row(generation: Row) -> Row:
    """Return the choice of a generation."""
    wait = 250.0 + 37 * generation["number"]
    size = dict.fromkeys(("viewport_width", "viewport_height", "tile_width", "tile_height"), 400.0)
    return {
        "id": generation["id"], "generation_id": generation["id"], "selected": [generation["id"]],
        "elite_face_id": generation["id"], "arrived_at": generation["made_at"], "requested_ms": 0.0,
        "decoded_ms": wait, "onset_ms": wait, "chosen_ms": wait + 9000, "hidden_ms": 0.0, "drawn_ms": 190.0,
        "none_is_close": None, "pixel_ratio": 1.0, "input": "mouse", **size,
    }  # fmt: skip
