"""After an update of the look: the faces that people have before them get the addresses of their new pictures.

A portrait's address stands for its pixels for ever, so a picture of the new look cannot be served under the old one.
A mark in the database says which look, drawn by what, the addresses are of: while it holds, a start costs one query.
Each participation is renewed in a transaction of its own, so that nobody waits for all of them.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from emogen_core.rendering.protocol import RenderSettings

from ...store import keys, runs
from ..clock import now
from ..config.stored import own_config
from ..faces.sketch import settings_of, unpack_weights

if TYPE_CHECKING:
    from ...store.engine import Tx
    from .journal import Journal

MARK = "look"


def renew_portraits(journal: Journal) -> int:
    """Give the faces on the screens of running participations the keys of the present look; return how many changed."""
    look = _look(journal)
    with journal.database.read() as tx:
        if keys.known(tx, MARK) == look:
            return 0
        running = runs.running_with(tx, journal.wardrobe.rig_hashes)
    changed = 0
    for participation_id in running:
        with journal.database.write() as tx:
            changed += _renew(journal, tx, participation_id)
    with journal.database.write() as tx:
        keys.remember(tx, MARK, look, now())
    return changed


def _look(journal: Journal) -> str:
    """Return what tells looks apart: the address of the face at rest covers rig, look and what draws it."""
    rig = journal.rig
    return journal.portraits.key(rig.identities[0], np.zeros(len(rig.shape_names), np.float32), RenderSettings())


def _renew(journal: Journal, tx: Tx, participation_id: str) -> int:
    participation = runs.participation(tx, participation_id, lock=True)
    if participation is None or participation.outcome is not None:
        return 0
    changed = 0
    settings = settings_of(own_config(tx, participation))
    for face in runs.faces_in_view(tx, participation):
        key = journal.portraits.key(face.identity, unpack_weights(face.weights), settings)
        changed += key != face.portrait_key
        face.portrait_key = key
    return changed
