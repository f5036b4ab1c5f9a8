"""What an export was restricted to: a part of a study must not pass for all of it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from .telling import listed

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from ..services.config import StudyConfig

WORDS = {
    "condition": "the condition “{}”",
    "arrived_from": "arrivals from {} on",
    "arrived_before": "arrivals before {}",
    "block": "trials of the block “{}”",
    "emotion": "trials of the emotion “{}”",
    "since": "participations that came or changed since an earlier export",
}
KINDS = {
    "people": "people (neither of the pilot phase nor simulated)",
    "pilot": "people of the pilot phase",
    "simulated": "simulated participants",
}


def filters(manifest: Mapping[str, Any]) -> dict[str, str]:
    """Return what an export was restricted by, as its manifest has it, its cursor included."""
    since = manifest.get("since")
    return {**manifest["filters"], **({"since": str(since)} if since else {})}


def restricted(told: Mapping[str, str]) -> str:
    """Return what that is in words; nothing where nothing was left out."""
    words = [
        KINDS.get(value, value) if name == "kind" else WORDS.get(name, f"{name} {{}}").format(_utc(value))
        for name, value in told.items()
    ]
    return listed(words) if words else ""


def _utc(value: str) -> str:
    return f"{value.removesuffix('+00:00')} UTC" if value.endswith(":00+00:00") else value


def unchecked(told: Mapping[str, str], studies: Iterable[StudyConfig]) -> bool:
    """Return whether attention checks of the study are outside of what was exported."""
    checks = {step.name for study in studies for step in study.steps if step.kind == "attention"}
    return bool(checks) and ("emotion" in told or ("block" in told and checks != {told["block"]}))
