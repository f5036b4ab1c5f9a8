"""The table of analyses: reports that were asked for on the admin pages."""

from __future__ import annotations

from datetime import datetime

from sqlalchemy import BigInteger, ForeignKey
from sqlalchemy.orm import Mapped, deferred, mapped_column

from .base import Base


class Analysis(Base):
    """A report of a study: being made, made, or failed.

    It stands here and not in a folder because every process of the server has to find it, and because it has to go in
    the same transaction as the data of somebody who withdraws.
    """

    __tablename__ = "analyses"

    id: Mapped[str] = mapped_column(primary_key=True)
    study_id: Mapped[str] = mapped_column(ForeignKey("studies.id"), index=True)
    who: Mapped[str]
    """Who counts: people, pilot, simulated, all."""
    result: Mapped[str] = mapped_column(server_default="elite")
    """Which face of a trial is analysed: elite, estimate."""
    revision: Mapped[int] = mapped_column(BigInteger)
    """Of the data when it was begun: server/store/revisions.py."""
    begun_at: Mapped[datetime]
    ended_at: Mapped[datetime | None]
    counted: Mapped[str | None]
    """Who was counted, in words, once it is made."""
    problem: Mapped[str | None]
    """Why there is none, where it failed."""
    archive: Mapped[bytes | None] = deferred(mapped_column())
    """Its files as a zip."""
