"""Mouths that are open are told from shut ones, and what shuts them leaves neither slits nor touches."""

import numpy as np
import pytest

from emogen_core.correctives.collision.detect import detect
from emogen_core.face.bundled import load_bundled_rig
from emogen_core.face.space_file import load_bundled_space
from emogen_core.rigs.collision_bake import TOLERANCE
from emogen_core.rigs.fitting import SHUT_GENES, gene_offsets
from emogen_core.rigs.lips import teeth_area
from emogen_core.rigs.shut_mouth import shut_mouth

rig = load_bundled_rig()
mouth = shut_mouth(rig, load_bundled_space().low.astype(np.float64))
neutral = rig.neutral(rig.identities[0]).astype(np.float64)
genes = gene_offsets(dict(zip(rig.core_shapes, rig.offsets.astype(np.float64), strict=False)))


@pytest.mark.parametrize("share", [0.2, 0.5, 1.0])
def test_a_dropped_jaw_is_an_open_mouth(share):
    # Far apart in the middle, lips still meet at the corners.
    assert mouth.is_open(neutral + share * genes["jawOpen"])


@pytest.mark.parametrize("gene", SHUT_GENES)
def test_genes_that_leave_it_shut_do_not_open_it(gene):
    assert not mouth.is_open(neutral + genes[gene])


@pytest.mark.parametrize("apart", [-0.8, 0.8])
def test_lips_that_touch_or_gape_are_shut(apart):
    mesh = neutral + [0, 1, 0] * (apart * (0.5 - mouth.low) * (neutral[:, 2] > -40))[:, None]
    shut = mouth.sealed(mesh)
    found = detect(mouth.anchors.sample(shut[None])[0], mouth.anchors.kind, shut, mouth.target, tolerance=TOLERANCE)
    assert not found.collides
    assert teeth_area(mouth.topology, shut) == 0
