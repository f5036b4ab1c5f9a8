"""What is nearly symmetric becomes so; what is not, or leads to one side, stays."""

import numpy as np

from emogen_core.rigs.foreign.model import Findings
from emogen_core.rigs.imported.evened import evened, say_evened

# Vertices 0 and 1 are mirror images, 2 lies in the middle, 3 and 4 are another pair.
MIRROR = np.array([1, 0, 2, 4, 3])
WHOLE = np.array([[1, 9, 3], [-1.2, 9, 3], [0.2, 8, 0], [3, 0, 0], [-2, 0, 0]], np.float32)
LEFT = np.array([[4, 0, 0], [0, 0, 0], [0, 0, 0], [0, 0, 0], [0, 0, 0]], np.float32)
RIGHT = np.array([[0, 0, 0], [-4, 0.4, 0], [0, 0, 0], [0, 0, 0], [0, 0, 0]], np.float32)
# To one side: its mirror image would lead to the other, though no vertex is moved far by it.
ASIDE = np.array([[0.2, 0, 0], [0.2, 0, 0], [0.2, 0, 0], [0, 0, 0], [0, 0, 0]], np.float32)
SHAPES = {"whole": WHOLE, "pair.L": LEFT, "pair.R": RIGHT, "aside": ASIDE, "still": 0 * WHOLE}


def test_slight_differences_go_and_others_stay():
    made, findings = evened(SHAPES, MIRROR), Findings()
    assert [*made] == [*SHAPES]
    assert np.allclose(made["whole"], [[1.1, 9, 3], [-1.1, 9, 3], [0, 8, 0], [3, 0, 0], [-2, 0, 0]])
    assert np.allclose(made["pair.L"][0], [4, 0.2, 0])
    assert np.array_equal(made["pair.L"][MIRROR] * (-1, 1, 1), made["pair.R"])
    assert np.array_equal(made["aside"], ASIDE)
    assert not made["still"].any()
    say_evened(SHAPES, made, findings)
    assert findings.found == ["Left and right of 3 shapes were made alike where they nearly were, by up to 0.20 mm."]


def test_half_a_pair_stays():
    assert np.array_equal(evened({"half.L": LEFT, "aside": ASIDE}, MIRROR)["half.L"], LEFT)


def test_what_is_alike_already_is_not_told():
    once, findings = evened(SHAPES, MIRROR), Findings()
    again = evened(once, MIRROR)
    assert all(np.array_equal(again[name], once[name]) for name in SHAPES)
    say_evened(once, again, findings)
    assert not findings.found


def test_a_head_that_is_not_symmetric_is_left():
    assert evened(SHAPES, np.zeros(0, np.int32)) == SHAPES
