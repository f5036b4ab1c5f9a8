"""The portraits that were used last, in memory."""

from __future__ import annotations

import threading
from collections import OrderedDict


class PortraitMemory:
    """Keeps up to a number of bytes. Safe to use from several threads."""

    def __init__(self, limit: int) -> None:
        """Take the largest number of bytes."""
        self._limit = limit
        self._size = 0
        self._held: OrderedDict[str, bytes] = OrderedDict()
        self._lock = threading.Lock()

    def get(self, key: str) -> bytes | None:
        """Return what is kept under a key."""
        with self._lock:
            found = self._held.get(key)
            if found is not None:
                self._held.move_to_end(key)
            return found

    def put(self, key: str, picture: bytes) -> None:
        """Keep a picture, and drop those that were not used for longest."""
        with self._lock:
            self._size += len(picture) - len(self._held.pop(key, b""))
            self._held[key] = picture
            while self._size > self._limit and self._held:
                self._size -= len(self._held.popitem(last=False)[1])

    def drop(self, key: str) -> None:
        """Forget a picture."""
        with self._lock:
            self._size -= len(self._held.pop(key, b""))
