"""Invented summaries and cells, with numbers that are known."""

from dataclasses import replace

import numpy as np

from emogen_core.simulation.complexity import COMPLEXITIES
from emogen_core.simulation.evaluation.strategies.compare import Cell
from emogen_core.simulation.evaluation.strategies.summary import Summary

LAST = 10
_FALLING = np.linspace(0.8, 0.4, LAST + 1)


def made_summary(last=0.4, alike=0.3, active=9.0, **changes):
    """Return a summary whose error falls to a last one."""
    judged = _FALLING * last / 0.4
    flat = np.ones(LAST + 1)
    plain = Summary(
        judged, judged, judged / 2, 0.01, 0.3, 0.1, 1.0, alike * flat, active * flat, 0 * flat,
        generations=LAST, early=0.0, estimated=0.15, expected=0.1,
    )  # fmt: skip
    return replace(plain, **changes)


def made_cell(name="cosine", genes=1, ratio=0.02, uninformed=0.9, **changes):
    """Return a cell in which every goal is met unless a change says otherwise."""
    whole = made_summary(0.4 * ratio)
    return Cell(name, genes, made_summary(), replace(whole, **changes), uninformed, whole)


def made_cells(name="cosine"):
    return [made_cell(name, genes) for genes in COMPLEXITIES]
