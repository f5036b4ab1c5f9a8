"""The table of heads that were fitted for studies that bring their own."""

from __future__ import annotations

from datetime import datetime

from sqlalchemy.orm import Mapped, mapped_column

from .base import Base


class FittedHead(Base):
    """A fitted head, kept for good: another processor would fit it a little differently."""

    __tablename__ = "fitted_heads"

    name: Mapped[str] = mapped_column(primary_key=True)
    """What trials call it: derived from its identity document."""
    rig_hash: Mapped[str] = mapped_column(primary_key=True)
    """The rig that it was fitted to."""
    fitted_at: Mapped[datetime]
    head: Mapped[bytes] = mapped_column(deferred=True)
    """A head file."""
