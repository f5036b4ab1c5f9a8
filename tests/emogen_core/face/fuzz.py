"""Damage a small rig file thousands of times and count what happens: `python -m tests.emogen_core.face.fuzz 6000`."""

import random
import sys
import tempfile
from collections import Counter
from pathlib import Path

import numpy as np

from emogen_core.correctives.pipeline import face_weights
from emogen_core.errors import RigFileError
from emogen_core.face.evaluate import vertices
from emogen_core.face.rig_file import load_rig, save_rig
from tests.emogen_core.face.damage import damaged_bytes, damaged_content
from tests.rig_factory import full_rig


def outcome(path, whole_hash):
    """Refused in one line, harmless, or another sound rig; anything else raises."""
    try:
        rig = load_rig(path)
    except RigFileError as error:
        assert "expected" in str(error)
        assert "\n" not in str(error)
        return "refused"
    if rig.hash == whole_hash:
        return "harmless"
    for identity in rig.identities:
        weights = face_weights(rig, identity, np.full((1, len(rig.genes)), 0.5)).weights
        assert np.isfinite(vertices(rig, identity, weights)).all()
    return "another sound rig"


def fuzz(folder, seeds):
    """Count the outcomes of bytes damaged with odd seeds, content with even ones."""
    whole = save_rig(full_rig(), folder / "whole.rig")
    found = Counter()
    for seed in seeds:
        damage = damaged_bytes if seed % 2 else damaged_content
        damage(folder / "whole.rig", folder / "bad.rig", random.Random(seed))
        found[outcome(folder / "bad.rig", whole.hash)] += 1
    return found


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as place:
        print(dict(fuzz(Path(place), range(int(sys.argv[1])))))
