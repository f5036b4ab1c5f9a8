"""How many processes this machine runs at a time for us."""

from __future__ import annotations

import os
import sys


def cores() -> int:
    """Return the cores that this process may use, which a container or a batch system may have made fewer."""
    if sys.platform == "linux":
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1
