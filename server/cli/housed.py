"""What commands share that work with the studies of a server: its house, and files of studies.

It imports the whole server, so commands that need none do without.
"""

from __future__ import annotations

from contextlib import contextmanager
from typing import TYPE_CHECKING

from ..services.config.files import read_study
from ..services.opening import open_house
from .common import plainly, stop

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from ..services.config import StudyConfig
    from ..services.house import House
    from ..settings import Settings


@contextmanager
def opened(settings: Settings, *, drawing: bool = True) -> Iterator[House]:
    """Open the house for a command, with or without drawing processes, and close it whatever happens."""
    with plainly():
        house = open_house(settings, drawing=drawing)
    try:
        with plainly():
            yield house
    finally:
        house.close()


def read_file(file: Path) -> StudyConfig:
    """Return the study of a file, YAML or JSON; end the command if there is no such file.

    Raises:
        InvalidError: it is no study, with every problem.
    """
    try:
        content = file.read_bytes()
    except OSError as error:
        raise stop(f"{file}: expected a study file, got {error.strerror}") from error
    return read_study(content)
