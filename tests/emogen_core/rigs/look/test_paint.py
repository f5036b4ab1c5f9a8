"""The pieces of the painter that need no source data."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from emogen_core.face.bundled import load_bundled_rig
from emogen_core.rendering.setup import bundled_look
from emogen_core.rigs.look import eyes, wrinkles
from emogen_core.rigs.look.bake import bake
from emogen_core.rigs.look.canvas import sample_mask, step
from emogen_core.rigs.look.hair import above_hairline, hair_cover, hair_thickness
from emogen_core.rigs.look.noise import band_noise, fractal, value_noise
from emogen_core.rigs.look.presets import ALIASES, presets
from emogen_core.rigs.look.strokes import scalp_hairs, stubble

rig = load_bundled_rig()


def by_name(name):
    return next(p for p in presets() if p.name == name)


def test_there_is_a_preset_for_every_identity_of_the_rig():
    assert {p.name for p in presets()} | set(ALIASES) == set(rig.identities)
    assert len({(p.tone, p.hair, p.brow, p.old) for p in presets()}) == 12


def test_old_presets_are_greyer():
    for young, old in zip(presets()[::2], presets()[1::2], strict=True):
        assert not young.old
        assert old.old
        assert np.ptp(old.hair) < np.ptp(young.hair) + 12
        assert sum(old.hair) > sum(young.hair)


@given(st.floats(-5, 5), st.floats(-2, 2), st.floats(0.01, 3))
def test_step_runs_from_zero_to_one_either_way(t, low, width):
    up, down = float(step(np.array(t), low, low + width)), float(step(np.array(t), low + width, low))
    assert 0 <= up <= 1
    assert up + down == pytest.approx(1, abs=1e-6)


def test_noise_is_smooth_even_and_repeatable():
    place = np.random.default_rng(0).uniform(-2, 2, (20_000, 3)).astype(np.float32)
    noise = value_noise(place, 5, 3)
    assert abs(noise.mean()) < 0.1
    assert 0.5 < noise.std() < 1.5
    assert np.array_equal(noise, value_noise(place, 5, 3))
    assert np.abs(noise - value_noise(place, 5, 4)).mean() > 0.3
    moved = value_noise(place + np.float32(1e-3), 5, 3)
    assert np.abs(moved - noise).max() < 0.1
    assert fractal(place, {5: 0.0, 9: 0.0}, 1) == pytest.approx(0)


def test_noise_of_one_band_has_no_mean_and_unit_deviation():
    noise = band_noise(256, 1.5, 4, 1)
    assert noise.shape == (256, 256)
    assert noise.std() == pytest.approx(1, abs=1e-3)
    assert abs(noise.mean()) < 0.05


def test_a_mask_is_read_upside_up():
    mask = np.zeros((10, 10), np.float32)
    mask[:5] = 1
    assert sample_mask(mask, np.array([[0.5, 0.9], [0.5, 0.1]], np.float32)).tolist() == [1, 0]


@pytest.mark.parametrize("preset", presets(), ids=lambda p: p.name)
def test_an_eye_has_a_dark_pupil_a_coloured_iris_and_a_bright_sclera(preset):
    eye = eyes.paint_eye(preset).astype(int)
    middle = eyes.EYE_SIZE // 2
    pupil, iris, sclera = (eye[middle, middle + d, :3] for d in (0, 40, 80))
    assert pupil.max() < 15
    assert sclera.min() > 160
    assert iris.sum() < sclera.sum() - 100
    assert eye[middle, middle, 3] == 255
    assert eye[4, 4, 3] == 0


def test_lashes_grow_from_the_root_and_keep_off_the_outer_corner():
    lashes = eyes.paint_lashes(male=False)[..., 3].astype(int)
    height, width = lashes.shape
    for rows in (slice(0, height // 2), slice(height // 2, height)):
        strip = lashes[rows]
        assert strip[-8:].sum() > 3 * strip[:8].sum()
        assert strip[:, int(0.93 * width) :].max() == 0
    assert lashes[: height // 2].sum() > lashes[height // 2 :].sum()


def test_wrinkle_groups_match_their_drivers_and_the_rig():
    names = [group.name for group in wrinkles.groups()]
    assert len(names) == len(set(names)) == len(wrinkles.drivers()) == bundled_look().wrinkle_masks.shape[1]
    for drivers in wrinkles.drivers():
        assert drivers
        assert set(drivers) <= set(rig.shape_names)
        # Below 0 a muscle smooths the lines of another out.
        assert all(0 < abs(gain) <= 1 for gain in drivers.values())
        assert max(drivers.values()) > 0.4


def test_wrinkles_mirror():
    place = np.random.default_rng(1).uniform((-0.8, -1.2, -0.5), (0.8, 0.8, 0.4), (500, 3)).astype(np.float32)
    names = [group.name for group in wrinkles.groups()]
    swap = [names.index(n.replace("left", "?").replace("right", "left").replace("?", "right")) for n in names]
    assert wrinkles.masks(place * (-1, 1, 1)) == pytest.approx(wrinkles.masks(place)[:, swap], abs=1e-6)


def test_hair_grows_on_the_crown_and_not_in_the_face():
    place = np.array([[0, 1.1, -0.6], [0, 0.4, 0.25], [0.6, -0.6, -0.2], [0, 0.2, -1.6]], np.float32)
    cover = hair_cover(place, np.zeros(4, np.float32))
    assert cover.tolist() == pytest.approx([1, 0, 0, 1])
    assert (hair_cover(place, np.ones(4, np.float32)) == 0).all()
    assert (above_hairline(place, 0.3) <= above_hairline(place)).all()


def test_women_wear_it_longer_than_men_and_old_men_not_at_all():
    place = np.array([[0, 1.1, -0.6], [0, 0.4, 0.25]], np.float32)
    bare = np.zeros(2, np.float32)
    woman, man, old = (
        hair_thickness(place, bare, by_name(f"caucasian-{kind}")) for kind in ("female-young", "male-young", "male-old")
    )
    assert woman[0] > man[0] > old[0] == 0
    assert woman[1] == man[1] == 0


@settings(max_examples=5, deadline=None)
@given(st.integers(0, 100))
def test_strokes_stay_in_range_and_repeat(seed):
    hairs = scalp_hairs(64, (0.0, 0.2, 1.0, 1.0), (4, 11), seed)
    assert hairs.shape == (64, 64)
    assert 0 <= hairs.min() <= hairs.max() <= 1
    dots = stubble(64, np.array([[0.5, 0.5]]), seed)
    assert dots[28:40, 28:36].max() > 0
    assert dots[:16].max() == 0


def test_baked_light_knows_lit_and_hidden_places():
    light = bake(rig, "female")
    neutral = rig.neutral("female")
    assert light.shape == (len(neutral), 3)
    assert light.min() >= 0
    assert light.max() <= 1
    skin = np.unique(rig.triangles[slice(*rig.parts["skin"])])
    crown = skin[neutral[skin, 1].argmax()]
    tongue = np.unique(rig.triangles[slice(*rig.parts["tongue"])])
    assert light[crown, 0] > 0.95
    assert light[tongue, 0].mean() < 0.3
    # The lamp stands on the head's right: that cheek sees it.
    cheeks = [skin[(np.abs(neutral[skin] - (sign * 55, -35, 0)) < 12).all(1)] for sign in (-1, 1)]
    assert light[cheeks[0], 1].mean() > light[cheeks[1], 1].mean()
    ears = skin[np.abs(neutral[skin, 0]) > 78]
    ears = ears[np.abs(neutral[ears, 1]) < 30]
    assert light[ears, 2].mean() > light[crown, 2] + 0.1
