"""Heads that were fitted once and stay as they are: in the database, or in the export that somebody replays."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Protocol

from emogen_core.rendering.head_file import load_head, save_head

from ...store import heads, runs
from ...store.heads_tables import FittedHead
from ..clock import now
from .face_model import own_name

if TYPE_CHECKING:
    from emogen_core.face.rig import Rig
    from emogen_core.rendering.worn import WornHead

    from ...store.engine import Database

FOLDER = "heads"
"""Where an export has them."""


class Kept(Protocol):
    """What keeps fitted heads."""

    def head(self, name: str, rig: Rig) -> WornHead | None:
        """Return a head that was kept for a rig; nothing if there is none of this name.

        Raises:
            RigFileError: what was kept cannot be read.
        """
        ...

    def keep(self, head: WornHead, rig: Rig) -> WornHead:
        """Keep a head of a rig, and return the one that stands: another process may have been quicker."""
        ...


class NothingKept:
    """Keeps nothing: every head is fitted anew."""

    def head(self, name: str, rig: Rig) -> WornHead | None:  # noqa: ARG002 - names of the protocol
        """Return nothing."""
        return None

    def keep(self, head: WornHead, rig: Rig) -> WornHead:  # noqa: ARG002 - a name of the protocol
        """Return the head."""
        return head


@dataclass(frozen=True)
class StoredHeads:
    """Keeps heads in the database."""

    database: Database

    def head(self, name: str, rig: Rig) -> WornHead | None:
        """Return a head that was kept."""
        with self.database.read() as tx:
            content = heads.head(tx, name, rig.hash)
        return None if content is None else read_head(content, rig)

    def keep(self, head: WornHead, rig: Rig) -> WornHead:
        """Keep a head, and return the one that stands."""
        row = FittedHead(name=head.name, rig_hash=rig.hash, fitted_at=now(), head=_content(head, rig))
        with self.database.write() as tx:
            first = runs.add_once(tx, row)
        return head if first else self.head(head.name, rig) or head


@dataclass(frozen=True)
class FileHeads(NothingKept):
    """Heads as an export has them.

    Attributes:
        read: returns a file of the export by its name, nothing if there is none.
    """

    read: Callable[[str], bytes | None]

    def head(self, name: str, rig: Rig) -> WornHead | None:
        """Return a head of the export; one that was made before exports had heads is fitted anew."""
        content = self.read(file_of(name, rig.hash))
        return None if content is None else read_head(content, rig)


def file_of(name: str, rig_hash: str) -> str:
    """Return what the file of a head is called in an export."""
    return f"{FOLDER}/{own_name(name)}-{rig_hash[:12]}.head"


def read_head(content: bytes, rig: Rig) -> WornHead:
    """Return a head of a head file's content.

    Raises:
        RigFileError: it is none, or was fitted to another rig.
    """
    with TemporaryDirectory(prefix="emogen-head-") as folder:
        path = Path(folder) / "fitted.head"
        path.write_bytes(content)
        return load_head(path, rig)


def _content(head: WornHead, rig: Rig) -> bytes:
    with TemporaryDirectory(prefix="emogen-head-") as folder:
        path = Path(folder) / "fitted.head"
        save_head(head, rig, path)
        return path.read_bytes()
