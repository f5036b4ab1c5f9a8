"""Files of a small face model that is not the one of the house."""

import numpy as np

from emogen_core.face.modes import ModeSpace, save_modes
from emogen_core.face.rig_file import load_rig, save_rig
from emogen_core.rendering.look import save_look
from emogen_core.rendering.plain import plain_look
from tests.rig_factory import small_rig


def model_files(folder, seed=8, genes=7):
    """Return the bytes of a rig file and of its look."""
    rig, look = folder / f"lab{seed}.rig", folder / f"lab{seed}.look"
    save_rig(small_rig(seed, genes), rig)
    save_look(look, plain_look(load_rig(rig)))
    return rig.read_bytes(), look.read_bytes()


def modes_file(folder, rig, names=("identity000", "identity001")):
    """Return the bytes of a file of identity modes for the bytes of a rig file."""
    path, modes = folder / "wanted.rig", folder / "wanted.modes"
    path.write_bytes(rig)
    model, random = load_rig(path), np.random.default_rng(3)
    offsets = {name: random.normal(size=model.offsets.shape[1:]).astype(np.float32) for name in names}
    save_modes(ModeSpace(model.hash, offsets), modes)
    return modes.read_bytes()
