"""What each template needs beside the state: hints that fit the study's limits, and the modules to load early."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple
from urllib.parse import urlsplit

from .items import asked

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from markupsafe import Markup

    from .catalogue import Catalogue
    from .items import Own

# The browser would find these one after the other; named in the page they come at once.
MODULES = (
    "page", "backoff", "choice", "dialog", "enlarge", "events", "grid", "input", "keyboard", "marks", "onward",
    "outbox", "panel", "pointer", "portraits", "progress", "redraw", "selection", "status", "stopping", "store", "tab",
    "views", "waiting",
)  # fmt: skip
OUTCOMES = {
    "no_consent": "declined",
    "stopped": "stopped",
    "erased": "erased",
    "screened_out": "screened_out",
    "failed_checks": "failed_checks",
}
RECRUITERS = {"prolific": "Prolific", "mturk": "MTurk", "sona-systems": "SONA"}
TEMPLATES = {"practice": "evolve"}


class Statement(NamedTuple):
    """Something to agree to: name of its field, what it says, what is said while it is open."""

    name: str
    text: str
    missing: str


def template_of(state: Mapping[str, Any]) -> str:
    """Return the template of a step."""
    step = str(state["step"])
    return f"{TEMPLATES.get(step, step)}.html"


def page_values(
    words: Catalogue, state: Mapping[str, Any], new_id: Callable[[], str], own: Own = str
) -> dict[str, Any]:
    """Return the values of a step's template; a page shown again after an error lays its own over them."""
    values: dict[str, Any] = {"answer_id": new_id(), "reset_id": new_id(), "agreed": [], "given": {}}
    if "trial" in state:
        values |= _evolve(words, state["trial"])
    if "item" in state:
        values |= {"asked": asked(words, state["item"], own), "answered": {}}
    if "completion" in state:
        completion = state["completion"]
        outcome = OUTCOMES.get(completion.get("outcome"), "over")
        values |= {"outcome": outcome, "withdrawal_code": completion.get("withdrawal_code")}
        values["place"] = recruiter_of(completion.get("redirect"))
    return values


def recruiter_of(address: str | None) -> str | None:
    """Return the name of the recruiter that an address leads to, where it is a well-known one."""
    host = urlsplit(address or "").hostname or ""
    return next((name for part, name in RECRUITERS.items() if part in host.split(".")), None)


def statements(words: Catalogue, consents: Sequence[str]) -> list[Statement]:
    """Return what has to be agreed to: the study's own statements, or the usual ones."""
    if consents:
        own = [words.isolated(text) for text in consents]
        missing = [words.say("consent.missing_own", statement=text) for text in own]  # markup: escaped once
        return [Statement(f"own-{n}", text, missing[n]) for n, text in enumerate(own)]
    return [
        Statement(name, str(words.say(f"consent.statements.{name}")), str(words.say(f"consent.missing.{name}")))
        for name in words.entry("consent.statements")
    ]


def choice_missing(words: Catalogue, trial: Mapping[str, Any], selected: Sequence[str], best: str | None) -> str | None:
    """Return what a choice lacks, in the words that the page with script uses, or None."""
    count = len(selected)
    if count < trial["minimum"]:
        key = "need_one" if trial["minimum"] == 1 else "need"
        return str(words.say(f"client.{key}", count=trial["minimum"]))
    if count > trial["maximum"]:
        return str(words.say("client.limit", count=trial["maximum"]))
    if count > 1 and best not in selected:
        return str(words.say("client.need_best", count=count))
    return None


def _evolve(words: Catalogue, trial: Mapping[str, Any]) -> dict[str, Any]:
    long, short = _hints(words, trial)
    chosen: dict[str, Any] = {"selected": [], "elite": None, "none_is_close": False}
    return {"hint": long, "hint_short": short, **chosen, "modules": MODULES}


def _hints(words: Catalogue, trial: Mapping[str, Any]) -> tuple[Markup, Markup]:
    """Return the hint for a wide and for a narrow page."""
    least, most, faces = trial["minimum"], trial["maximum"], len(trial["faces"])
    if (least, most) == (1, faces):
        return words.say("evolve.hint"), words.say("evolve.hint_short")
    key = _hint_key(least, most, faces)
    both = words.say(f"evolve.{key}", minimum=least, maximum=most)
    return both, both


def _hint_key(least: int, most: int, faces: int) -> str:
    if most == 1:
        return "hint_single"
    if least == most:
        return "hint_exactly"
    if least == 1:
        return "hint_up_to"
    return "hint_at_least" if most == faces else "hint_between"
