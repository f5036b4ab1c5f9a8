"""Half a pair gets its other side from its mirror image."""

from dataclasses import replace

import numpy as np
import pytest

from emogen_core.rigs.foreign.halves import with_halves
from emogen_core.rigs.foreign.model import Findings
from tests.emogen_core.rigs.foreign.heads import made_head

head = made_head()


def without(*names, **changes):
    kept = {name: offsets for name, offsets in head.expressions.items() if name not in names}
    return replace(head, expressions=kept, **changes)


@pytest.mark.parametrize(("lost", "kept"), [("mouthSmile_R", "mouthSmile_L"), ("eyeLookIn_L", "eyeLookIn_R")])
def test_the_other_side_is_the_mirror_image(lost, kept):
    findings = Findings()
    whole = with_halves(without(lost), findings)
    assert set(whole.expressions) == set(head.expressions)
    assert np.abs(whole.expressions[lost] - head.expressions[lost]).max() < 1e-4
    assert findings.guessed == [f"1 movements of one side were mirrored to the other: {lost} from {kept}."]


def test_whole_pairs_stay_as_they_are():
    findings = Findings()
    assert with_halves(head, findings) is head
    assert not findings.guessed


def test_a_head_that_is_not_symmetric_there_keeps_its_half():
    bent = head.vertices + np.where(head.vertices[:, :1] < 0, (0, 0, 9), 0).astype(np.float32)
    findings = Findings()
    assert "mouthSmile_R" not in with_halves(without("mouthSmile_R", vertices=bent), findings).expressions
    assert not findings.guessed


def test_names_that_nobody_knows_are_no_halves():
    odd = replace(
        head, expressions={"wiggle_L": head.expressions["mouthSmile_L"], "jawOpen": head.expressions["jawOpen"]}
    )
    assert with_halves(odd, Findings()) is odd
