"""Strategies compared on the same targets and people: error, scatter, bias and faces, generation by generation."""

from emogen_core.simulation.evaluation.strategies.compare import FEWEST, Plan, compare
from emogen_core.simulation.evaluation.strategies.conditions import CONDITIONS

__all__ = ["CONDITIONS", "FEWEST", "Plan", "compare"]
