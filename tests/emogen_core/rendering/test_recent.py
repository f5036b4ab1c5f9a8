"""What was used last is kept, up to the limit, and what goes is freed once."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from emogen_core.rendering.recent import Recent


@given(st.lists(st.integers(0, 9), max_size=60), st.integers(1, 5))
def test_it_holds_the_last_distinct_keys_and_frees_every_other_one(keys, limit):
    made, freed = [], []
    recent = Recent(limit, freed.append)
    for key in keys:
        assert recent.get(key, lambda key=key: made.append(key) or key) == key
    latest = list(dict.fromkeys(reversed(keys)))[:limit]
    assert {key for key in range(10) if key in recent} == set(latest)
    assert len(recent) == len(latest)
    assert sorted(made) == sorted([*freed, *latest])


def test_clearing_frees_nothing():
    freed = []
    recent = Recent(2, freed.append)
    recent.get("a", lambda: 1)
    recent.clear()
    assert (len(recent), freed) == (0, [])
