"""After an update of the look: the faces that people have before them get the addresses of their new pictures.

A portrait's address stands for its pixels for ever, so a picture of the new look cannot be served under the old one.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..store import runs
from .evolution import settings_of, unpack_weights
from .journal import config_of

if TYPE_CHECKING:
    from .journal import Journal


def renew_portraits(journal: Journal) -> int:
    """Give the faces on the screens of running participations the keys of the present look; return how many changed."""
    changed = 0
    with journal.database.write() as tx:
        for participation in runs.running_with(tx, journal.rig.hash):
            settings = settings_of(config_of(tx, participation.version_id))
            for face in runs.faces_in_view(tx, participation):
                key = journal.portraits.key(face.identity, unpack_weights(face.weights), settings)
                changed += key != face.portrait_key
                face.portrait_key = key
    return changed
