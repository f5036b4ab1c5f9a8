"""The strategies a study can name: modules with `NAME`, `VERSION` and the functions of `Strategy`."""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol

from emogen_core.errors import InvalidInputError, expected
from emogen_core.search import emogen, preference

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from emogen_core.search.params import SearchParams
    from emogen_core.search.state import Choice, Population, State


class Strategy(Protocol):
    """What every strategy offers; all of it is pure and depends on nothing but its arguments."""

    NAME: str
    VERSION: int

    def init(self, params: SearchParams, seed: int, attempt: int = 0) -> State:
        """Return the state at the start of a trial, or of its `attempt`-th start again."""
        ...

    def ask(self, params: SearchParams, state: State) -> Population:
        """Return the ten faces of `state.generation`."""
        ...

    def ask_ahead(self, params: SearchParams, state: State) -> dict[int, NDArray[np.float64]]:
        """Return the faces of the next generation that no choice can change: slot -> genes."""
        ...

    def tell(self, params: SearchParams, state: State, choice: Choice) -> State:
        """Return the state after a choice on those ten faces."""
        ...

    def last(self, params: SearchParams, state: State) -> bool:
        """Return whether `state.generation` is the last one of its trial: after the choice on it the trial ends."""
        ...

    def estimate(self, params: SearchParams, state: State) -> NDArray[np.float64] | None:
        """Return the (G,) face that all answers together speak for; None where the strategy weighs no answers."""
        ...


STRATEGIES: dict[str, Strategy] = {emogen.NAME: emogen, preference.NAME: preference}


def strategy(name: str) -> Strategy:
    """Return a strategy by name.

    Raises:
        InvalidInputError: no strategy has this name.
    """
    if name not in STRATEGIES:
        raise InvalidInputError(f"strategy: {expected(f'one of {sorted(STRATEGIES)}', name)}")
    return STRATEGIES[name]
