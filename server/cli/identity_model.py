"""Heads of a face model's identity modes for `emogen identity`: a rig file, what lies beside it, and documents."""

from __future__ import annotations

from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from emogen_core.errors import InvalidInputError, expected
from emogen_core.face.identity import DOCUMENT_BYTES, parsed_document
from emogen_core.face.model_identity import model_document, read_model_identity
from emogen_core.face.modes import ENDING, PLAUSIBLE, load_modes
from emogen_core.face.rig_file import load_rig

if TYPE_CHECKING:
    from emogen_core.face.model_identity import ModelIdentity
    from emogen_core.face.modes import ModeSpace
    from emogen_core.face.rig import Rig

RigFile = Annotated[
    Path | None, typer.Option("--rig", help="Rig file of emogen rig import, for a head of its identity modes.")
]


@dataclass(frozen=True)
class ModelFiles:
    """A rig, and the identity modes that lie beside it.

    Attributes:
        path: of the rig file.
        rig: as it was imported.
        space: its modes.
    """

    path: Path
    rig: Rig
    space: ModeSpace

    def listed(self) -> dict[str, Any]:
        """Return the rig's own heads and its modes."""
        modes = [
            {"name": name, "region": "head", "low": -PLAUSIBLE, "high": PLAUSIBLE, "default": 0.0, "meaning": ""}
            for name in self.space.modes
        ]
        return {"presets": list(self.rig.identities), "parameters": modes}

    def read(self, file: Path) -> ModelIdentity:
        """Return the head of a document's file."""
        try:
            with file.open("rb") as opened:
                content = opened.read(DOCUMENT_BYTES + 1)
        except OSError as error:
            raise InvalidInputError(f"{file}: {expected('a document of a head', error.strerror)}") from error
        return read_model_identity(parsed_document(content), self.space)

    def signed(self, identity: ModelIdentity) -> dict[str, Any]:
        """Return the document of a head with its hashes."""
        return model_document(identity, self.space)

    def measured(self, identity: ModelIdentity) -> dict[str, Any]:
        """Return how far a head lies from the first one, and whether its mouth rests."""
        head = import_module("emogen_core.rigs.imported.wear").wear_modes(self.rig, self.space, identity)
        worn = import_module("emogen_core.rendering.worn").worn_rig(self.rig, head)
        rest = import_module("numpy").zeros((1, len(self.rig.genes)))
        found = import_module("emogen_core.correctives.pipeline").face_weights(worn, head.name, rest).collisions
        steps = head.neutral - self.rig.neutral(self.rig.identities[0])
        lengths = (steps**2).sum(1) ** 0.5
        return {
            "known_as": head.name,
            "moved_mm": {"mean": round(float(lengths.mean()), 2), "most": round(float(lengths.max()), 2)},
            "collides_at_rest": None if found is None else bool(found.collided.any()),
        }

    def picture(self, identity: ModelIdentity, size: tuple[int, int], backend: str, emotion: str = "") -> bytes:
        """Return the PNG of a head at rest, or in an emotion of its rig."""
        head = import_module("emogen_core.rigs.imported.wear").wear_modes(self.rig, self.space, identity)
        setup, worn = import_module("emogen_core.rendering.setup"), import_module("emogen_core.rendering.worn")
        settings = import_module("emogen_core.rendering.protocol").RenderSettings(*size)
        renderer, rig = setup.make_renderer(backend, self.path)
        genes = rig.emotion_genes(emotion) if emotion else import_module("numpy").zeros(len(rig.genes))
        pipeline = import_module("emogen_core.correctives.pipeline")
        weights = pipeline.face_weights(worn.worn_rig(rig, head), head.name, genes[None]).weights
        renderer.wear(head)
        pixels = renderer.draw(head.name, weights, settings)[0]
        renderer.close()
        encoded: bytes = import_module("emogen_core.rendering.png").encode_png(pixels)
        return encoded


def model_files(path: Path) -> ModelFiles:
    """Open a rig file and the modes beside it.

    Raises:
        RigFileError: a file is missing or damaged, or they do not belong together.
    """
    modes = path.with_suffix(ENDING)
    rig = load_rig(path)
    if not modes.is_file():
        wanted = f"{modes.name} beside it, as emogen rig import writes it for a source with identity modes"
        raise InvalidInputError(f"{path.name}: {expected(wanted, 'no such file')}")
    space = load_modes(modes)
    space.check_rig(rig)
    return ModelFiles(path, rig, space)
