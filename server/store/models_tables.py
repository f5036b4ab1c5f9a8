"""The table of face models that were brought to this server; the bundled one needs no row."""

from __future__ import annotations

from datetime import datetime
from typing import Any

from sqlalchemy.orm import Mapped, mapped_column

from .base import Base


class FaceModelRecord(Base):
    """A rig and its look. They stand here and not in a folder because every process of the server has to find them."""

    __tablename__ = "face_models"

    name: Mapped[str] = mapped_column(primary_key=True)
    """What its heads are called by: NAME:HEAD."""
    rig_hash: Mapped[str] = mapped_column(unique=True)
    look_hash: Mapped[str]
    heads: Mapped[list[Any]]
    emotions: Mapped[list[Any]]
    counts: Mapped[dict[str, Any]]
    """Genes, shapes, vertices: what a page tells of it."""
    findings: Mapped[dict[str, Any]]
    """What its import found, guessed and missed; empty if it came as files."""
    added_by: Mapped[str | None]
    added_at: Mapped[datetime]
    rig: Mapped[bytes] = mapped_column(deferred=True)
    look: Mapped[bytes] = mapped_column(deferred=True)
    sliders: Mapped[list[Any]]
    """Names of its identity modes."""
    modes: Mapped[bytes | None] = mapped_column(deferred=True)
