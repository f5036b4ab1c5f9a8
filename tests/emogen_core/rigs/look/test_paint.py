"""The pieces of the painter that need no source data."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from emogen_core.face.bundled import load_bundled_rig
from emogen_core.rendering.composer.brows import LEVELS
from emogen_core.rendering.setup import bundled_look
from emogen_core.rigs.look import eyes, wrinkles
from emogen_core.rigs.look.bake import bake
from emogen_core.rigs.look.canvas import Canvas, sample_mask, step
from emogen_core.rigs.look.hair import above_hairline, bald_field, combing, hair_field, lift_field
from emogen_core.rigs.look.noise import band_noise, fractal, value_noise
from emogen_core.rigs.look.presets import presets
from emogen_core.rigs.look.strands import coils, sheen, strands
from emogen_core.rigs.look.strokes import BROW_SIZE, brow_stack, stubble

rig = load_bundled_rig()


def test_there_is_a_preset_for_every_identity_of_the_rig():
    assert set(presets()) == set(rig.identities)
    assert len(set(presets().values())) == len(rig.identities)


def test_old_presets_are_greyer_lined_and_worn():
    for name, young in presets().items():
        if name.endswith("-young"):
            old = presets()[name.replace("young", "old")]
            for more in ("grey", "lines", "spots", "teeth", "balding"):
                assert getattr(old, more) > getattr(young, more)
            assert old.hair_length != young.hair_length
            assert (old.skin_depth, old.iris_colour) == (young.skin_depth, young.iris_colour)


def test_the_default_heads_lie_between_the_heads_they_are_blended_from():
    for sex in ("female", "male"):
        depths = [presets()[f"{ancestry}-{sex}-young"].skin_depth for ancestry in ("african", "asian", "caucasian")]
        assert min(depths) < presets()[sex].skin_depth < max(depths)


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


def test_noise_that_texels_cannot_carry_is_left_out():
    place = np.random.default_rng(0).uniform(-2, 2, (5000, 3)).astype(np.float32)
    coarse = np.full(5000, 0.02, np.float32)
    carried = fractal(place, {5: 1.0, 80: 1.0}, 1, coarse)
    assert np.array_equal(carried, fractal(place, {5: 1.0}, 1))


def test_an_iris_has_threads_all_round_and_a_sclera_veins_towards_the_back():
    iris, veins = eyes.iris().astype(float), eyes.veins().astype(float)
    assert iris.shape == veins.shape == (eyes.EYE_SIZE, eyes.EYE_SIZE)
    rows, columns = np.mgrid[: eyes.EYE_SIZE, : eyes.EYE_SIZE] + 0.5 - eyes.EYE_SIZE / 2
    radius, angle = np.hypot(rows, columns), np.arctan2(rows, columns)
    for quarter in np.linspace(-np.pi, np.pi, 5)[:-1]:
        part = iris[(radius > 20) & (radius < 55) & (angle >= quarter) & (angle < quarter + np.pi / 2)]
        assert part.std() > 8
        assert part.mean() == pytest.approx(122, abs=14)
    assert veins[(radius > 200) & (radius < 250)].mean() > 3 * veins[(radius > 60) & (radius < 100)].mean()


def test_lashes_grow_from_the_root_keep_off_the_outer_corner_and_never_shrink_with_length():
    short, long = (eyes.lashes(length).astype(int) for length in (0.6, 0.95))
    height, width = long.shape
    for rows in (slice(0, height // 2), slice(height // 2, height)):
        for strip in (short[rows], long[rows]):
            assert strip[-8:].sum() > 2 * strip[:8].sum()
            assert strip[:, int(0.93 * width) :].max() == 0
    assert long.sum() > 1.2 * short.sum()
    assert long[: height // 2].sum() > long[height // 2 :].sum()


def test_wrinkle_groups_match_their_drivers_and_the_rig():
    names = [group.name for group in wrinkles.groups()]
    assert len(names) == len(set(names)) == len(wrinkles.drivers()) == bundled_look().wrinkle_masks.shape[1]
    for drivers in wrinkles.drivers():
        assert drivers
        assert set(drivers) <= set(rig.shape_names)
        # Below 0 a muscle smooths the lines of another out.
        assert all(0 < abs(gain) <= 1 for gain in drivers.values())
        assert max(drivers.values()) > 0.4


def test_every_group_says_how_much_of_it_rests_and_no_fold_crosses_the_nose_but_at_its_root():
    assert len(wrinkles.rests()) == len(wrinkles.groups())
    assert all(0 < rest <= 1 for rest in wrinkles.rests())
    bunny = next(group for group in wrinkles.groups() if group.name == "bunny lines")
    assert all(min(abs(x) for x, _ in line.points) > 0.05 for line in bunny.lines)
    bridge = next(group for group in wrinkles.groups() if group.name == "bridge")
    assert all(y > -0.02 for line in bridge.lines for _, y in line.points)


def test_wrinkles_mirror():
    place = np.random.default_rng(1).uniform((-0.8, -1.2, -0.5), (0.8, 0.8, 0.4), (500, 3)).astype(np.float32)
    names = [group.name for group in wrinkles.groups()]
    swap = [names.index(n.replace("left", "?").replace("right", "left").replace("?", "right")) for n in names]
    assert wrinkles.masks(place * (-1, 1, 1)) == pytest.approx(wrinkles.masks(place)[:, swap], abs=1e-6)


CROWN, FOREHEAD, CHEEK, NAPE = PLACES = np.array(
    [[0, 1.1, -0.6], [0, 0.4, 0.25], [0.6, -0.6, -0.2], [0, 0.2, -1.6]], np.float32
)


def test_hair_grows_on_the_crown_and_not_in_the_face():
    inside = hair_field(PLACES, np.zeros(4, np.float32))
    assert (inside > 0.1).tolist() == [True, False, False, True]
    assert (hair_field(PLACES, np.ones(4, np.float32)) < -0.1).all()
    assert above_hairline(PLACES)[0] > 0 > above_hairline(PLACES)[1]


def test_the_top_goes_bald_and_a_wreath_stays():
    inside, lost = hair_field(PLACES, np.zeros(4, np.float32)), bald_field(PLACES)
    assert inside[0] - lost[0] < 0
    assert inside[3] - lost[3] > 0.1


def test_hair_stands_off_most_on_the_crown_and_not_on_ears():
    lift = lift_field(PLACES, np.zeros(4, np.float32))
    assert lift[0] == lift.max() > lift[3] > 0
    assert (lift_field(PLACES, np.ones(4, np.float32)) == 0).all()


def test_hair_is_combed_along_the_skin_down_at_the_sides_and_off_the_face():
    normal = np.array([[0, 1, 0], [0, 0.6, 0.8], [0.98, 0, 0.2], [0, 0, -1]], np.float32)
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    place = np.array([[0.1, 1.18, -0.5], [0, 0.75, 0.2], [0.75, 0.2, -0.5], NAPE], np.float32)
    way = combing(place, normal)
    assert np.linalg.norm(way, axis=1) == pytest.approx(1, abs=1e-5)
    assert (way * normal).sum(1) == pytest.approx(0, abs=1e-5)
    assert way[1, 2] < 0  # back from the forehead
    assert (way[2:, 1] < -0.5).all()


def test_brows_get_denser_level_by_level_and_their_hairs_lie_inside():
    width, height = BROW_SIZE
    stack = brow_stack().reshape(2, LEVELS + 1, height, width).astype(int)
    levels = stack[:, :LEVELS]
    assert (np.diff(levels, axis=1) >= 0).all()
    assert (np.diff(levels.sum((2, 3)), axis=1) > 0).all()
    for edge in (levels[..., 0, :], levels[..., -1, :], levels[..., 0], levels[..., -1]):
        assert edge.mean() < 1
    assert (levels[0] != levels[1]).any()


def test_stubble_grows_only_in_the_beard(canvas):
    beard = (canvas.y < -0.6).astype(np.float32)
    hairs = stubble(canvas, beard)
    assert hairs[beard > 0].mean() > 20 * hairs[canvas.y > -0.5].mean()
    assert hairs.max() <= 1


@pytest.fixture(scope="module")
def canvas():
    """A ball of 40 000 texels instead of a head."""
    size = 200
    rows, columns = np.mgrid[:size, :size]
    azimuth, height = (columns / size - 0.5) * 2 * np.pi, 1 - 2 * (rows + 0.5) / size
    flat = np.sqrt(1 - height**2)
    normal = np.stack([flat * np.sin(azimuth), height, flat * np.cos(azimuth)], -1).reshape(-1, 3).astype(np.float32)
    everywhere = np.arange(size * size)
    skin, nowhere = np.zeros(size * size, np.int8), np.zeros((size * size, 2), np.float32)
    return Canvas(size, everywhere, normal * 1.1, normal, skin, nowhere, None)


def test_strands_run_along_the_combing_and_coils_do_not(canvas):
    hair = np.zeros((100, 100), bool)
    hair[:40] = True
    image = strands(canvas, 100, hair)
    assert (image[~hair] == 0.5).all()
    assert 0 <= image.min() <= image.max() <= 1
    assert image[hair].mean() == pytest.approx(0.5, abs=0.05)
    # At the sides hair hangs: brightness changes less downwards than across.
    side = image[20:38, 70:80]
    assert np.abs(np.diff(side, axis=0)).mean() < 0.7 * np.abs(np.diff(side, axis=1)).mean()
    grains = coils(canvas)
    assert 0 <= grains.min() <= grains.max() <= 1
    assert 0 <= sheen(canvas).min() <= sheen(canvas).max() <= 1


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
