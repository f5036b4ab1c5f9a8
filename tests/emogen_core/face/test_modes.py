"""Files of identity modes: what was written comes back, and nothing else is believed."""

from dataclasses import replace

import numpy as np
import pytest

from emogen_core.errors import InvalidInputError, RigFileError
from emogen_core.face.container import read_container, write_container
from emogen_core.face.modes import KIND, PLAUSIBLE, STEPS_PER_MILLIMETRE, VERSION, ModeSpace, load_modes, save_modes
from tests.rig_factory import VERTICES, small_rig

RIG = small_rig()
_RANDOM = np.random.default_rng(1)
MODES = {name: (9 * _RANDOM.normal(size=(VERTICES, 3))).astype(np.float32) for name in ("identity000", "identity001")}
SPACE = ModeSpace(RIG.hash, MODES)


def test_modes_come_back_within_half_a_step(tmp_path):
    stored = save_modes(SPACE, tmp_path / "a.modes")
    again = load_modes(tmp_path / "a.modes")
    assert (again.rig, again.hash) == (RIG.hash, stored.hash)
    assert list(again.modes) == list(MODES)
    for name, offsets in MODES.items():
        assert np.array_equal(again.modes[name], stored.modes[name])
        assert np.abs(again.modes[name] - offsets).max() <= 0.501 / STEPS_PER_MILLIMETRE
    assert save_modes(again, tmp_path / "b.modes").hash == stored.hash
    again.check_rig(RIG)


def test_the_hash_tells_rig_names_and_offsets_apart(tmp_path):
    others = (
        SPACE, replace(SPACE, rig="0" * 64), replace(SPACE, modes=dict(zip("ab", MODES.values(), strict=True))),
        replace(SPACE, modes={**MODES, "identity001": MODES["identity001"] + 1}),
    )  # fmt: skip
    assert len({save_modes(space, tmp_path / "a.modes").hash for space in others}) == len(others)


@pytest.mark.parametrize(
    ("modes", "why"),
    [
        ({}, "modes of one mesh"), ({"a": np.zeros((4, 3)), "b": np.zeros((5, 3))}, "modes of one mesh"),
        ({"a": np.full((4, 3), 256.0)}, "modes below 256 mm"), ({"a": np.full((4, 3), np.nan)}, "finite"),
        ({"": np.zeros((4, 3))}, "names of 1 to 80"), ({"a": np.zeros((4, 2))}, "three coordinates"),
    ],
)  # fmt: skip
def test_what_is_no_space_is_not_written(tmp_path, modes, why):
    with pytest.raises(RigFileError, match=why):
        save_modes(ModeSpace(RIG.hash, modes), tmp_path / "a.modes")


def test_a_file_that_says_something_else_is_refused(tmp_path):
    path = tmp_path / "a.modes"
    save_modes(SPACE, path)
    document, arrays, _ = read_container(path, KIND, VERSION)
    wrong = (
        ({**document, "modes": ["a", "a"]}, arrays), ({**document, "modes": ["a"]}, arrays), ({"rig": "x"}, arrays),
        (document, {**arrays, "mode/0000": arrays["mode/0000"].astype(np.int32)}),
        (document, {**arrays, "mode/0000": arrays["mode/0000"][:, 1:]}),
    )  # fmt: skip
    for one in wrong:
        write_container(path, KIND, VERSION, *one)
        with pytest.raises(RigFileError):
            load_modes(path)
    path.write_bytes(b"no container")
    with pytest.raises(RigFileError):
        load_modes(path)


def test_modes_of_another_rig_are_refused():
    with pytest.raises(RigFileError, match=r"modes of the rig .*, got"):
        SPACE.check_rig(small_rig(8))
    with pytest.raises(RigFileError, match="mode identity000"):
        ModeSpace(RIG.hash, {"identity000": np.zeros((3, 3))}).check_rig(RIG)


@pytest.mark.parametrize(
    "weights", [{"identity002": 1.0}, {"identity000": PLAUSIBLE + 1e-4}, {"identity001": float("nan")}]
)
def test_weights_that_are_not_plausible_are_named(weights):
    SPACE.check({"identity000": PLAUSIBLE, "identity001": -PLAUSIBLE})
    with pytest.raises(InvalidInputError, match=next(iter(weights))):
        SPACE.check(weights)
