"""Fits heads of the bundled space to the rig of this house. It takes seconds a head: see `wardrobe`."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from emogen_core.face.space_file import load_bundled_space
from emogen_core.rigs.wear import fit_head

if TYPE_CHECKING:
    from emogen_core.face.identity import Identity
    from emogen_core.face.rig import Rig
    from emogen_core.face.space import IdentitySpace
    from emogen_core.rendering.worn import WornHead


@dataclass(frozen=True)
class HouseTailor:
    """Fits with the methods that made the presets."""

    rig: Rig

    @property
    def space(self) -> IdentitySpace:
        """The space of heads that comes with the package."""
        return load_bundled_space()

    def fit(self, identity: Identity, *, moving: bool = True) -> WornHead:
        """Return a fitted head; not `moving`, one that can only be drawn at rest, in a third of the time.

        Raises:
            EmogenError: the space was made for another rig, or the identity is no point of it.
        """
        return fit_head(self.rig, self.space, identity, moving=moving)
