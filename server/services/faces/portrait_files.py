"""The portrait cache on disk: one file a content key, written whole or not at all. Losing it costs time, not data."""

from __future__ import annotations

import contextlib
import logging
import os
import tempfile
from pathlib import Path

logger = logging.getLogger(__name__)


class PortraitFiles:
    """Portraits as files; a disk that is full or read-only is reported once and otherwise does no harm."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._complained = False

    def has(self, key: str) -> bool:
        """Return whether a portrait is there."""
        return self._path(key).is_file()

    def read(self, key: str) -> bytes | None:
        """Return a portrait, or nothing."""
        try:
            return self._path(key).read_bytes()
        except OSError:
            return None

    def write(self, key: str, picture: bytes) -> None:
        """Keep a portrait, if the disk lets us."""
        path = self._path(key)
        try:
            path.parent.mkdir(parents=True, exist_ok=True)
            _write_whole(path, picture)
            self._complained = False
        except OSError as error:
            if not self._complained:
                logger.warning("portraits cannot be kept on disk and are drawn anew when needed: %s", error)
            self._complained = True

    def remove(self, key: str) -> None:
        """Remove a portrait, if it is there and the disk lets us."""
        try:
            self._path(key).unlink(missing_ok=True)
        except OSError as error:
            logger.warning("a portrait cannot be removed from the disk: %s", error)

    def _path(self, key: str) -> Path:
        return self._folder / key[:2] / f"{key}.png"


def _write_whole(path: Path, picture: bytes) -> None:
    handle, temporary = tempfile.mkstemp(dir=path.parent, prefix=".", suffix=".part")
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(picture)
        Path(temporary).replace(path)
    except OSError:
        with contextlib.suppress(OSError):
            Path(temporary).unlink()
        raise
