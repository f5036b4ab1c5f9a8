"""Tables of what happens: participations, trials, faces, choices, estimates, events, ratings, responses, answers."""

from __future__ import annotations

from datetime import datetime
from typing import Any

from sqlalchemy import BigInteger, ForeignKey, UniqueConstraint
from sqlalchemy.orm import Mapped, mapped_column

from .base import Base


class Participation(Base):
    """One person's run through a study. `step` and `position` say where it stands.

    `head` is empty where every block is done with each head. `order_row` is the row of the Latin square. Until
    `lease_until` the place counts as taken. A preview is an experimenter's own and is deleted when it ends. `revision`
    says when it last changed (revisions.py).
    """

    __tablename__ = "participations"
    __table_args__ = (UniqueConstraint("study_id", "number"),)

    id: Mapped[str] = mapped_column(primary_key=True)
    study_id: Mapped[str] = mapped_column(ForeignKey("studies.id"), index=True)
    version_id: Mapped[str] = mapped_column(ForeignKey("study_versions.id"))
    link_id: Mapped[str] = mapped_column(ForeignKey("links.id"))
    number: Mapped[int]
    token_hash: Mapped[str] = mapped_column(unique=True)
    rig_hash: Mapped[str] = mapped_column(ForeignKey("rigs.hash"))
    algorithm: Mapped[str]
    config_hash: Mapped[str]
    simulated: Mapped[bool]
    pilot: Mapped[bool]
    preview: Mapped[bool]
    condition: Mapped[str]
    head: Mapped[str]
    order_row: Mapped[int | None]
    language: Mapped[str]
    seed: Mapped[str]
    trial_order: Mapped[list[Any]]
    recruiter: Mapped[dict[str, Any]]
    device: Mapped[dict[str, Any]]
    step: Mapped[str]
    position: Mapped[int]
    outcome: Mapped[str | None]
    completion_code: Mapped[str | None]
    withdrawal_code: Mapped[str] = mapped_column(unique=True)
    arrived_at: Mapped[datetime]
    consented_at: Mapped[datetime | None]
    last_answer_at: Mapped[datetime | None]
    lease_until: Mapped[datetime | None]
    ended_at: Mapped[datetime | None]
    erased_at: Mapped[datetime | None]
    revision: Mapped[int] = mapped_column(BigInteger, default=0)


class Trial(Base):
    """One task of a participation. `attempt` and `generation` name the population that is on the screen.

    In a trial without generations, `generation` counts its items. `emotion` is empty where a trial has several.
    `last_generation` is the one on the screen where it is the last since enough is known of the face in mind; empty
    where the study's most is the last one.
    """

    __tablename__ = "trials"
    __table_args__ = (UniqueConstraint("participation_id", "position"),)

    id: Mapped[str] = mapped_column(primary_key=True)
    participation_id: Mapped[str] = mapped_column(ForeignKey("participations.id"))
    position: Mapped[int]
    block: Mapped[str]
    kind: Mapped[str]
    practice: Mapped[bool]
    emotion: Mapped[str]
    identity: Mapped[str]
    seed: Mapped[str]
    attempt: Mapped[int]
    generation: Mapped[int]
    last_generation: Mapped[int | None]
    state: Mapped[str | None]
    started_at: Mapped[datetime | None]
    ended_at: Mapped[datetime | None]
    final_face_id: Mapped[str | None]


class Generation(Base):
    """Ten faces that were offered together."""

    __tablename__ = "generations"
    __table_args__ = (UniqueConstraint("trial_id", "attempt", "number"),)

    id: Mapped[str] = mapped_column(primary_key=True)
    trial_id: Mapped[str] = mapped_column(ForeignKey("trials.id"))
    attempt: Mapped[int]
    number: Mapped[int]
    made_at: Mapped[datetime]
    discarded_at: Mapped[datetime | None]


class Face(Base):
    """One face: genes (float64) and weights of all shapes (float32), little-endian, in the rig's order.

    Which types collided, and the greatest depth in millimetres before and after the correction, whose weights are the
    last eight of all weights. Empty on a rig without collision correctives and on faces older than these columns.
    """

    __tablename__ = "faces"
    __table_args__ = (UniqueConstraint("generation_id", "slot"), UniqueConstraint("generation_id", "place"))

    id: Mapped[str] = mapped_column(primary_key=True)
    generation_id: Mapped[str] = mapped_column(ForeignKey("generations.id"))
    slot: Mapped[int]
    place: Mapped[int]
    origin: Mapped[str]
    parents: Mapped[list[Any]]
    identity: Mapped[str]
    genes: Mapped[bytes]
    weights: Mapped[bytes]
    portrait_key: Mapped[str] = mapped_column(index=True)
    collided_lips: Mapped[bool | None]
    collided_teeth: Mapped[bool | None]
    depth_before: Mapped[float | None]
    depth_after: Mapped[float | None]


class ChoiceRecord(Base):
    """The selected faces of a generation and the best among them, with the times of the page's own clock."""

    __tablename__ = "choices"

    id: Mapped[str] = mapped_column(primary_key=True)
    generation_id: Mapped[str] = mapped_column(ForeignKey("generations.id"), unique=True)
    selected: Mapped[list[Any]]
    elite_face_id: Mapped[str] = mapped_column(ForeignKey("faces.id"))
    arrived_at: Mapped[datetime]
    requested_ms: Mapped[float | None]
    decoded_ms: Mapped[float | None]
    onset_ms: Mapped[float | None]
    chosen_ms: Mapped[float | None]
    hidden_ms: Mapped[float | None]
    drawn_ms: Mapped[float | None]
    none_is_close: Mapped[bool | None]
    viewport_width: Mapped[float | None]
    viewport_height: Mapped[float | None]
    pixel_ratio: Mapped[float | None]
    tile_width: Mapped[float | None]
    tile_height: Mapped[float | None]
    input: Mapped[str | None]


class Estimate(Base):
    """What a search that weighs all answers takes for the face in mind, after the last choice of a trial.

    Nobody was shown it. The columns are as in `Face`.
    """

    __tablename__ = "estimates"

    trial_id: Mapped[str] = mapped_column(ForeignKey("trials.id"), primary_key=True)
    identity: Mapped[str]
    genes: Mapped[bytes]
    weights: Mapped[bytes]
    portrait_key: Mapped[str] = mapped_column(index=True)
    collided_lips: Mapped[bool | None]
    collided_teeth: Mapped[bool | None]
    depth_before: Mapped[float | None]
    depth_after: Mapped[float | None]


class Event(Base):
    """Something the page saw while a generation was on the screen."""

    __tablename__ = "events"

    participation_id: Mapped[str] = mapped_column(ForeignKey("participations.id"), primary_key=True)
    id: Mapped[str] = mapped_column(primary_key=True)
    generation_id: Mapped[str] = mapped_column(ForeignKey("generations.id"), index=True)
    face_id: Mapped[str | None] = mapped_column(ForeignKey("faces.id"))
    type: Mapped[str]
    at_ms: Mapped[float]
    duration_ms: Mapped[float | None]
    arrived_at: Mapped[datetime]


class Rating(Base):
    """One question about the finished face of a trial, answered on a scale from 1 to 7."""

    __tablename__ = "ratings"

    trial_id: Mapped[str] = mapped_column(ForeignKey("trials.id"), primary_key=True)
    question: Mapped[str] = mapped_column(primary_key=True)
    value: Mapped[int]
    arrived_at: Mapped[datetime]


class Stimulus(Base):
    """A face that was shown to be judged, as weights: whatever becomes of the faces that it was made from.

    `source` is own, others, mean or named; `made_from` lists the finished faces behind it. Genes and weights as in
    `Face`.
    """

    __tablename__ = "stimuli"
    __table_args__ = (UniqueConstraint("trial_id", "item"),)

    id: Mapped[str] = mapped_column(primary_key=True)
    trial_id: Mapped[str] = mapped_column(ForeignKey("trials.id"))
    item: Mapped[int]
    source: Mapped[str]
    name: Mapped[str] = mapped_column(index=True)
    emotion: Mapped[str]
    identity: Mapped[str]
    made_from: Mapped[list[Any]]
    genes: Mapped[bytes]
    weights: Mapped[bytes]
    portrait_key: Mapped[str] = mapped_column(index=True)


class Response(Base):
    """One question of a trial without generations, answered; `expected` where there is a right answer."""

    __tablename__ = "responses"

    trial_id: Mapped[str] = mapped_column(ForeignKey("trials.id"), primary_key=True)
    item: Mapped[int] = mapped_column(primary_key=True)
    question: Mapped[str] = mapped_column(primary_key=True)
    stimulus_id: Mapped[str | None] = mapped_column(ForeignKey("stimuli.id"))
    value: Mapped[list[Any]]
    expected: Mapped[list[Any] | None]
    arrived_at: Mapped[datetime]
    onset_ms: Mapped[float | None]
    answered_ms: Mapped[float | None]
    hidden_ms: Mapped[float | None]


class Answer(Base):
    """An answer that was accepted, by the id that the client gave it, with the reply that it got."""

    __tablename__ = "answers"

    participation_id: Mapped[str] = mapped_column(ForeignKey("participations.id"), primary_key=True)
    id: Mapped[str] = mapped_column(primary_key=True)
    kind: Mapped[str]
    body_hash: Mapped[str]
    reply: Mapped[dict[str, Any]]
    arrived_at: Mapped[datetime]
