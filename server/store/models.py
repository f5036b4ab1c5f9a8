"""Queries on the face models that were brought to this server."""

from __future__ import annotations

from typing import TYPE_CHECKING

from sqlalchemy import delete, select

from .models_tables import FaceModelRecord

if TYPE_CHECKING:
    from collections.abc import Sequence

    from .engine import Tx


def all_models(tx: Tx) -> Sequence[FaceModelRecord]:
    """Return every face model, by name, without its files."""
    return tx.scalars(select(FaceModelRecord).order_by(FaceModelRecord.name)).all()


def model(tx: Tx, name: str) -> FaceModelRecord | None:
    """Return a face model by its name."""
    return tx.get(FaceModelRecord, name)


def with_rig(tx: Tx, rig_hash: str) -> FaceModelRecord | None:
    """Return the face model that has a rig."""
    return tx.scalars(select(FaceModelRecord).where(FaceModelRecord.rig_hash == rig_hash)).first()


def files(tx: Tx, name: str) -> tuple[bytes, bytes, bytes | None] | None:
    """Return rig file, look file and, where it has any, the file of identity modes of a face model."""
    columns = (FaceModelRecord.rig, FaceModelRecord.look, FaceModelRecord.modes)
    found = tx.execute(select(*columns).where(FaceModelRecord.name == name)).first()
    return None if found is None else (found[0], found[1], found[2])


def remove(tx: Tx, name: str) -> None:
    """Delete a face model."""
    tx.execute(delete(FaceModelRecord).where(FaceModelRecord.name == name))
