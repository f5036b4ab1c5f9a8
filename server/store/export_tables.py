"""Tables that exports need: how far the data of a study has come, and what a download consisted of."""

from __future__ import annotations

from datetime import datetime

from sqlalchemy import BigInteger, ForeignKey
from sqlalchemy.orm import Mapped, mapped_column

from .base import Base


class StudyRevision(Base):
    """How often the data of a study was changed: revisions.py."""

    __tablename__ = "study_revisions"

    study_id: Mapped[str] = mapped_column(ForeignKey("studies.id"), primary_key=True)
    revision: Mapped[int] = mapped_column(BigInteger)


class Receipt(Base):
    """What a download consisted of, once it was sent as a whole: who has less was interrupted."""

    __tablename__ = "export_receipts"

    id: Mapped[str] = mapped_column(primary_key=True)
    study_id: Mapped[str] = mapped_column(ForeignKey("studies.id"), index=True)
    file: Mapped[str]
    rows: Mapped[int] = mapped_column(BigInteger)
    bytes: Mapped[int] = mapped_column(BigInteger)
    sha256: Mapped[str]
    finished_at: Mapped[datetime] = mapped_column(index=True)
