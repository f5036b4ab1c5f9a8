"""The rig on which an export was recorded, for commands that work without a database."""

from __future__ import annotations

from contextlib import contextmanager
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from emogen_core.errors import InvalidInputError, expected
from emogen_core.face.bundled import load_bundled_rig
from emogen_core.rendering.pool import RenderPool

from ..services.faces.drawing import NoDrawer, PoolDrawer
from ..services.faces.face_model import FileModels, file_model, model_named
from ..services.faces.kept_heads import FileHeads
from ..services.faces.model_drawers import ModelDrawers
from ..services.faces.tailor import HouseTailor
from ..services.faces.wardrobe import Wardrobe

if TYPE_CHECKING:
    from collections.abc import Iterator

    from emogen_client import Export
    from emogen_core.face.rig import Rig

    from ..services.faces.face_model import FaceModel
    from ..services.faces.portraits import PortraitDrawer

BACKEND = "pyrender"
RigFile = Annotated[
    Path | None,
    typer.Option(
        "--rig", help="Rig file of the study's heads where they are not the bundled ones; its look beside it."
    ),
]


@dataclass(frozen=True)
class Wearing:
    """What an export was recorded on.

    Attributes:
        rig: the one of its heads.
        wardrobe: has the heads.
        models: the face model of the file that was named; none for the bundled one.
    """

    rig: Rig
    wardrobe: Wardrobe
    models: FileModels

    @contextmanager
    def drawer(self) -> Iterator[PortraitDrawer]:
        """Start what draws its faces."""
        drawer = self._foreign() if self.models.models else PoolDrawer(RenderPool(backend=BACKEND))
        try:
            yield drawer
        finally:
            drawer.close()

    def _foreign(self) -> PortraitDrawer:
        return ModelDrawers(NoDrawer("", "", BACKEND), self.models, BACKEND, _started)


@contextmanager
def worn(export: Export, file: Path | None) -> Iterator[Wearing]:
    """Open the rig on which an export was recorded.

    Args:
        export: tells what its heads are called.
        file: of their rig; the bundled one if it is not named.

    Raises:
        InvalidInputError, RigFileError: the file is none, or the export is of the bundled heads.
        EmogenClientError: the export has no configurations.
    """
    rig, models = load_bundled_rig(), FileModels()
    if file is not None:
        model = file_model(_name(export), file)
        rig, models = model.rig, FileModels({model.name: model})
    bundled = load_bundled_rig()
    kept = FileHeads(partial(_file, export))
    wardrobe = Wardrobe(HouseTailor(bundled), models=models, kept=kept)
    try:
        yield Wearing(rig, wardrobe, models)
    finally:
        wardrobe.close()


def _name(export: Export) -> str:
    versions = [one["config"].get("identities", ()) for one in export.configurations()]
    heads = [head for heads in versions for head in heads]
    name = model_named(heads)
    if not name:
        bundled = [head for head in heads if isinstance(head, str)] or "documents of the bundled one"
        raise InvalidInputError(f"--rig: {expected('an export with heads called MODEL:HEAD', bundled)}; leave it out")
    return name


def _file(export: Export, name: str) -> bytes | None:
    path = next((path for path in export.paths if path in {name, f"materials/{name}"}), None)
    return None if path is None else export.read(path)


def _started(model: FaceModel) -> PoolDrawer:
    rig, look = model.files
    return PoolDrawer(RenderPool(backend=BACKEND, rig=rig, look=look))
