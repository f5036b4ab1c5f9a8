"""A small synthetic rig: quick to evaluate, with every kind of thing that a real one has."""

import hashlib
from dataclasses import replace

import numpy as np

from emogen_core.face.rig import Adjustment, Combination, EmotionSet, Gene, Rig

VERTICES = 24


def small_rig(seed: int = 7, genes: int = 8) -> Rig:
    rng = np.random.default_rng(seed)
    names = [f"g{i}" for i in range(genes)]
    pairs = [(f"{name}L", f"{name}R") if i % 2 else (name,) for i, name in enumerate(names)]
    core = tuple(member for pair in pairs for member in pair)
    combinations = (Combination("c01", ("g0", "g1")), Combination("c02", ("g0", "g3")))
    made = tuple(
        Gene(
            name, pair, (f"AU{i + 1}",), "mouth" if i < genes - 1 else "gaze",
            frozenset({"gaze"}) if i == genes - 1 else frozenset(),
        )
        for i, (name, pair) in enumerate(zip(names, pairs, strict=True))
    )  # fmt: skip
    sets = {
        word: EmotionSet(tuple(names[i : i + 4]), (1.0, 0.8, 0.6, 0.4), (), "invented")
        for i, word in enumerate(("happy", "sad", "angry", "fearful"))
    }
    shapes = len(core) + len(combinations) + 1
    neutral = rng.normal(size=(VERTICES, 3)).astype(np.float32)
    return Rig(
        name="small",
        genes=made,
        core_shapes=core,
        combinations=combinations,
        collision_shapes=("lips",),
        emotion_sets=sets,
        offsets=rng.normal(size=(shapes, VERTICES, 3)).astype(np.float32),
        neutrals={"female": neutral, "male": neutral + 1},
        triangles=np.array([[i, i + 1, i + 2] for i in range(VERTICES - 2)], np.int32),
        parts={"skin": (0, VERTICES - 2)},
        hash=hashlib.sha256(f"small {seed} {genes}".encode()).hexdigest(),
    )


def full_rig():
    change = Adjustment(np.array([1, 4]), np.full((2, VERTICES, 3), 0.25, np.float32))
    return replace(
        small_rig(),
        regions={"lips": np.arange(5, dtype=np.int32)},
        mirror=np.arange(VERTICES, dtype=np.int32),
        adjustments={"male": change},
    )
