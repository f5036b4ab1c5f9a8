"""Simulated participants sent from the dashboard: one run at a time, in a thread, through the real interface."""

from __future__ import annotations

import asyncio
import threading
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple

from ...store import accounts as rows
from ...store import studies
from ..background import watched
from ..clock import digest, now
from ..config.stored import parsed
from ..errors import ConflictError, InvalidError, NoStudyError, ServiceError
from ..participation.joining import OPEN
from ..people.accounts import audit
from ..trials.evolution import params_of
from .simulation import Report, Simulation

if TYPE_CHECKING:
    from collections.abc import Callable
    from concurrent.futures import Future
    from contextlib import AbstractAsyncContextManager
    from datetime import datetime

    from emogen_core.face.rig import Rig
    from emogen_core.search.params import SearchParams

    from ..participation.journal import Journal
    from ..people.tokens import Tokens

    ClientOf = Callable[[], AbstractAsyncContextManager[Any]]


class _Way(NamedTuple):
    """The link that simulated participants come by, and the rig and the search that they meet."""

    link: str
    rig: Rig
    params: SearchParams


MOST = 50
MOST_SEED = 2**31 - 1
TOKEN_DAYS = 0.5


@dataclass(frozen=True, slots=True)
class Sending:
    """How far a run of simulated participants is."""

    study: str
    count: int
    seed: int
    began_at: datetime
    finished: int
    running: bool
    problem: str | None


class _Run:
    def __init__(self, study: str, count: int, seed: int) -> None:
        self.study, self.began_at = study, now()
        self.report = Report(seed, count)
        self.problem: str | None = None
        self.work: Future[None] | None = None
        self.stopping = threading.Event()
        self.cancel: Callable[[], object] = lambda: None

    @property
    def running(self) -> bool:
        return self.work is not None and not self.work.done()

    def stop(self) -> None:
        """End it, also when it has only just begun and there is nothing yet to cancel."""
        self.stopping.set()
        with suppress(RuntimeError):  # its loop has closed: it is over
            self.cancel()


class Simulations:
    """Sends simulated participants; their rows are marked, and they never count as people."""

    def __init__(self, journal: Journal, tokens: Tokens) -> None:
        self._journal = journal
        self._tokens = tokens
        self._client_of: ClientOf | None = None
        self._lock = threading.Lock()
        self._behind = ThreadPoolExecutor(1, thread_name_prefix="simulated")
        self._run: _Run | None = None

    def reach(self, client_of: ClientOf) -> None:
        """Say how the participant's interface is reached; the app does when it is made."""
        self._client_of = client_of

    def send(self, study_id: str, count: int, seed: int, user: str | None) -> Sending:
        """Begin to send participants to a study; return at once.

        Raises:
            NotFoundError: no such study.
            InvalidError: too many, or the seed is not one.
            ConflictError: nobody can join it now, or another run is not over.
        """
        _check(count, seed)
        way = self._way(study_id)
        with self._lock:
            if self._run is not None and self._run.running:
                raise ConflictError("Simulated participants are on their way already. Wait until they are through.")
            token = self._tokens.create(
                "Simulated participants", ["simulate"], study=study_id, days=TOKEN_DAYS, user=user
            )
            with self._journal.database.write() as tx:
                audit(tx, user, "send simulated participants", study_id, count=count, seed=seed)
            run = self._run = _Run(study_id, count, seed)
            run.work = self._behind.submit(self._work, run, way, token, user)
            watched(run.work, "simulated participants failed")
        return _told(run)

    def of(self, study_id: str) -> Sending | None:
        """Return how far the last run is, if it went to this study."""
        run = self._run
        return None if run is None or run.study != study_id else _told(run)

    def settle(self) -> None:
        """Wait until the present run is over. For tests and a tidy end."""
        self._behind.submit(lambda: None).result()

    def close(self) -> None:
        """End the present run; who was on the way stays where they are."""
        if self._run is not None and self._run.running:
            self._run.stop()
        self._behind.shutdown(wait=True)

    def _way(self, study_id: str) -> _Way:
        """Return the link that they come by, and the rig and the search that they meet."""
        with self._journal.database.read() as tx:
            study = studies.study(tx, study_id)
            version = studies.latest_version(tx, study_id)
            links = [link.id for link in studies.links(tx, study_id) if link.kind != "personal"]
        if study is None or version is None:
            raise NoStudyError(study_id)
        if study.status not in OPEN:
            raise ConflictError(f"Nobody can join a study that is {study.status}. Start its pilot first.")
        if not links:
            raise ConflictError("This study has no open general link. Make one on the tab Recruit.")
        config = parsed(version)
        rig = self._journal.rig_of(config)
        return _Way(links[0], rig, params_of(rig, config))

    def _work(self, run: _Run, way: _Way, token: str, user: str | None) -> None:
        try:
            asyncio.run(self._sent(run, way, token))
        except asyncio.CancelledError:
            run.problem = "The server was stopped."
        except ServiceError as error:
            run.problem = error.message
        except Exception:
            run.problem = "It failed; the server's log says why."
            raise
        finally:
            self._revoke(token, user)

    async def _sent(self, run: _Run, way: _Way, token: str) -> None:
        assert self._client_of is not None, "create_app says how the interface is reached"
        task, loop = asyncio.current_task(), asyncio.get_running_loop()
        assert task is not None
        run.cancel = lambda: loop.call_soon_threadsafe(task.cancel)
        if run.stopping.is_set():
            raise asyncio.CancelledError
        async with self._client_of() as client:
            simulation = Simulation(client, way.link, token, run.report.seed, way.rig, params=way.params)
            await simulation.run(run.report.participants, run.report)

    def _revoke(self, token: str, user: str | None) -> None:
        with self._journal.database.read() as tx:
            found = rows.api_token(tx, digest(token))
        if found is not None:
            self._tokens.revoke(found.id, user)


def _check(count: int, seed: int) -> None:
    if not 1 <= count <= MOST:
        raise InvalidError(f"Enter a number from 1 to {MOST}.", field="count", expected=f"1 to {MOST}", got=count)
    if not 0 <= seed <= MOST_SEED:
        raise InvalidError(f"Enter a seed from 0 to {MOST_SEED}.", field="seed", expected=f"0 to {MOST_SEED}", got=seed)


def _told(run: _Run) -> Sending:
    report = run.report
    return Sending(run.study, report.participants, report.seed, run.began_at, report.finished, run.running, run.problem)
