"""Who makes a report: the command `emogen analyse` in a process of its own.

It takes seconds of arithmetic and draws faces. What the dashboard shows is by construction what the command prints.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from ...own_process import PROGRAM, OwnProcess

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

COMMAND = (*PROGRAM, "analyse")
MOST_SECONDS = 600.0


class Analyst(OwnProcess):
    """Makes one report after the other."""

    def __init__(self, command: Sequence[str] = COMMAND, most_seconds: float = MOST_SECONDS) -> None:
        super().__init__(command, "emogen analyse", "analysis", most_seconds)

    def __call__(self, export: Path, out: Path, options: Sequence[str]) -> None:
        """Write the report of an export into a folder.

        Raises:
            UnavailableError: it failed, took too long, or the server is stopping; the message says which.
        """
        self.run([str(export), "--out", str(out), *options])
