"""Damage a small rig and a small space file thousands of times: `python -m tests.emogen_core.face.fuzz 6000`."""

import random
import sys
import tempfile
from collections import Counter
from contextlib import suppress
from pathlib import Path

import numpy as np

from emogen_core.correctives.pipeline import face_weights
from emogen_core.errors import InvalidInputError, RigFileError
from emogen_core.face import rig_file, space_file
from emogen_core.face.evaluate import vertices
from tests.emogen_core.face.damage import damaged_bytes, damaged_content
from tests.rig_factory import full_rig
from tests.space_factory import small_space


def faces(rig):
    """The faces of every head with all genes half-way."""
    for identity in rig.identities:
        yield vertices(rig, identity, face_weights(rig, identity, np.full((1, len(rig.genes)), 0.5)).weights)


def heads(space):
    """The heads at the ends of all ranges, as far as they are heads."""
    middle = {name: known.default for name, known in space.ranges.items()}
    for name, known in space.ranges.items():
        for value in (known.low, known.high):
            with suppress(InvalidInputError):
                yield space.head({**middle, name: value})[0]


# What makes a file, reads it, and uses what was read.
RIGS = rig_file, lambda path: rig_file.save_rig(full_rig(), path), rig_file.load_rig, faces
SPACES = space_file, lambda path: space_file.save_space(small_space(), path), space_file.load_space, heads


def outcome(path, whole_hash, load, use):
    """Refused in one line, harmless, or sound in another way; anything else raises."""
    try:
        found = load(path)
    except RigFileError as error:
        assert "expected" in str(error)
        assert "\n" not in str(error)
        return "refused"
    if found.hash == whole_hash:
        return "harmless"
    assert all(np.isfinite(mesh).all() for mesh in use(found))
    return "sound in another way"


def fuzz(folder, seeds, kind=RIGS):
    """Count the outcomes of bytes damaged with odd seeds, content with even ones."""
    module, save, load, use = kind
    good, bad = folder / "whole", folder / "bad"
    whole = save(good)
    found = Counter()
    for seed in seeds:
        if seed % 2:
            damaged_bytes(good, bad, random.Random(seed))
        else:
            damaged_content(good, bad, random.Random(seed), module.KIND, module.VERSION)
        found[outcome(bad, whole.hash, load, use)] += 1
    return found


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as place:
        for kind in (RIGS, SPACES):
            print(kind[0].KIND, dict(fuzz(Path(place), range(int(sys.argv[1])), kind)))
