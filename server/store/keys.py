"""Secrets and marks that all processes of a server share."""

from __future__ import annotations

from typing import TYPE_CHECKING

from sqlalchemy import select

from . import runs
from .admin_tables import ServerKey

if TYPE_CHECKING:
    from datetime import datetime

    from .engine import Tx


def known(tx: Tx, name: str) -> str | None:
    """Return the secret of a name, if there is one."""
    found = tx.get(ServerKey, name)
    return None if found is None else found.value


def remember(tx: Tx, name: str, value: str, moment: datetime) -> None:
    """Store what goes by a name from now on."""
    found = tx.get(ServerKey, name, with_for_update=True)
    if found is None:
        shared(tx, name, value, moment)
    else:
        found.value, found.created_at = value, moment


def shared(tx: Tx, name: str, value: str, moment: datetime) -> str:
    """Return the secret of a name; the first call stores `value`."""
    found = tx.get(ServerKey, name)
    if found is None:
        runs.add_once(tx, ServerKey(name=name, value=value, created_at=moment))
        found = tx.scalars(select(ServerKey).where(ServerKey.name == name)).one()
    return found.value
