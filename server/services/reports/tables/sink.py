"""Where libraries write a file that goes on its way at once, and is never there as a whole."""

from __future__ import annotations

import io
from typing import Any


class Sink(io.RawIOBase):
    """A file that can only be written to; `taken` gives what came since and forgets it."""

    def __init__(self) -> None:
        super().__init__()
        self._parts: list[bytes] = []
        self._length = 0

    def writable(self) -> bool:
        """Return that it is."""
        return True

    def write(self, data: Any) -> int:
        """Take bytes; return how many."""
        part = bytes(data)
        self._parts.append(part)
        self._length += len(part)
        return len(part)

    def tell(self) -> int:
        """Return how much has been written."""
        return self._length

    def taken(self) -> bytes:
        """Return what was written since the last time."""
        parts, self._parts = self._parts, []
        return b"".join(parts)
