"""Every appearance composes, the same way each time, and every parameter does what its name says."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from emogen_core.errors import InvalidInputError, RigFileError
from emogen_core.face.appearance import Appearance, parameters
from emogen_core.rendering.composer import Composer
from emogen_core.rendering.composer.layers import RANGES, Layers, pack
from emogen_core.rendering.composer.tones import REFERENCE_TONES, lightness, natural_lips, skin_tone
from emogen_core.rendering.look import HAIR_DEPTH
from emogen_core.rendering.plain import plain_look
from emogen_core.rendering.setup import BUNDLED_LOOK, bundled_look
from tests.emogen_core.rendering.ball import ball_rig

LADDER = np.linspace(0, 1, 10)
PLAIN = Appearance()
AMOUNTS = [p for p in parameters() if "low" in p]
COLOURS = [p["name"] for p in parameters() if "low" not in p]


@pytest.fixture(scope="module")
def look():
    return bundled_look()


@pytest.fixture(scope="module")
def composer(look):
    return look.composer


@pytest.fixture(scope="module")
def plain(composer):
    return composer.skin(PLAIN).astype(int)


def cheeks(composer, look):
    return composer.skin(look).reshape(-1, 3)[composer._cheeks] / 255


def brow_box(composer):
    (top, left), (height, width) = composer._brows.corner, composer._brows.shape
    return slice(top, top + height), slice(left, left + width)


def test_the_same_appearance_gives_the_same_bytes_in_another_composer(look, composer):
    other = Composer(look.paint)
    wild = Appearance(**{p["name"]: (p["low"] + 2 * p["high"]) / 3 for p in AMOUNTS})
    for paint in ("skin", "eye", "lashes"):
        first = getattr(composer, paint)(wild)
        getattr(composer, paint)(PLAIN)
        assert first.tobytes() == getattr(composer, paint)(wild).tobytes() == getattr(other, paint)(wild).tobytes()


def test_every_preset_composes_and_no_two_are_alike(look):
    seen = set()
    for identity in look.styles:
        style = look.style(identity)
        skin = look.texture(style.skin)
        assert skin.shape == (1024, 1024, 3)
        assert look.texture(style.eyes, "RGBA").shape == (512, 512, 4)
        assert look.texture(style.lashes, "RGBA").shape == (256, 1024, 4)
        assert style.tone == look.composer.tone(style.appearance)
        seen.add(skin.tobytes())
    assert len(seen) == len(look.styles)


@pytest.mark.parametrize("undertone", [-1.0, 0.0, 1.0])
def test_deeper_skin_is_darker_all_the_way(undertone):
    tones = np.array([skin_tone(depth, undertone) for depth in np.linspace(0, 1, 200)])
    fall = np.diff(lightness(tones))
    assert (fall < 0).all()
    assert fall.min() > -0.9  # two hundred steps over some 70 units of lightness: no jumps
    assert ((tones > 0) & (tones < 1)).all()


def test_the_ladder_s_reference_tones_are_on_the_way():
    for depth, tone in zip(LADDER, REFERENCE_TONES.values(), strict=True):
        assert 255 * skin_tone(float(depth)) == pytest.approx(np.array(tone), abs=0.6)


def test_undertone_turns_skin_from_rosy_to_golden_at_the_same_lightness():
    rosy, even, golden = (skin_tone(0.4, u) for u in (-1, 0, 1))
    assert lightness(np.array([rosy, golden])) == pytest.approx(float(lightness(even)), abs=0.05)
    yellow = [float(tone[1] - tone[2]) for tone in (rosy, even, golden)]
    assert yellow == sorted(yellow)
    assert np.ptp(yellow) > 0.05


def test_natural_lips_are_redder_and_darker_than_their_skin():
    for depth in LADDER:
        skin, lips = 255 * skin_tone(float(depth)), np.array(natural_lips(float(depth)))
        assert (lips < skin).all()
        assert lips[0] / lips[1] > 1.2 * skin[0] / skin[1]


def test_painted_cheeks_darken_strictly_over_the_ladder(composer):
    means = [lightness(cheeks(composer, replace(PLAIN, skin_depth=float(depth)))).mean() for depth in LADDER]
    assert (np.diff(means) < -2).all()


def test_the_tone_is_the_mean_of_the_cheeks(composer):
    for depth in (0.0, 0.5, 1.0):
        look = replace(PLAIN, skin_depth=depth)
        assert composer.tone(look) == pytest.approx(cheeks(composer, look).mean(0), abs=0.02)


@settings(max_examples=15, deadline=None)
@given(st.floats(0.02, 1), st.floats(0, 0.98), st.floats(0, 1), st.floats(0, 1))
def test_denser_brows_cover_more_everywhere(composer, high, share, thickness, arch):
    look = replace(PLAIN, brow_thickness=thickness, brow_arch=arch)
    less, more = (composer._brows.coverage(replace(look, brow_density=d))[0] for d in (high * share, high))
    assert (more >= less - 1e-6).all()
    assert more.sum() > less.sum()
    assert 0 <= more.min() <= more.max() <= 1 + 1e-6


def test_brow_density_is_continuous_across_its_levels(composer):
    dense = [composer._brows.coverage(replace(PLAIN, brow_density=d))[0] for d in (0.4999, 0.5, 0.5001)]
    assert np.abs(np.diff(dense, axis=0)).max() < 0.002


def test_brows_are_about_as_dense_on_either_side(composer):
    cover, _ = composer._brows.coverage(PLAIN)
    left, right = np.array_split(cover.sum(0), 2)
    assert left.sum() == pytest.approx(right.sum(), rel=0.08)


def test_no_density_means_no_brows(composer, plain):
    bare = composer.skin(replace(PLAIN, brow_density=0.0)).astype(int)
    changed = (bare != plain).any(-1)
    inside = np.zeros_like(changed)
    inside[brow_box(composer)] = True
    assert not changed[~inside].any()
    assert (bare[brow_box(composer)].sum(-1) >= plain[brow_box(composer)].sum(-1) - 3).all()


@pytest.mark.parametrize("name", [p["name"] for p in AMOUNTS if p["name"] not in {"lines", "lashes"}])
def test_every_amount_shows_on_the_skin(composer, name):
    base = replace(PLAIN, stubble=0.3, balding=0.2, grey=0.3)
    bounds = next((p["low"], p["high"]) for p in AMOUNTS if p["name"] == name)
    low, high = (composer.skin(replace(base, **{name: value})).astype(int) for value in bounds)
    assert np.abs(low - high).max() > 12


@pytest.mark.parametrize("name", COLOURS)
def test_every_colour_shows_somewhere(composer, name):
    blue = replace(PLAIN, **{name: (20, 40, 250)})
    paint = composer.eye if name == "iris_colour" else composer.skin
    assert (paint(blue).astype(int) - paint(PLAIN))[..., 2].max() > 60


def test_lines_and_lashes_show_in_the_style(look):
    young, old = (look.with_style("x", replace(PLAIN, lines=n)).style("x") for n in (0.0, 1.0))
    assert (young.wrinkles, young.lines) < (old.wrinkles, old.lines)
    short, long = (look.composer.lashes(replace(PLAIN, lashes=n))[..., 3].astype(int) for n in (0.0, 1.0))
    assert long.sum() > 1.2 * short.sum()


def test_hair_stands_off_by_its_length_and_goes_with_baldness(composer):
    shaven, short, full, bald = (
        composer.hair(replace(PLAIN, hair_length=length, balding=balding))
        for length, balding in ((0, 0), (0.4, 0), (1, 0), (1, 1))
    )
    assert not shaven.any()
    assert 0 < short.max() < full.max() <= HAIR_DEPTH
    assert (short <= full + 1e-6).all()
    assert (bald <= full + 1e-6).all()
    assert bald.sum() < 0.25 * full.sum()


def test_balding_only_bares_skin(composer):
    hair = replace(PLAIN, hair_colour=(0, 0, 0), skin_depth=0.1)
    dark = [(composer.skin(replace(hair, balding=b)).sum(-1) < 120).sum() for b in (0.0, 0.5, 1.0)]
    assert dark[0] > 1.3 * dark[1] > 1.3 * dark[2]


@pytest.mark.parametrize("colour", [(74, 48, 32), (98, 124, 142), (110, 118, 70)])
def test_an_eye_has_a_dark_pupil_a_coloured_iris_a_darker_rim_and_a_sclera_that_is_not_white(composer, colour):
    eye = composer.eye(replace(PLAIN, iris_colour=colour)).astype(int)
    middle = len(eye) // 2
    rows, columns = np.mgrid[: len(eye), : len(eye)] + 0.5
    radius = np.hypot(rows - middle, columns - middle)
    pupil, iris, rim, sclera = (eye[np.abs(radius - r) < 1.5][:, :3].mean(0) for r in (8, 40, 54, 80))
    assert pupil.max() < 15
    assert iris == pytest.approx(colour, abs=32)
    assert rim.sum() < 0.75 * iris.sum()
    assert 170 < sclera.min() < sclera.max() < 240
    assert eye[middle, middle, 3] == 255
    assert eye[4, 4, 3] == 0


def test_a_custom_head_wears_its_own_style_and_the_rest_keeps_theirs(look):
    worn = replace(PLAIN, skin_depth=0.9, hair_length=1.0)
    dressed = look.with_style("somebody", worn, bake="male")
    style = dressed.style("somebody")
    assert style.appearance == worn
    assert dressed.texture(style.skin).tobytes() == look.composer.skin(worn).tobytes()
    assert np.array_equal(dressed.bakes[style.bake][:, :3], look.bakes["male"][:, :3])
    assert dressed.bakes[style.bake][:, 3].max() > look.bakes["male"][:, 3].max()
    assert dressed.style("male") == look.style("male")
    assert "somebody" not in look.styles


def test_a_bake_or_texture_that_is_not_there_is_named(look):
    with pytest.raises(InvalidInputError, match=r"bake: expected one of \['african-female-old'.*got 'nobody'"):
        look.with_style("somebody", PLAIN, bake="nobody")
    for name in ("skin-nobody", "hat-female", "nonsense"):
        with pytest.raises(InvalidInputError, match=f"texture: expected one of .*got '{name}'"):
            look.texture(name)


def test_a_look_without_paint_says_so():
    with pytest.raises(RigFileError, match="expected a layer 'blood', got"):
        plain_look(ball_rig()).with_style("somebody", PLAIN)


def test_layers_survive_their_file():
    ramps = {n: np.linspace(*bounds, 64, dtype=np.float32)[None].repeat(64, 0) for n, bounds in RANGES.items()}
    layers = Layers({name: pack(name, ramp) for name, ramp in ramps.items()})
    assert list(layers) == list(RANGES)
    assert len(layers) == len(RANGES)
    for name, (low, high) in RANGES.items():
        assert layers[name].reshape(64, 64) == pytest.approx(ramps[name], abs=0.02 * (high - low))


def test_the_file_stays_small():
    assert BUNDLED_LOOK.stat().st_size <= 4_000_000
