"""Genes as movements of the mesh."""

from __future__ import annotations

import numpy as np
import pytest

from emogen_core.face.geometry import gene_geometry
from tests.rig_factory import small_rig


def test_products_are_those_of_the_meshes_that_genes_make() -> None:
    rig = small_rig()
    rng = np.random.default_rng(0)
    one, other = rng.random((2, len(rig.genes)))
    meshes = [
        np.einsum("c,cnx->nx", genes @ rig.gene_to_core, rig.offsets[: len(rig.core_shapes)]) for genes in (one, other)
    ]
    assert one @ rig.geometry.products @ other == pytest.approx((meshes[0] * meshes[1]).sum(), rel=1e-5)


def test_a_pair_counts_twice() -> None:
    rig = small_rig()
    assert rig.geometry.multiplicities.tolist() == [len(gene.members) for gene in rig.genes]


def test_it_is_worked_out_once_a_rig() -> None:
    rig = small_rig()
    assert rig.geometry is rig.geometry
    assert rig.geometry is not small_rig().geometry


def test_a_pair_of_equal_sides_moves_twice_as_much_as_one() -> None:
    offsets = np.array([[[1.0, 0, 0]], [[0, 2.0, 0]], [[5.0, 5, 5]]])
    geometry = gene_geometry(np.array([[1, 1], [0, 1]]), offsets)
    assert geometry.products.tolist() == [[5, 4], [4, 4]]
    assert geometry.multiplicities.tolist() == [2, 1]
