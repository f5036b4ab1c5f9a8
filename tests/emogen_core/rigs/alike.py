"""Meshes that were made on another processor, whose algebra rounds otherwise."""

import numpy as np

SHARE, FARTHEST = 0.01, 0.6


def must_be_alike(made, stored):
    """Hold meshes (..., 3) against others, millimetres.

    Where lips touch, the last bit decides which vertex is moved: some at the lips may differ, by what nobody sees.
    """
    apart = np.linalg.norm(made - stored, axis=-1)
    assert (apart > 0.05).mean() < SHARE
    assert apart.max() < FARTHEST
