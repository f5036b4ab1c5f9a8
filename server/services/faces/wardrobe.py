"""The heads that studies bring along: identity documents in, fitted heads out.

A study's configuration holds the documents, so every process that reads a study can make its heads. Fitting takes
seconds and happens outside of any transaction, one head at a time: ahead when a study is made or the server starts,
at once for whoever waits for a head that is not ready. `rig` and `head` never wait: a transaction may use them.
"""

from __future__ import annotations

import threading
from collections import OrderedDict
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Protocol, TypeVar

from emogen_core.errors import EmogenError
from emogen_core.face.identity import read_identity, require_adult, signed_document
from emogen_core.face.model_identity import is_of_model
from emogen_core.rendering.worn import WornHead, worn_rig

from ..background import watched
from ..errors import ConflictError, UnavailableError
from .face_model import FileModels
from .kept_heads import NothingKept
from .model_heads import ModelHeads
from .refusal import refusal

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping

    from emogen_core.face.identity import Identity
    from emogen_core.face.rig import Rig
    from emogen_core.face.space import IdentitySpace

    from ..config import StudyConfig
    from .face_model import Models
    from .kept_heads import Kept

Made = TypeVar("Made")
LIMIT = 24
"""Fitted heads that one process keeps, some 6 MB each; documents are small and all kept: any head can be made again."""
AGAIN = 5
"""Seconds after which whoever found a head not ready may come again."""


class Tailor(Protocol):
    """What fits heads: the methods of the rig's builder, or a quick fake in tests."""

    @property
    def rig(self) -> Rig:
        """The rig that heads are fitted to."""
        ...

    @property
    def space(self) -> IdentitySpace:
        """The space of heads."""
        ...

    def fit(self, identity: Identity, *, moving: bool = True) -> WornHead:
        """Return a fitted head."""
        ...


@dataclass
class _Peg:
    """One head of a study, and what became of it."""

    name: str
    document: Mapping[str, Any]
    head: WornHead | None = None
    rig: Rig | None = None
    problem: str = ""

    @property
    def done(self) -> bool:
        return self.head is not None or bool(self.problem)


class Wardrobe:
    """The rig of the house, and what it wears besides its own heads. Safe to use from several threads."""

    def __init__(
        self,
        tailor: Tailor,
        patience: float = 20.0,
        limit: int = LIMIT,
        models: Models | None = None,
        kept: Kept | None = None,
    ) -> None:
        """Have `limit` heads at hand; whoever waits for one waits `patience` seconds at most for its turn.

        Args:
            tailor: fits heads to the bundled rig.
            patience: in seconds.
            limit: of heads at hand.
            models: the other face models.
            kept: has heads that were fitted before, and keeps those that are fitted now.
        """
        self._rig, self._tailor, self._patience, self._limit = tailor.rig, tailor, patience, limit
        self._models: Models = models or FileModels()
        self._of_models = ModelHeads(self._models)
        self._kept: Kept = kept or NothingKept()
        self._pegs: OrderedDict[str, _Peg] = OrderedDict()
        self._lock = threading.Lock()
        self._needle = threading.Lock()
        self._ahead = ThreadPoolExecutor(1, thread_name_prefix="heads-ahead")
        self._closed = False

    @property
    def space(self) -> IdentitySpace:
        """The space of heads."""
        return self._tailor.space

    def read(self, document: object, where: str = "identity", *, children: bool = True) -> Identity:
        """Return what a document describes.

        Raises:
            InvalidError: names the field, what was expected and what was got.
        """
        try:
            identity = read_identity(document, self.space)
            if not children:
                require_adult(identity, self.space)
        except EmogenError as error:
            raise refusal(where, error) from error
        return identity

    def frozen(self, config: StudyConfig) -> StudyConfig:
        """Return a study whose documents are checked, canonical and signed with their hashes.

        Raises:
            InvalidError: one is not a document, or a child's where the study does not allow children's heads.
        """
        conditions = []
        for condition in config.conditions:
            changes = dict(condition.changes)
            if "identities" in changes:
                own = config.in_condition(condition.name)
                changes["identities"] = list(self._signed(own, f"conditions.{condition.name}.changes."))
            conditions.append(condition.model_copy(update={"changes": changes}))
        signed = {"identities": self._signed(config), "conditions": tuple(conditions)}
        return config.model_copy(update=signed)

    def _signed(self, config: StudyConfig, where: str = "") -> tuple[str | dict[str, Any], ...]:
        heads: list[str | dict[str, Any]] = []
        for place, head in enumerate(config.identities):
            if isinstance(head, str):
                heads.append(head)
            else:
                heads.append(self.signed(head, f"{where}identities.{place}", children=config.children))
        return tuple(heads)

    def signed(self, document: Mapping[str, Any], where: str = "identity", *, children: bool = True) -> dict[str, Any]:
        """Return a document of either kind in its canonical form with its hashes; raises `InvalidError` as `read`."""
        if is_of_model(document):
            return self._of_models.signed(document, where)
        return signed_document(self.read(document, where, children=children), self.space)

    def know(self, config: StudyConfig) -> None:
        """Remember which documents a study has; nothing is fitted."""
        with self._lock:
            for name, document in config.documents.items():
                self._pegs.setdefault(name, _Peg(name, document))

    def prepare(self, config: StudyConfig) -> None:
        """Have the heads of a study fitted in the background."""
        for own in config.whole:
            self.know(own)
            for name in own.documents:
                watched(self._ahead.submit(self._fit_ahead, name), "a head could not be fitted ahead")

    def wait(self, identity: str) -> None:
        """Return when a head can be worn: at once for the rig's own, else fitted here and now if need be.

        Raises:
            UnavailableError: others are being fitted for longer than anybody should wait.
            ConflictError: this head cannot be fitted.
        """
        peg = self._peg(identity)
        if peg is None:
            return
        if not peg.done:
            self._fit(peg)
        if peg.problem:
            raise ConflictError(f"A head of this study cannot be used: {peg.problem}.", field="identities")

    def rig(self, identity: str) -> Rig:
        """Return a rig that wears a head.

        Raises:
            UnavailableError: it is not ready; `wait` makes it so.
            NotFoundError: it is of a face model that is not here.
        """
        peg = self._peg(identity)
        if peg is not None:
            return _there(peg.rig)
        return self._base(identity)

    def rig_hash(self, identity: str) -> str:
        """Return the hash of the rig that a head is of, fitted or not; raises `NotFoundError` as `rig`."""
        return self._base(identity).hash

    @property
    def rig_hashes(self) -> tuple[str, ...]:
        """The hashes of all rigs of this server, the bundled one first."""
        return (self._rig.hash, *self._models.hashes)

    def rig_of(self, config: StudyConfig) -> Rig:
        """Return the rig of a study whose documents are signed: that of its first head, before any document is worn.

        Raises:
            NotFoundError: it is of a face model that is not here.
        """
        return self._base(config.heads[0])

    def head(self, identity: str) -> WornHead | None:
        """Return a head as drawing processes need it, none for those that they have; raises as `rig`."""
        peg = self._peg(identity)
        return None if peg is None else _there(peg.head)

    def ready(self, identity: str) -> tuple[WornHead, Rig] | None:
        """Return a head of a study and the rig that wears it if it has been fitted already."""
        peg = self._peg(identity)
        head, rig = (peg.head, peg.rig) if peg else (None, None)
        return (head, rig) if head and rig else None

    def try_on(self, identity: Identity, wanted: Callable[[], None], *, moving: bool) -> WornHead:
        """Return a head that no study has, fitted now and not kept.

        Args:
            identity: the head and its look.
            wanted: called when its turn has come; raises where nobody waits for it any more.
            moving: whether it has to do more than rest.

        Raises:
            InvalidError: it cannot be fitted.
            UnavailableError: others are being fitted for longer than anybody should wait.
        """
        with self._alone(wanted):
            return self._tailor.fit(identity, moving=moving)

    def anew(self, document: Mapping[str, Any], wanted: Callable[[], None] = lambda: None) -> tuple[WornHead, Rig]:
        """Return the head of a signed document as this process makes it now, kept or not, and a rig that wears it.

        Args:
            document: of either kind.
            wanted: as `try_on`.

        Raises:
            InvalidError: it cannot be made.
            UnavailableError: others are being fitted for longer than anybody should wait.
        """
        with self._alone(wanted):
            head = self._made(document)
        return head, worn_rig(self._base(head.name), head)

    def close(self) -> None:
        """Stop fitting."""
        self._closed = True
        self._ahead.shutdown(wait=True, cancel_futures=True)

    def _peg(self, identity: str) -> _Peg | None:
        with self._lock:
            peg = self._pegs.get(identity)
            if peg is not None:
                self._pegs.move_to_end(identity)
            return peg

    def _fit(self, peg: _Peg) -> None:
        with _turn(self._needle, self._patience):
            if peg.done:
                return
            try:
                head = self._fitted(peg)
            except EmogenError as error:
                peg.problem = str(error)
                return
            peg.rig, peg.head = worn_rig(self._base(peg.name), head), head
        with self._lock:
            for old in [one for one in self._pegs.values() if one.head is not None][: -self._limit]:
                old.rig = old.head = None

    @contextmanager
    def _alone(self, wanted: Callable[[], None]) -> Iterator[None]:
        """Wait for the turn of a head that is made for somebody who looks at it, and say what is wrong with it."""
        with _turn(self._needle, self._patience):
            wanted()
            try:
                yield
            except EmogenError as error:
                raise refusal("identity", error) from error

    def _fitted(self, peg: _Peg) -> WornHead:
        """Return the head as it was fitted once, here or wherever the data comes from; else fit and keep it."""
        rig = self._base(peg.name)
        return self._kept.head(peg.name, rig) or self._kept.keep(self._made(peg.document), rig)

    def _made(self, document: Mapping[str, Any]) -> WornHead:
        if is_of_model(document):
            return self._of_models.fit(document)
        return self._tailor.fit(read_identity(document, self.space))

    def _base(self, identity: str) -> Rig:
        """Return the rig that a head is of, which need not wear it yet; raises `NotFoundError` as `rig`."""
        model = self._models.of(identity)
        return self._rig if model is None else model.rig

    def _fit_ahead(self, name: str) -> None:
        peg = self._peg(name)
        while peg is not None and not peg.done and not self._closed:
            try:
                self._fit(peg)
            except UnavailableError:
                continue


def _there(made: Made | None) -> Made:
    if made is None:
        raise UnavailableError("A head of this study is still being made. Try again in a few seconds.", AGAIN)
    return made


@contextmanager
def _turn(lock: threading.Lock, seconds: float) -> Iterator[None]:
    """Hold a lock that is waited for so long and no longer."""
    if not lock.acquire(timeout=seconds):
        raise UnavailableError("Other heads are being made. Try again in a few seconds.", AGAIN)
    try:
        yield
    finally:
        lock.release()
