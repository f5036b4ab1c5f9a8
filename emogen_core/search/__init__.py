"""The search for the face that a participant has in mind: `ask` for ten faces, `tell` the choice.

A strategy is an object with `init`, `ask` and `tell` on explicit, serialisable state; see `strategy`.
"""

from emogen_core.search.params import FaceSet, SearchParams
from emogen_core.search.state import Answer, Choice, Population, State
from emogen_core.search.strategies import STRATEGIES, Strategy, strategy
from emogen_core.search.streams import place_order

__all__ = [
    "STRATEGIES",
    "Answer",
    "Choice",
    "FaceSet",
    "Population",
    "SearchParams",
    "State",
    "Strategy",
    "place_order",
    "strategy",
]
