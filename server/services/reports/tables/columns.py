"""Every column of the export, declared once: all that names or explains a column comes from here (dictionary.py)."""

from __future__ import annotations

from typing import Literal

from .column import Column, Table, integer, json_text, milliseconds, number, text, time, truth

WHO = (
    text("study_id", "The study."),
    text("config_hash", "SHA-256 of the study's configuration that this participation ran under."),
    text("participation", "The participation."),
    truth("simulated", "Whether a program took part."),
    truth("pilot", "Whether the study was in its pilot phase."),
)
TRIAL = (
    text("trial", "The trial."),
    text("block", "Name of the block that it belongs to; practice for the practised emotion."),
    text("emotion", "The emotion asked for, as its adjective; empty where a trial has several."),
    truth("practice", "Whether this was practice."),
)
WHEN = (
    integer("attempt", "How often the trial had been started again, from 0."),
    integer("generation", "0 is the initial population."),
)
_HEAD = (
    "a preset's name, MODEL:HEAD for a head of another face model, or custom- and the first 12 letters of the hash of"
    " an identity document (MODEL:custom- if it is of another face model), which stands among the identities of the"
    " configuration with this row's config_hash"
    " (address configurations, file configurations.json)."
)
_CLOCK = "on the page's clock, from the navigation"
KINDS = ("evolve", "rate", "categorise", "attention", "questionnaire")
STEPS = ("consent", "calibration", "instructions", "practice", "evolve", "rating", *KINDS[1:], "debrief", "ended")
OUTCOMES = ("complete", "no_consent", "screened_out", "failed_checks", "stopped", "erased")
ORIGINS = (
    "elite", "mean", "elite-mean", "kept", "bred", "random", "protocol:EMOTION", "arbitrary", "neutral", "fixed",
    "fixed:NUMBER", "posterior-mean", "draw", "draws-mean", "elite-draw", "part",
)  # fmt: skip
EVENTS = (
    "select", "deselect", "best", "undo", "enlarge", "enlarge_end", "first_view", "hidden", "visible", "blur", "focus",
    "onset",
)  # fmt: skip


def _family(name: str, family: Literal["genes", "weights"], help_: str, *, single: bool = False) -> Column:
    return Column(name, "number", help_, least=0, most=1, family=family, single=single)


_COLLISION = (
    truth("collided_lips", "Whether the upper lip had entered the lower one; empty where it was not looked for."),
    truth("collided_teeth", "Whether front teeth had entered the lower lip; empty where it was not looked for."),
    number("depth_before_mm", "Greatest depth of what collided, before the correction.", "mm"),
    number("depth_after_mm", "The same after it; what the correction did are the eight last weights.", "mm"),
)

_ALL = (
    Table(
        "participations",
        "Who took part: one row a person, with condition, head, language, outcome and times.",
        ("participation",),
        (
            *WHO,
            integer("number", "Order of arrival in the study, from 0."),
            text("rig_hash", "SHA-256 of the face model."),
            text("algorithm", "Name and version of the search."),
            text("condition", "The condition; in a study without conditions the same as head, or all."),
            text("head", f"The head this participant saw, empty if it was several: {_HEAD}"),
            integer("order_row", "Row of the Latin square that the order of emotions comes from, from 0."),
            text("language", "The language of the pages."),
            text("seed", "Entropy of the trial seeds, decimal. Text, since it exceeds what a number holds."),
            json_text("trial_order", "The emotions in the order they were asked for."),
            json_text("recruiter", "Parameters of the recruiter that the study keeps."),
            json_text("device", "What the check of the device found."),
            text("step", "Where the participation stands.", *STEPS),
            text("outcome", "How it ended; empty while it runs.", *OUTCOMES),
            time("arrived_at", "When the place was taken."),
            time("consented_at", "When consent was given."),
            time("last_answer_at", "When the last answer arrived."),
            time("ended_at", "When it ended."),
            time("erased_at", "When it was erased on request; such a row is all that is left."),
        ),
    ),
    Table(
        "trials",
        "What they did: one row a trial, in its order.",
        ("trial",),
        (
            *WHO,
            *TRIAL,
            integer("position", "Order within the participation, from 0; practice included."),
            text("kind", "What is done in it.", *KINDS),
            text("identity", f"The head that wears the rig: {_HEAD}"),
            text("seed", "Entropy of all random draws of this trial, decimal."),
            integer("attempts", "How often it was started again."),
            integer("generations", "The generation that was reached; in a trial without generations, how many items."),
            truth(
                "ended_early",
                "Whether that is the last one since the search was sure enough before the study's most generations.",
                later=True,
            ),
            text("final_face", "The face that ended the trial."),
            time("started_at", "When its first faces were made."),
            time("ended_at", "When its last best face was chosen."),
        ),
    ),
    Table(
        "generations",
        "One row for every ten faces that were offered together.",
        ("generation_id",),
        (
            *WHO,
            *TRIAL,
            *WHEN,
            text("generation_id", "The ten faces offered together."),
            time("made_at", "When they were made."),
            time("discarded_at", "When the trial was started again instead of choosing; else empty."),
            truth("answered", "Whether a choice was made."),
        ),
    ),
    Table(
        "faces",
        "Every face that was offered: genes, weights of all shapes, where it came from, whether it was chosen.",
        ("face",),
        (
            *WHO,
            *TRIAL,
            *WHEN,
            text("face", "The face."),
            integer("slot", "Place in the algorithm's population.", least=1, most=10),
            integer("place", "Place on the screen.", least=1, most=10),
            text("origin", "How it came about.", *ORIGINS),
            json_text("parents", "Slots of the previous generation that it comes from."),
            text("identity", f"The head that wears the rig: {_HEAD}"),
            text("rig_hash", "SHA-256 of the face model that gives the numbers their meaning."),
            text("portrait_key", "Content key of its picture."),
            truth("selected", "Whether it was chosen; empty without a choice."),
            truth("elite", "Whether it was marked as the best; empty without a choice."),
            *_COLLISION,
            _family("gene_", "genes", "One column a gene of the rig: what the search moves."),
            _family("weight_", "weights", "One column a shape of the rig, correctives included.", single=True),
        ),
    ),
    Table(
        "choices",
        "One row a choice: the faces selected and the best one, with onset, reaction time and render delay.",
        ("trial", "attempt", "generation"),
        (
            *WHO,
            *TRIAL,
            *WHEN,
            json_text("selected", "The chosen faces, in the order of choosing."),
            text("elite", "The best of them."),
            time("arrived_at", "When the answer arrived at the server."),
            milliseconds("requested_ms", f"When the page asked for the faces, {_CLOCK}."),
            milliseconds("decoded_ms", f"When all ten pictures were decoded, {_CLOCK}."),
            milliseconds("onset_ms", f"When they appeared, {_CLOCK}."),
            milliseconds("chosen_ms", f"When Next was pressed, {_CLOCK}."),
            milliseconds("hidden_ms", "How long the page was hidden in between."),
            number("viewport_width", "Width of the window.", "CSS px"),
            number("viewport_height", "Height of the window.", "CSS px"),
            number("pixel_ratio", "Device pixels a CSS pixel."),
            number("tile_width", "Width of a face on the screen.", "CSS px"),
            number("tile_height", "Height of a face on the screen.", "CSS px"),
            text("input", "mouse, touch, pen or keyboard."),
            milliseconds(
                "drawn_ms", "How long the server drew these faces; empty if they were drawn before or elsewhere."
            ),
            truth("none_is_close", "Whether none of the faces was said to come close; empty where it was not asked."),
        ),
    ),
    Table(
        "estimates",
        "What a search that weighs all answers takes for the face in mind, one row a finished trial: a second result"
        " beside its final face. The search of EmoGen 2021 has none.",
        ("trial",),
        (
            *WHO,
            *TRIAL,
            integer("attempt", "The attempt whose answers it rests on, from 0."),
            integer("generation", "The generation of the last of them."),
            text("identity", f"The head that wears the rig: {_HEAD}"),
            text("rig_hash", "SHA-256 of the face model that gives the numbers their meaning."),
            text("portrait_key", "Content key of its picture."),
            *_COLLISION,
            _family("gene_", "genes", "One column a gene of the rig."),
            _family("weight_", "weights", "One column a shape of the rig, correctives included.", single=True),
        ),
    ),
    Table(
        "events",
        "Every change of a selection, enlargement, undo and change of window while faces were on the screen.",
        ("participation", "event"),
        (
            *WHO,
            *TRIAL,
            *WHEN,
            text("event", "The event."),
            text("type", "What happened.", *EVENTS),
            milliseconds("at_ms", f"When, {_CLOCK}."),
            milliseconds("duration_ms", "How long, for enlarge_end."),
            text("face", "The face it concerns, if any."),
            time("arrived_at", "When it arrived at the server."),
        ),
    ),
    Table(
        "ratings",
        "Answers about a finished face: how strong, how close.",
        ("trial", "question"),
        (
            *WHO,
            *TRIAL,
            text("face", "The face that was judged."),
            text("question", "What was asked.", "intensity", "satisfaction"),
            integer("value", "The answer.", least=1, most=7),
            time("arrived_at", "When it arrived at the server."),
        ),
    ),
    Table(
        "stimuli",
        "Faces that were shown to be judged, with what they were made from.",
        ("stimulus",),
        (
            *WHO,
            *TRIAL,
            text("stimulus", "A face that was shown to be judged."),
            integer("item", "Its place in the trial, from 0."),
            text("source", "Where it comes from.", "own", "others", "means", "named"),
            text("name", "The face behind it, or the study's name for it."),
            text("meant", "The emotion that it was made for."),
            text("identity", f"The head that wears the rig: {_HEAD}"),
            json_text("made_from", "The finished faces behind it."),
            text("rig_hash", "SHA-256 of the face model that gives the numbers their meaning."),
            text("portrait_key", "Content key of its picture."),
            _family("gene_", "genes", "One column a gene of the rig."),
            _family("weight_", "weights", "One column a shape of the rig, correctives included.", single=True),
        ),
    ),
    Table(
        "responses",
        "Answers to the questions of all other trials.",
        ("trial", "item", "question"),
        (
            *WHO,
            *TRIAL,
            text("kind", "What is done in the trial.", *KINDS[1:]),
            integer("item", "Place in the trial, from 0."),
            text("stimulus", "The face that was judged, if it is about one."),
            text("question", "Name of the question; of a categorisation label, intensity, confidence."),
            json_text("value", "The answer as a list, empty if none was given."),
            json_text("expected", "The right answer as a list, where there is one."),
            time("arrived_at", "When it arrived at the server."),
            milliseconds("onset_ms", f"When the page showed it, {_CLOCK}."),
            milliseconds("answered_ms", f"When Next was pressed, {_CLOCK}."),
            milliseconds("hidden_ms", "How long the page was hidden in between."),
        ),
    ),
)

TABLES = {table.name: table for table in _ALL}
