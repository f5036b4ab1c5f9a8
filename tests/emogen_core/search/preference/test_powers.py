"""Powers of two without a mathematics library."""

from __future__ import annotations

import numpy as np

from emogen_core.search.preference.powers import LIMIT, power_of_two


def test_powers_are_right_to_a_ten_thousandth() -> None:
    x = np.linspace(-LIMIT, LIMIT, 20_001, dtype=np.float32)
    np.testing.assert_allclose(power_of_two(x.copy()), np.exp2(x.astype(np.float64)), rtol=1e-4)


def test_what_is_beyond_the_limit_counts_as_the_limit() -> None:
    ends = power_of_two(np.array([-1e30, -LIMIT, LIMIT, 1e30], np.float32))
    assert ends[0] == ends[1] < ends[2] == ends[3]


def test_known_powers_stay_what_they_are() -> None:
    # Recorded participations are replayed by later versions and on other machines: these bits must never change.
    found = power_of_two(np.array([-3.3, 0.1, 20.5, -71.9], np.float32))
    assert found.view(np.uint32).tolist() == KNOWN


KNOWN = [1037038192, 1065954995, 1236599134, 461975210]
