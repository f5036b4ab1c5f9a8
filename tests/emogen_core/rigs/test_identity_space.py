"""Baking the space of heads, on a base mesh of forty vertices whose targets are made up from their names."""

from __future__ import annotations

import numpy as np
import pytest

from emogen_core.face.space import ANCESTRIES, SEXES
from emogen_core.face.space_file import check_space, rounded
from emogen_core.rigs.detail_table import DETAILS
from tests.space_factory import MIDDLE, MIRROR, SIDE, MadeUpSource, small_geometry, small_space

GEOMETRY = small_geometry()


@pytest.fixture(scope="module")
def space():
    return small_space()


def moved(space, name):
    """A target as (H + Q, 3)."""
    rows = np.zeros((len(space.base), 3))
    rows[space.targets[name].rows] = space.targets[name].offsets
    return rows


def test_a_baked_space_is_whole(space):
    check_space(rounded(space))
    assert len(space.half) == SIDE + MIDDLE
    assert len(space.base) == SIDE + MIDDLE + 8


def test_every_head_is_its_own_mirror_image(space):
    rng = np.random.default_rng(3)
    for _ in range(5):
        point = {known.name: rng.uniform(known.low, known.high) for known in space.parameters}
        point |= dict(zip(ANCESTRIES, rng.dirichlet([1, 1, 1]), strict=True))
        mesh, centre = space.head(point)
        assert mesh[GEOMETRY.mirror] * (-1, 1, 1) == pytest.approx(mesh, abs=1e-9)
        assert centre[1:].tolist() == [0, 0]


def test_no_target_moves_the_eyeball_up_or_forward(space):
    for name in space.targets:
        guides = moved(space, name)[len(space.half) :]
        assert guides[:, 1:].mean(0) == pytest.approx([0, 0], abs=0.02), name


@pytest.mark.parametrize("sex", SEXES)
@pytest.mark.parametrize("sign", ["+", "-"])
def test_weight_changes_the_face_as_well(space, sex, sign):
    word = {"+": "max", "-": "min"}[sign]
    plain, body = (
        MadeUpSource().target(f"mpfb2/targets/macrodetails/universal-{sex}-young-averagemuscle-{w}weight.target.gz")
        for w in ("average", word)
    )
    alone = _as_target(space, 100 * (body - plain))
    found = moved(space, f"{sex}-young-weight{sign}") - alone
    wanted = 0.6 * moved(space, f"head-fat{sign}") + 0.4 * moved(space, f"neck-fullness{sign}")
    assert found == pytest.approx(wanted, abs=0.06)


def test_both_sides_of_a_pair_move_together(space):
    (pair,) = (detail for detail in DETAILS if detail.name == "eye-size")
    both = sum(MadeUpSource().target(f"mpfb2/targets/{name}.target.gz") for name in pair.plus)
    assert len(pair.plus) == 2
    assert moved(space, "eye-size+") == pytest.approx(_as_target(space, 100 * pair.scale * both), abs=0.02)


def test_details_have_a_target_for_either_direction_they_go(space):
    for detail in DETAILS:
        assert (f"{detail.name}-" in space.targets) == (detail.low < 0)
        assert f"{detail.name}+" in space.targets


def _as_target(space, offsets):
    """Return (H + Q, 3) of offsets (40, 3), as the baker has to make it."""
    even = (offsets + offsets[MIRROR] * (-1, 1, 1)) / 2
    rows = np.concatenate([even[space.half], even[:8]])
    return rows - rows[len(space.half) :].mean(0) * (0, 1, 1)
