"""What a participation needs from the house: the database, the rig, the portraits; and how its rows are found."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

from ...store import runs
from ..clock import digest
from ..config import StudyConfig
from ..config.stored import own_config
from ..errors import NotFoundError
from ..faces.correction import Correction
from ..trials.evolution import Evolution
from ..trials.walk import Walk

if TYPE_CHECKING:
    from emogen_core.face.rig import Rig

    from ...store.engine import Database, Tx
    from ...store.runs_tables import Participation
    from ..faces.portraits import Portraits
    from ..faces.wardrobe import Wardrobe


@dataclass(frozen=True)
class Journal:
    """The tools of every service that works on a participation; `rig` is the bundled one."""

    database: Database
    rig: Rig
    portraits: Portraits
    wardrobe: Wardrobe
    redirect_hosts: tuple[str, ...] = ()

    @cached_property
    def correction(self) -> Correction:
        """The corrective pipeline of the rig."""
        return Correction(self.wardrobe.rig)

    def rig_of(self, config: StudyConfig) -> Rig:
        """Return the rig of a study: that of its heads.

        Raises:
            NotFoundError: it is of a face model that is not here.
        """
        return self.wardrobe.rig_of(config)

    def evolution(self, config: StudyConfig) -> Evolution:
        """Return the search of a study; raises as `rig_of`."""
        self.wardrobe.know(config)
        return Evolution(self.rig_of(config), config, self.correction, self.portraits.key)

    def walk(self, tx: Tx, participation: Participation, config: StudyConfig) -> Walk:
        """Return a participation inside a transaction, ready to go on."""
        return Walk(tx, participation, config, self.evolution(config), self.redirect_hosts)

    def find(self, tx: Tx, token: str, *, lock: bool = False) -> tuple[Participation, StudyConfig]:
        """Return the participation of a token and the study as it was when it began.

        Raises:
            NotFoundError: nobody has this token.
        """
        participation = runs.participation_by_token(tx, digest(token), lock=lock)
        if participation is None:
            raise NotFoundError("This address leads to no participation. Go back to the link you were sent.")
        return participation, own_config(tx, participation)
