"""What was used last, up to a limit: heads come and go, and none may stay in memory for ever."""

from __future__ import annotations

from collections import OrderedDict
from typing import TYPE_CHECKING, Generic, TypeVar

if TYPE_CHECKING:
    from collections.abc import Callable

HEADS = 16
"""How many heads a renderer keeps ready; the bundled ones fit."""

K = TypeVar("K")
V = TypeVar("V")


class Recent(Generic[K, V]):
    """Values by key; making one more than the limit lets go of the one that was used longest ago."""

    def __init__(self, limit: int = HEADS, free: Callable[[V], object] | None = None) -> None:
        """Keep ``limit`` values, at least one; ``free`` is called with each that has to go."""
        self._limit = max(1, limit)
        self._free = free
        self._kept: OrderedDict[K, V] = OrderedDict()

    def get(self, key: K, make: Callable[[], V]) -> V:
        """Return the value of a key, made now if it is not there."""
        if key in self._kept:
            self._kept.move_to_end(key)
            return self._kept[key]
        value = self._kept[key] = make()
        while len(self._kept) > self._limit:
            _, old = self._kept.popitem(last=False)
            if self._free is not None:
                self._free(old)
        return value

    def clear(self) -> None:
        """Forget all values; none is freed."""
        self._kept.clear()

    def __contains__(self, key: object) -> bool:
        return key in self._kept

    def __len__(self) -> int:
        return len(self._kept)
