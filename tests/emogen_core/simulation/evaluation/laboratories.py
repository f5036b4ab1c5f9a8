"""Laboratories on a small rig and on the bundled one."""

from functools import cache

from emogen_core.face.bundled import load_bundled_rig
from emogen_core.search.params import search_params
from emogen_core.simulation.evaluation.laboratory import Laboratory
from tests.rig_factory import small_rig

SMALL = small_rig(genes=14)
QUICK = {"activation": (2, 3), "random_genes": 3, "generations": 3, "gaze": False}


def small_laboratory(seed=1, pause=None, **options):
    return Laboratory(SMALL, "female", seed, search_params(SMALL, **{**QUICK, **options}), pause)


@cache
def bundled():
    return load_bundled_rig()


def real_laboratory(seed=1, **options):
    return Laboratory(bundled(), "female", seed, search_params(bundled(), **options))
