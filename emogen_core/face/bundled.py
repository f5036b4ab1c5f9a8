"""The rig that comes with the package."""

from __future__ import annotations

from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING

from emogen_core.face.rig_file import load_rig

if TYPE_CHECKING:
    from emogen_core.face.rig import Rig

BUNDLED_RIG = Path(__file__).parent / "data" / "head.rig"


@lru_cache(maxsize=1)
def load_bundled_rig() -> Rig:
    """Return the bundled head, read and verified once a process.

    Raises:
        RigFileError: the installed file is missing or damaged.
    """
    return load_rig(BUNDLED_RIG)
