"""Every column of the export, declared once: from here come the header, the data dictionary and docs/export.md."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Column:
    """One column; `family` marks one that is repeated for every gene or shape of the rig."""

    name: str
    type: str
    unit: str
    help: str
    family: str | None = None


def _text(name: str, help_: str, unit: str = "") -> Column:
    return Column(name, "text", unit, help_)


def _whole(name: str, help_: str, unit: str = "") -> Column:
    return Column(name, "integer", unit, help_)


def _number(name: str, help_: str, unit: str = "") -> Column:
    return Column(name, "number", unit, help_)


def _truth(name: str, help_: str) -> Column:
    return Column(name, "boolean", "true, false", help_)


def _time(name: str, help_: str) -> Column:
    return Column(name, "time", "ISO 8601, UTC", help_)


def _ms(name: str, help_: str) -> Column:
    return _number(name, help_, "ms")


WHO = (
    _text("study_id", "The study."),
    _text("config_hash", "SHA-256 of the study's configuration that this participation ran under."),
    _text("participation", "The participation."),
    _truth("simulated", "Whether a program took part."),
    _truth("pilot", "Whether the study was in its pilot phase."),
)
TRIAL = (
    _text("trial", "The trial."),
    _text("emotion", "The emotion asked for, as its adjective."),
    _truth("practice", "Whether this was practice."),
)
WHEN = (
    _whole("attempt", "How often the trial had been started again, from 0."),
    _whole("generation", "0 is the initial population."),
)
_HEAD = (
    "a preset's name, or custom- and the first 12 letters of the hash of an identity document, which stands among the"
    " identities of the configuration with this row's config_hash (address configurations, file configurations.json)."
)
_CLOCK = "on the page's clock, from the navigation"

TABLES: dict[str, tuple[Column, ...]] = {
    "participations": (
        *WHO,
        _whole("number", "Order of arrival in the study, from 0."),
        _text("rig_hash", "SHA-256 of the face model."),
        _text("algorithm", "Name and version of the search."),
        _text("condition", f"The head this participant saw: {_HEAD}"),
        _text("seed", "Entropy of the trial seeds, decimal. Text, since it exceeds what a number holds."),
        _text("trial_order", "The emotions in the order they were asked for; JSON."),
        _text("recruiter", "Parameters of the recruiter that the study keeps; JSON."),
        _text("step", "Where the participation stands."),
        _text("outcome", "complete, no_consent, stopped, erased; empty while it runs."),
        _time("arrived_at", "When the place was taken."),
        _time("consented_at", "When consent was given."),
        _time("last_answer_at", "When the last answer arrived."),
        _time("ended_at", "When it ended."),
        _time("erased_at", "When it was erased on request; such a row is all that is left."),
    ),
    "trials": (
        *WHO,
        *TRIAL,
        _whole("position", "Order within the participation, from 0; practice included."),
        _text("kind", "evolve."),
        _text("identity", f"The head that wears the rig: {_HEAD}"),
        _text("seed", "Entropy of all random draws of this trial, decimal."),
        _whole("attempts", "How often it was started again."),
        _whole("generations", "The generation that was reached."),
        _text("final_face", "The face that ended the trial."),
        _time("started_at", "When its first faces were made."),
        _time("ended_at", "When its last best face was chosen."),
    ),
    "generations": (
        *WHO,
        *TRIAL,
        *WHEN,
        _text("generation_id", "The ten faces offered together."),
        _time("made_at", "When they were made."),
        _time("discarded_at", "When the trial was started again instead of choosing; else empty."),
        _truth("answered", "Whether a choice was made."),
    ),
    "faces": (
        *WHO,
        *TRIAL,
        *WHEN,
        _text("face", "The face."),
        _whole("slot", "Place in the algorithm's population, 1 to 10."),
        _whole("place", "Place on the screen, 1 to 10."),
        _text("origin", "elite, mean, elite-mean, kept, bred, random, protocol:EMOTION, arbitrary, neutral, fixed."),
        _text("parents", "Slots of the previous generation that it comes from; JSON."),
        _text("identity", f"The head that wears the rig: {_HEAD}"),
        _text("rig_hash", "SHA-256 of the face model that gives the numbers their meaning."),
        _text("portrait_key", "Content key of its picture."),
        _truth("selected", "Whether it was chosen; empty without a choice."),
        _truth("elite", "Whether it was marked as the best; empty without a choice."),
        _truth("collided_lips", "Whether the upper lip had entered the lower one; empty where it was not looked for."),
        _truth("collided_teeth", "Whether front teeth had entered the lower lip; empty where it was not looked for."),
        _number("depth_before_mm", "Greatest depth of what collided, before the correction.", "mm"),
        _number("depth_after_mm", "The same after it; what the correction did are the eight last weights.", "mm"),
        Column("gene_", "number", "0 to 1", "One column a gene of the rig: what the search moves.", "genes"),
        Column("weight_", "number", "0 to 1", "One column a shape of the rig, correctives included.", "weights"),
    ),
    "choices": (
        *WHO,
        *TRIAL,
        *WHEN,
        _text("selected", "The chosen faces, in the order of choosing; JSON."),
        _text("elite", "The best of them."),
        _time("arrived_at", "When the answer arrived at the server."),
        _ms("requested_ms", f"When the page asked for the faces, {_CLOCK}."),
        _ms("decoded_ms", f"When all ten pictures were decoded, {_CLOCK}."),
        _ms("onset_ms", f"When they appeared, {_CLOCK}."),
        _ms("chosen_ms", f"When Next was pressed, {_CLOCK}."),
        _ms("hidden_ms", "How long the page was hidden in between."),
        _number("viewport_width", "Width of the window.", "CSS px"),
        _number("viewport_height", "Height of the window.", "CSS px"),
        _number("pixel_ratio", "Device pixels a CSS pixel."),
        _number("tile_width", "Width of a face on the screen.", "CSS px"),
        _number("tile_height", "Height of a face on the screen.", "CSS px"),
        _text("input", "mouse, touch, pen or keyboard."),
    ),
    "events": (
        *WHO,
        *TRIAL,
        *WHEN,
        _text("event", "The event."),
        _text(
            "type",
            "select, deselect, best, undo, enlarge, enlarge_end, first_view, hidden, visible, blur, focus, onset.",
        ),
        _ms("at_ms", f"When, {_CLOCK}."),
        _ms("duration_ms", "How long, for enlarge_end."),
        _text("face", "The face it concerns, if any."),
        _time("arrived_at", "When it arrived at the server."),
    ),
    "ratings": (
        *WHO,
        *TRIAL,
        _text("face", "The face that was judged."),
        _text("question", "intensity or satisfaction."),
        _whole("value", "The answer.", "1 to 7"),
        _time("arrived_at", "When it arrived at the server."),
    ),
}


def markdown() -> str:
    """Return the tables as they stand in docs/export.md."""
    return "\n\n".join(_markdown(table, columns) for table, columns in TABLES.items())


def _markdown(table: str, columns: tuple[Column, ...]) -> str:
    lines = [f"## {table}", "", "| column | type | unit | meaning |", "| --- | --- | --- | --- |"]
    lines += [f"| `{_shown(column)}` | {column.type} | {column.unit} | {column.help} |" for column in columns]
    return "\n".join(lines)


def _shown(column: Column) -> str:
    return column.name if column.family is None else f"{column.name}NAME"
