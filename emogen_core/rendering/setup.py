"""Which renderer, which rig, which look: the one place where they are put together."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from emogen_core.errors import InvalidInputError, expected
from emogen_core.face.bundled import load_bundled_rig
from emogen_core.face.rig_file import load_rig
from emogen_core.rendering.look import load_look, topology_hash
from emogen_core.rendering.plain import plain_look

if TYPE_CHECKING:
    from emogen_core.face.rig import Rig
    from emogen_core.rendering.look import Look
    from emogen_core.rendering.protocol import Renderer

BACKENDS = ("pyrender", "software")
BUNDLED_LOOK = Path(__file__).parent / "data" / "head.look"


def bundled_look() -> Look:
    """Load the look that comes with the package.

    Raises:
        RigFileError: the file is missing or damaged.
    """
    return load_look(BUNDLED_LOOK)


def look_for(rig: Rig) -> Look:
    """Return the bundled look where it fits a rig, else one in flat colours."""
    if BUNDLED_LOOK.is_file():
        look = bundled_look()
        if topology_hash(rig) == look.topology:
            return look
    return plain_look(rig)


def make_renderer(backend: str, rig: Path | None = None, look: Path | None = None) -> tuple[Renderer, Rig]:
    """Make a renderer in this thread; return it with the rig that it draws.

    Args:
        backend: ``pyrender`` or, only when asked for by name, ``software``.
        rig: rig file; the bundled one by default.
        look: look file; by default the one beside the rig file, with its name and ``.look``, or what `look_for` finds.

    Raises:
        InvalidInputError: unknown backend, or rig and look do not fit.
        MissingGLError: ``pyrender`` on a machine without OpenGL.
        RigFileError: a file is missing or damaged.
    """
    model, worn = load_dressed(rig, look)
    return renderer_for(backend, model, worn), model


def load_dressed(rig: Path | None = None, look: Path | None = None) -> tuple[Rig, Look]:
    """Load a rig and what it wears; see `make_renderer`."""
    model = load_rig(rig) if rig else load_bundled_rig()
    if rig and not look and rig.with_suffix(".look").is_file():
        look = rig.with_suffix(".look")
    return model, load_look(look) if look else look_for(model)


def renderer_for(backend: str, rig: Rig, look: Look, turn: float = 0.0) -> Renderer:
    """Make a renderer for a rig in a look, its heads turned by some degrees; see `make_renderer` and `Surface`."""
    if backend not in BACKENDS:
        raise InvalidInputError(f"backend: {expected(f'one of {BACKENDS}', backend)}")
    if backend == "software":
        from emogen_core.rendering.software import SoftwareRenderer  # noqa: PLC0415

        return SoftwareRenderer(rig, look, turn)
    # Importing the backend opens the GL libraries, which need not be there.
    from emogen_core.rendering.pyrender_backend import PyrenderRenderer  # noqa: PLC0415

    return PyrenderRenderer(rig, look, turn)
