"""Face models that were brought to this server, beside the bundled one: a lab's own head, the public ICT-FaceKit.

Their files stand in the database; each process puts them into its data folder once, where drawing processes read them.
"""

from __future__ import annotations

import json
import threading
from dataclasses import dataclass, field
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING

from emogen_core.errors import EmogenError
from emogen_core.face.model_identity import LONGEST_MODEL, MARK, is_model_name
from emogen_core.face.modes import load_modes
from emogen_core.face.rig_file import load_rig
from emogen_core.rendering.look import load_look

from ...store import models, runs, studies
from ...store.models_tables import FaceModelRecord
from ..clock import now
from ..errors import ConflictError, InvalidError, NotFoundError
from ..people.accounts import audit
from .face_model import FaceModel, called, unknown_model

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from emogen_core.face.rig import Rig
    from emogen_core.rendering.look import Look

    from ...store.engine import Database, Tx

MOST_BYTES = 24 * 2**20
"""Of each of the files."""


@dataclass(frozen=True)
class FaceModels:
    """Keeps the face models of a server."""

    database: Database
    folder: Path
    _loaded: dict[str, FaceModel] = field(default_factory=dict)
    _lock: threading.Lock = field(default_factory=threading.Lock)

    def all(self) -> Sequence[FaceModelRecord]:
        """Return what is known of every face model, by name."""
        with self.database.read() as tx:
            return models.all_models(tx)

    @property
    def hashes(self) -> tuple[str, ...]:
        """The hashes of their rigs."""
        return tuple(row.rig_hash for row in self.all())

    def check_name(self, name: str) -> None:
        """Refuse a name that a new face model cannot have.

        Raises:
            InvalidError: it is none.
            ConflictError: there is another one of this name.
        """
        _check_name(name)
        with self.database.read() as tx:
            _check_free(tx, name)

    def add(  # noqa: PLR0913 - a file each
        self,
        name: str,
        rig: bytes,
        look: bytes,
        user: str | None = None,
        findings: Mapping[str, Sequence[str]] | None = None,
        *,
        modes: bytes | None = None,
    ) -> FaceModelRecord:
        """Keep a face model, once its files are known to be whole and to fit each other.

        Args:
            name: what its heads are called by.
            rig: the rig file.
            look: the look file.
            user: who brings it.
            findings: what an import found, guessed and missed, a sentence each.
            modes: the file of its identity modes, where it has any.

        Raises:
            InvalidError: no name for a face model, or files that are none or do not fit.
            ConflictError: there is another one of this name, or this one under another name.
        """
        _check_name(name)
        for what, content in {"rig": rig, "look": look, **({} if modes is None else {"modes": modes})}.items():
            _check_size(what, content)
        with TemporaryDirectory(prefix="emogen-model-") as place:
            model, worn = _read(Path(place), rig, look)
            sliders = [] if modes is None else _sliders(Path(place), modes, model)
        row = FaceModelRecord(
            name=name, rig_hash=model.hash, look_hash=worn.hash, heads=list(model.identities),
            emotions=list(model.emotion_sets), counts=_counts(model), findings=dict(findings or {}), added_by=user,
            added_at=now(), rig=rig, look=look, sliders=sliders, modes=modes,
        )  # fmt: skip
        with self.database.write() as tx:
            _check_new(tx, name, model.hash)
            runs.add(tx, row)
            audit(tx, user, "add face model", name, rig=model.hash)
        return row

    def remove(self, name: str, user: str | None = None) -> None:
        """Forget a face model that no study has.

        Raises:
            NotFoundError: there is none of this name.
            ConflictError: a study has it.
        """
        with self.database.write() as tx:
            if models.model(tx, name) is None:
                raise NotFoundError("There is no such face model.", field="name", got=name)
            using = [study.title for study in studies.all_studies(tx) if _has(tx, study.id, name)]
            if using:
                raise ConflictError(f"The study {using[0]} has heads of {name}. Delete the study first.", field="name")
            models.remove(tx, name)
            audit(tx, user, "remove face model", name)
        with self._lock:
            self._loaded.pop(name, None)

    def of(self, identity: str) -> FaceModel | None:
        """Return the face model of a head; nothing for a head of the bundled one.

        Raises:
            NotFoundError: the head is of a face model that is not here.
        """
        name, mark, _ = identity.partition(MARK)
        if not mark:
            return None
        with self._lock:
            if name not in self._loaded:
                self._loaded[name] = self._load(name)
            return self._loaded[name]

    def _load(self, name: str) -> FaceModel:
        with self.database.read() as tx:
            row = models.model(tx, name)
        if row is None:
            raise unknown_model(name)
        paths = [
            self.folder / f"{row.rig_hash}.{ending}" for ending in ("rig", "look", *(["modes"] * bool(row.sliders)))
        ]
        if not all(path.is_file() for path in paths):
            self._put(name, paths)
        rig, look, *modes = paths
        return FaceModel(name, called(name, load_rig(rig)), row.look_hash, (rig, look), next(iter(modes), None))

    def _put(self, name: str, paths: Sequence[Path]) -> None:
        with self.database.read() as tx:
            contents = models.files(tx, name)
        if contents is None:
            raise unknown_model(name)
        self.folder.mkdir(parents=True, exist_ok=True)
        for path, content in zip(paths, filter(None, contents), strict=True):
            part = path.with_suffix(f"{path.suffix}.{threading.get_ident()}.part")
            part.write_bytes(content)
            part.replace(path)


def _read(folder: Path, rig: bytes, look: bytes) -> tuple[Rig, Look]:
    paths = folder / "head.rig", folder / "head.look"
    for path, content in zip(paths, (rig, look), strict=True):
        path.write_bytes(content)
    try:
        model = load_rig(paths[0])
    except EmogenError as error:
        raise _refused("rig", "a rig file of emogen rig import", error) from error
    try:
        worn = load_look(paths[1])
        worn.check(model)
    except EmogenError as error:
        raise _refused("look", "the look file beside it", error) from error
    return model, worn


def _sliders(folder: Path, content: bytes, rig: Rig) -> list[str]:
    path = folder / "head.modes"
    path.write_bytes(content)
    try:
        space = load_modes(path)
        space.check_rig(rig)
    except EmogenError as error:
        raise _refused("modes", "the file of modes beside it", error) from error
    return list(space.modes)


def _refused(field: str, expected: str, error: EmogenError) -> InvalidError:
    told = str(error)
    for name in ("head.rig", "head.look", "head.modes"):
        told = told.replace(name, "the file")
    return InvalidError(f"The {field} cannot be used: {told}.", field=field, expected=expected, got=told)


def _counts(rig: Rig) -> dict[str, int]:
    return {"genes": len(rig.genes), "shapes": len(rig.shape_names), "vertices": rig.offsets.shape[1]}


def _check_name(name: str) -> None:
    if not is_model_name(name):
        wanted = f"1 to {LONGEST_MODEL} small letters, digits and single hyphens"
        raise InvalidError("Give the face model a short name.", field="name", expected=wanted, got=name)


def _check_size(what: str, content: bytes) -> None:
    if not content or len(content) > MOST_BYTES:
        wanted = f"a file of at most {MOST_BYTES // 2**20} MiB"
        raise InvalidError(f"Choose the {what} file.", field=what, expected=wanted, got=f"{len(content)} bytes")


def _check_free(tx: Tx, name: str) -> None:
    if models.model(tx, name) is not None:
        raise ConflictError("There is a face model of this name. Choose another one.", field="name", got=name)


def _check_new(tx: Tx, name: str, rig_hash: str) -> None:
    _check_free(tx, name)
    same = models.with_rig(tx, rig_hash)
    if same is not None:
        raise ConflictError(f"This face model is here already: {same.name}.", field="rig", got=rig_hash)


def _has(tx: Tx, study_id: str, name: str) -> bool:
    """Whether a study has a head of a model, in any version and condition."""
    plain = [json.dumps(version.config) for version in studies.versions(tx, study_id)]
    return any(f'"{name}{MARK}' in text or f'"model": "{name}"' in text for text in plain)
