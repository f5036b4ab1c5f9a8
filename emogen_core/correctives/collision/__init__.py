"""Collision correctives: keep upper lip, lower lip and front teeth out of each other (EmoGen 2021, section III-A)."""

from emogen_core.correctives.collision.judge import dense_depth
from emogen_core.correctives.collision.regions import has_regions
from emogen_core.correctives.collision.solve import CollisionResult, solve_collisions

__all__ = ["CollisionResult", "dense_depth", "has_regions", "solve_collisions"]
