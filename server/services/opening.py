"""Opens the house on the bundled rig, with what draws for it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from emogen_core.face.bundled import load_bundled_rig
from emogen_core.rendering.pool import RenderPool
from emogen_core.rendering.setup import look_for

from .faces.drawing import NoDrawer, PoolDrawer
from .house import House, build_house

if TYPE_CHECKING:
    from ..settings import Settings
    from .faces.face_model import FaceModel
    from .faces.model_drawers import DrawerOf


def _drawer_of(settings: Settings) -> DrawerOf:
    """Return what starts the drawing processes of another face model."""

    def started(model: FaceModel) -> PoolDrawer:
        rig, look = model.files
        return PoolDrawer(RenderPool(settings.render_workers or None, settings.renderer, rig=rig, look=look))

    return started


def open_house(settings: Settings, *, drawing: bool = True) -> House:
    """Return all services on the bundled rig, with drawing processes running unless told otherwise.

    Raises:
        EmogenError: this machine cannot draw, or the rig is damaged; one sentence says what to do.
    """
    rig = load_bundled_rig()
    if not drawing:
        return build_house(settings, rig, NoDrawer(rig.hash, look_for(rig).hash, settings.renderer))
    pool = RenderPool(settings.render_workers or None, settings.renderer)
    try:
        return build_house(settings, rig, PoolDrawer(pool), drawer_of=_drawer_of(settings))
    except BaseException:
        pool.close()
        raise
