"""Random heads are points of the space, adults, and the same for the same seed."""

from __future__ import annotations

import numpy as np
import pytest

from emogen_core.face.identity import is_adult, read_identity, signed_document
from emogen_core.face.space_file import load_bundled_space
from emogen_core.rigs.random_heads import DETAILS, random_head

SPACE = load_bundled_space()
HEADS = [random_head(SPACE, seed) for seed in range(60)]


@pytest.mark.parametrize("head", HEADS[:10], ids=lambda head: head.name)
def test_a_random_head_is_an_adult_point_of_the_space(head):
    assert is_adult(head, SPACE)
    assert read_identity(signed_document(head, SPACE), SPACE).name == head.name
    assert len(set(head.head) & set(SPACE.details)) == DETAILS


def test_a_seed_names_one_head():
    assert random_head(SPACE, 7) == HEADS[7]
    assert len({tuple(head.head.items()) for head in HEADS}) == len(HEADS)


def test_they_go_all_over_the_space():
    for name in ("sex", "age", "weight", "african", "asian", "caucasian"):
        known, values = SPACE.ranges[name], [head.head[name] for head in HEADS]
        assert np.ptp(values) > 0.75 * (known.high - known.low), name
