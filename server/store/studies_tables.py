"""Tables of what an experimenter sets up: studies, their versions, links to them, and the rigs in use."""

from __future__ import annotations

from datetime import datetime
from typing import Any

from sqlalchemy import ForeignKey, UniqueConstraint
from sqlalchemy.orm import Mapped, mapped_column

from .base import Base


class Study(Base):
    """A study: its versions hold the configuration, its status says whether people may join, its note why not."""

    __tablename__ = "studies"

    id: Mapped[str] = mapped_column(primary_key=True)
    title: Mapped[str]
    status: Mapped[str]
    owner_id: Mapped[str | None]
    note: Mapped[str]
    created_at: Mapped[datetime]


class StudyVersion(Base):
    """One configuration of a study; its hash is written into every row of data. Frozen when somebody may join."""

    __tablename__ = "study_versions"
    __table_args__ = (UniqueConstraint("study_id", "number"),)

    id: Mapped[str] = mapped_column(primary_key=True)
    study_id: Mapped[str] = mapped_column(ForeignKey("studies.id"))
    number: Mapped[int]
    config: Mapped[dict[str, Any]]
    config_hash: Mapped[str]
    author_id: Mapped[str | None]
    created_at: Mapped[datetime]
    frozen_at: Mapped[datetime | None]


class Link(Base):
    """An address by which people join a study: general_multiple, general_single or personal (docs/study.md)."""

    __tablename__ = "links"

    id: Mapped[str] = mapped_column(primary_key=True)
    study_id: Mapped[str] = mapped_column(ForeignKey("studies.id"), index=True)
    kind: Mapped[str]
    label: Mapped[str]
    language: Mapped[str | None]
    condition: Mapped[str | None]
    created_at: Mapped[datetime]
    closed_at: Mapped[datetime | None]


class RigRecord(Base):
    """The names that give a stored vector its meaning, for every rig that was ever in use here."""

    __tablename__ = "rigs"

    hash: Mapped[str] = mapped_column(primary_key=True)
    name: Mapped[str]
    genes: Mapped[list[Any]]
    shapes: Mapped[list[Any]]
    first_used_at: Mapped[datetime]
