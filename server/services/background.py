"""Work that nobody waits for: where it fails, the log tells so; a future that nobody asks would keep it to itself."""

from __future__ import annotations

import logging
from typing import TYPE_CHECKING, Any

from .errors import UnavailableError

if TYPE_CHECKING:
    from concurrent.futures import Future

logger = logging.getLogger(__name__)


def watched(work: Future[Any], failing: str) -> None:
    """Log why work in the background failed: a line where the house is only busy, a traceback for anything else.

    Args:
        work: what somebody else runs.
        failing: what is to be said of it, for instance "drawing ahead failed".
    """
    work.add_done_callback(lambda done: _tell(done, failing))


def _tell(done: Future[Any], failing: str) -> None:
    error = None if done.cancelled() else done.exception()
    if isinstance(error, UnavailableError):
        logger.info("%s: %s", failing, error)
    elif error is not None:
        logger.error(failing, exc_info=error)
