"""What a face model is, and how its heads are called.

A head of a face model that is not the bundled one is called MODEL:HEAD everywhere: in a study's identities, in the
data, on pages. So a study's face model is the one that its heads are of, and whoever has the name of a head knows
what to draw it with.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any, Protocol, TypeVar

from emogen_core.face.model_identity import MARK
from emogen_core.face.modes import ENDING, load_modes
from emogen_core.face.rig_file import load_rig
from emogen_core.rendering.look import load_look

from ..errors import NotFoundError

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, Sequence
    from pathlib import Path

    from emogen_core.face.modes import ModeSpace
    from emogen_core.face.rig import Rig
    from emogen_core.rendering.worn import WornHead

T = TypeVar("T")


@dataclass(frozen=True, eq=False)
class FaceModel:
    """A face model that is not the bundled one.

    Attributes:
        name: what its heads are called by.
        rig: wears its heads under their whole names, MODEL:HEAD.
        look_hash: of its look.
        files: of rig and look, for drawing processes; there the heads have their own names.
        modes_file: of its identity modes, where it has any.
    """

    name: str
    rig: Rig
    look_hash: str
    files: tuple[Path, Path]
    modes_file: Path | None = None

    @cached_property
    def modes(self) -> ModeSpace | None:
        """Its identity modes, read when they are first asked for.

        Raises:
            RigFileError: the file is damaged, or of another rig.
        """
        if self.modes_file is None:
            return None
        space = load_modes(self.modes_file)
        space.check_rig(self.rig)
        return space


class Models(Protocol):
    """What knows face models by the names of their heads: those of a server, or those whose files somebody names."""

    def of(self, identity: str) -> FaceModel | None:
        """Return the face model of a head; nothing for a head of the bundled one.

        Raises:
            NotFoundError: the head is of a face model that is not here.
        """
        ...

    @property
    def hashes(self) -> tuple[str, ...]:
        """The hashes of their rigs."""
        ...


@dataclass(frozen=True)
class FileModels:
    """Face models of files, for commands that work without a database."""

    models: Mapping[str, FaceModel] = field(default_factory=dict)

    def of(self, identity: str) -> FaceModel | None:
        """Return the face model of a head."""
        name, mark, _ = identity.partition(MARK)
        if mark and name not in self.models:
            raise unknown_model(name)
        return self.models[name] if mark else None

    @property
    def hashes(self) -> tuple[str, ...]:
        """The hashes of their rigs."""
        return tuple(model.rig.hash for model in self.models.values())


def file_model(name: str, rig: Path) -> FaceModel:
    """Return the face model of a rig file and of the look file beside it, as `emogen rig import` writes them.

    Raises:
        RigFileError, InvalidInputError: a file is missing or damaged, or they do not fit each other.
    """
    look, modes = rig.with_suffix(".look"), rig.with_suffix(ENDING)
    model, worn = load_rig(rig), load_look(look)
    worn.check(model)
    return FaceModel(name, called(name, model), worn.hash, (rig, look), modes if modes.is_file() else None)


def name_of(heads: Iterable[str]) -> str:
    """Return the name of the face model of some heads; empty for the bundled one."""
    return next((head.partition(MARK)[0] for head in heads if MARK in head), "")


def model_named(heads: Sequence[str | Mapping[str, Any]]) -> str:
    """Return the face model that names or documents of heads are of; empty for the bundled one."""
    named = (head.partition(MARK)[0] if MARK in head else "" for head in heads if isinstance(head, str))
    written = (str(head.get("model", "")) for head in heads if not isinstance(head, str))
    return next(filter(None, (*named, *written)), "")


def own_name(identity: str) -> str:
    """Return what a head is called in the files of its model."""
    return identity.rpartition(MARK)[2]


def own_head(head: WornHead) -> WornHead:
    """Return a head as the files of its model call it."""
    return replace(head, name=own_name(head.name), like=own_name(head.like))


def called(name: str, rig: Rig) -> Rig:
    """Return a rig whose heads have their whole names, MODEL:HEAD."""

    def whole(values: dict[str, T]) -> dict[str, T]:
        return {f"{name}{MARK}{head}": value for head, value in values.items()}

    return replace(rig, neutrals=whole(dict(rig.neutrals)), adjustments=whole(dict(rig.adjustments)))


def unknown_model(name: str) -> NotFoundError:
    """Return the error of a head whose face model is not here."""
    told = f"The face model {name} is not here. Add it to the server, or name its rig file to the command with --rig."
    return NotFoundError(told, field="identities", got=name)
