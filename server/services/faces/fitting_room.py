"""Heads tried on before a study has them: the latest few are remembered, and each person waits for one only."""

from __future__ import annotations

import threading
from collections import OrderedDict
from typing import TYPE_CHECKING, Generic, TypeVar

from ..errors import ConflictError

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

REMEMBERED = 4

Worn = TypeVar("Worn")


class FittingRoom(Generic[Worn]):
    """What was made last, by key, and who asked last; for several threads."""

    def __init__(self) -> None:
        self._made: OrderedDict[str, Worn] = OrderedDict()
        self._latest: dict[str, int] = {}
        self._lock = threading.Lock()

    @property
    def remembered(self) -> int:
        """How many."""
        return len(self._made)

    def turn(self, user: str) -> Callable[[], None]:
        """Return what raises `ConflictError` once the same person has asked again."""
        with self._lock:
            self._latest[user] = ticket = self._latest.get(user, 0) + 1

        def wanted() -> None:
            if self._latest[user] != ticket:
                raise ConflictError("A newer preview was asked for.")

        return wanted

    def tried(self, keys: Sequence[str], make: Callable[[], Worn]) -> Worn:
        """Return what is remembered under any of the keys, or make it and remember it under the first one."""
        with self._lock:
            known = [self._made[key] for key in keys if key in self._made]
        if known:
            return known[0]
        made = make()  # takes seconds: others need not wait for it
        with self._lock:
            self._made[keys[0]] = made
            while len(self._made) > REMEMBERED:
                self._made.popitem(last=False)
        return made
