"""By what simulated participants judge beyond the catalogue of metrics: distances of meshes in units of what is meant.

A rescaled judge weighs every gene by a factor of its own, drawn once from a lognormal distribution: a metric that no
strategy knows. There are several, by number, so that nothing rests on one draw.
"""

from __future__ import annotations

import numpy as np

from emogen_core.similarity.catalogue import Material, Metric, metric
from emogen_core.similarity.linear import LinearMetric, vertex_rms
from emogen_core.simulation.complexity import Relative

VERTEX = "relative vertex distance"
RESCALED = "rescaled vertex distance "
"""Before the number of the draw."""
SPREAD = 0.5
"""Standard deviation of the logarithm of a factor."""
_STREAM = 9


def judge(name: str, material: Material) -> Metric:
    """Return a metric of the catalogue, or of a judge beyond it.

    Raises:
        InvalidInputError: there is none of this name.
    """
    if name == VERTEX:
        return Relative(vertex_rms(material.offsets()))
    if name.startswith(RESCALED):
        return Relative(_rescaled(material, int(name.removeprefix(RESCALED))))
    return metric(name, material)


def _rescaled(material: Material, number: int) -> LinearMetric:
    """Return the distance of meshes on which the shapes of every gene move more or less than they do."""
    drives = np.asarray(material.gene_to_core, np.float64)
    factors = np.exp(SPREAD * np.random.default_rng((_STREAM, number)).standard_normal(len(drives)))
    scales = np.ones(material.shapes)
    scales[: drives.shape[1]] = factors @ drives / np.maximum(drives.sum(0), 1)
    plain = vertex_rms(material.offsets())
    return LinearMetric("rescaled", plain.basis * scales[:, None])
