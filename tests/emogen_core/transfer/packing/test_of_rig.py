"""What of a rig is packed."""

from dataclasses import replace

import numpy as np
import pytest

from emogen_core.errors import InvalidInputError
from emogen_core.face.bundled import load_bundled_rig
from emogen_core.transfer.packing.of_rig import template_of
from emogen_core.transfer.packing.pack import Options, pack
from tests.rig_factory import small_rig

RIG = load_bundled_rig()


def test_core_shapes_of_genes_that_are_not_disabled():
    template = template_of(RIG)
    disabled = {member for gene in RIG.genes if "disabled" in gene.flags for member in gene.members}
    assert template.names == tuple(name for name in RIG.core_shapes if name not in disabled)
    assert disabled == {"pupilDilate.L", "pupilDilate.R", "cheekSuck.L", "cheekSuck.R", "tongueOut"}
    assert {template.names[k] for k in template.gaze} == {
        f"gaze{way}.{s}" for way in ("Up", "Down", "Left", "Right") for s in "LR"
    }
    np.testing.assert_array_equal(template.offsets[0], RIG.offsets[RIG.core_shapes.index(template.names[0])])


def test_only_skin_counts():
    template = template_of(RIG)
    first, last = RIG.parts["skin"]
    assert set(np.flatnonzero(template.visible)) == set(RIG.triangles[first:last].ravel())
    assert not pack(template).active[:, ~template.visible].any()
    assert template_of(replace(RIG, parts={"face": (0, len(RIG.triangles))})).visible is None


def test_the_target_is_handed_on():
    male = RIG.neutral("male")
    assert template_of(RIG, male).target is male


def test_shapes_without_a_gene_are_packed_too():
    rig = small_rig()
    assert template_of(replace(rig, genes=rig.genes[1:])).names == rig.core_shapes


def test_shapes_that_move_nothing_are_left_out():
    rig = small_rig()
    offsets = rig.offsets.copy()
    offsets[2] = 0
    names = template_of(replace(rig, offsets=offsets)).names
    assert names == tuple(name for name in rig.core_shapes if name != rig.core_shapes[2])
    assert pack(template_of(replace(rig, offsets=offsets))).needed > 0


def test_nothing_to_pack_is_said():
    rig = small_rig()
    none = replace(rig, genes=tuple(replace(gene, flags=frozenset({"disabled"})) for gene in rig.genes))
    with pytest.raises(InvalidInputError, match=r"^shapes: expected core shapes that move something, got 0"):
        template_of(none)


@pytest.mark.parametrize(("mu", "greedy", "minimum"), [(0.25, 28, 27), (0.3, 25, 25), (0.33, 25, 25), (0.4, 22, 21)])
def test_the_table_of_the_docs(mu, greedy, minimum):
    template = template_of(RIG)
    found = pack(template, Options(mu))
    assert (found.needed, found.minimum) == (greedy, minimum)
    assert pack(template, Options(mu, order="minimal")).needed == minimum
