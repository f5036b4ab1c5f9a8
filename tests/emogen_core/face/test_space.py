"""The space of heads: points in, symmetric heads out, in one frame."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from emogen_core.errors import InvalidInputError, RigFileError
from emogen_core.face.bundled import load_bundled_rig
from emogen_core.face.container import read_container, write_container
from emogen_core.face.space import AGES, age_shares, fit_sphere, topology_hash
from emogen_core.face.space_file import BUNDLED_SPACE, KIND, VERSION, load_bundled_space, load_space, save_space
from emogen_core.rigs.random_heads import random_head
from tests.emogen_core.face.fuzz import SPACES, fuzz
from tests.space_factory import small_space

RIG, SPACE = load_bundled_rig(), load_bundled_space()


def test_the_space_is_of_the_bundled_rig_and_small():
    assert SPACE.topology == topology_hash(RIG.triangles, RIG.mirror, RIG.parts)
    assert BUNDLED_SPACE.stat().st_size <= 3 * 2**20
    assert len(SPACE.details) >= 20
    assert {SPACE.ranges[name].region for name in SPACE.details} >= {
        "head", "eye", "nose", "mouth", "cheek", "chin", "brow", "ear",
    }  # fmt: skip


@pytest.mark.parametrize("seed", range(5))
def test_every_head_is_its_own_mirror_image_in_the_frame_of_the_eyes(seed):
    mesh, centre = SPACE.head(random_head(SPACE, seed).head)
    assert np.isfinite(mesh).all()
    assert mesh[RIG.mirror] * (-1, 1, 1) == pytest.approx(mesh, abs=1e-9)
    ball = mesh[np.unique(RIG.triangles[slice(*RIG.parts["eye_left"])])]
    found, radius = fit_sphere(ball[np.linalg.norm(ball - centre, axis=1) < SPACE.eye_radius + 1e-3])
    assert found == pytest.approx(centre, abs=1e-3)
    assert centre[1:].tolist() == [0, 0]
    assert radius == pytest.approx(14.95, abs=1e-3)


def test_half_a_slider_is_half_way_before_the_head_is_scaled():
    point = {"nose-width": 1.0}
    ends = [SPACE.head({name: value * share for name, value in point.items()})[0] for share in (0, 0.5, 1)]
    assert ends[1] == pytest.approx((ends[0] + ends[2]) / 2, abs=1e-6)
    assert np.abs(ends[2] - ends[0]).max() > 2


def test_the_shares_of_a_corner_are_its_targets_alone():
    weights = SPACE.weights({"sex": 1.0, "age": 90.0, "african": 1.0, "asian": 0.0, "caucasian": 0.0})
    assert weights == {"african-male-old": 1.0}


@pytest.mark.parametrize("years", [10, 14, 25, 40, 71.5, 90])
def test_shares_of_age_sum_to_one_and_name_at_most_two_neighbours(years):
    shares = age_shares(years)
    assert sum(shares.values()) == pytest.approx(1)
    assert sum(share > 0 for share in shares.values()) <= 2
    assert sum(share * AGES[age] for age, share in shares.items()) == pytest.approx(years)


@pytest.mark.parametrize(
    ("point", "message"),
    [
        ({"nose-lenght": 0.1}, "nose-lenght"),
        ({"nose-width": 1.01}, r"nose-width: expected a number in \[-1, 1\], got 1.01"),
        ({"age": float("nan")}, "age"),
        ({"african": 0.9}, "shares that sum to 1"),
    ],
)
def test_a_point_outside_is_refused_with_its_name(point, message):
    with pytest.raises(InvalidInputError, match=message):
        SPACE.head(point)


def test_a_space_comes_back_from_its_file_as_it_was_stored(tmp_path):
    stored = save_space(SPACE, tmp_path / "a.space")
    assert stored.hash == SPACE.hash
    again = load_space(tmp_path / "a.space")
    point = random_head(SPACE, 9).head
    assert (again.head(point)[0] == SPACE.head(point)[0]).all()


@pytest.mark.parametrize(
    "change",
    [
        {"half": SPACE.half[:-1]},
        {"eyes": SPACE.eyes + len(SPACE.low)},
        {"base": np.full_like(SPACE.base, np.nan)},
        {"targets": {name: t for name, t in SPACE.targets.items() if name != "nose-width+"}},
    ],
)
def test_a_space_that_contradicts_itself_is_not_stored(tmp_path, change):
    with pytest.raises(RigFileError, match="expected"):
        save_space(replace(SPACE, **change), tmp_path / "bad.space")


def test_a_damaged_space_is_refused_in_one_line_or_sound(tmp_path):
    """A short run of fuzz.py."""
    found = fuzz(tmp_path, range(200), SPACES)
    assert found["refused"] > 140
    assert sum(found.values()) == 200


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (lambda d, _: d["parameters"].pop(2), "each once"),
        (lambda d, _: d["parameters"].append(d["parameters"][-1]), "each once"),
        (lambda d, _: d["parameters"][2].__setitem__(4, 0.9), "sum to 1"),
        (lambda d, _: d["parameters"][0].__setitem__(3, 1e999), "Infinity|complete space|plain JSON"),
        (lambda d, _: d["parameters"][0].__setitem__(3, 1e300), "within 1000"),
        (lambda d, _: d["parameters"][0].__setitem__(3, -1), "low <= default <= high"),
        (lambda _, a: a.update(half=a["half"].astype(np.float64)), "half of int32 with 1 axes"),
        (lambda _, a: a.update(base=a["base"].astype(np.float32)), "base of int32"),
        (lambda _, a: a.update(base=a["base"][:, :2]), r"base and eyeball"),
        (lambda _, a: a["target/nose-width.plus/rows"].__setitem__(1, 0), "rising rows"),
        (lambda _, a: a.pop("target/nose-width.plus/rows"), "complete space"),
    ],
)
def test_a_space_whose_hash_fits_but_whose_content_does_not_is_refused(tmp_path, change, said):
    path = tmp_path / "a.space"
    save_space(small_space(), path)
    document, arrays, _ = read_container(path, KIND, VERSION)
    arrays = {name: array.copy() for name, array in arrays.items()}
    with pytest.raises(RigFileError, match=said):
        change(document, arrays)
        write_container(path, KIND, VERSION, document, arrays)
        load_space(path)


def test_a_damaged_file_is_refused(tmp_path):
    path = tmp_path / "cut.space"
    path.write_bytes(BUNDLED_SPACE.read_bytes()[:-4000])
    with pytest.raises(RigFileError, match="readable space file"):
        load_space(path)
