"""A small search space that needs no rig, and strategies that draw choices on it."""

from __future__ import annotations

from hypothesis import strategies as st

from emogen_core.search import Choice, FaceSet, SearchParams

GENES = 20
SETS = tuple(FaceSet(name, tuple(range(5 * i, 5 * i + 5))) for i, name in enumerate(("happy", "sad", "angry")))


def space(**options: object) -> SearchParams:
    """Twenty genes of which the last two are switched off."""
    return SearchParams(GENES, tuple(range(GENES - 2)), SETS, **options)  # type: ignore[arg-type]


@st.composite
def choices(draw: st.DrawFn) -> Choice:
    selected = draw(st.lists(st.integers(1, 10), min_size=1, max_size=10, unique=True))
    return Choice(tuple(selected), draw(st.sampled_from(selected)))
