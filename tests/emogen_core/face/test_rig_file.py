"""A rig file gives the rig that was saved, or an error that says what does not fit."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from emogen_core.errors import RigFileError
from emogen_core.face.container import read_container, write_container
from emogen_core.face.rig import Adjustment, Combination, EmotionSet
from emogen_core.face.rig_file import KIND, STEPS_PER_MILLIMETRE, VERSION, load_rig, save_rig
from tests.emogen_core.face.fuzz import fuzz
from tests.rig_factory import VERTICES, full_rig

STEP = 1 / STEPS_PER_MILLIMETRE


def check_same(a, b):
    assert a.hash == b.hash
    assert (a.genes, a.core_shapes, a.combinations, a.collision_shapes) == (
        b.genes, b.core_shapes, b.combinations, b.collision_shapes,
    )  # fmt: skip
    assert dict(a.emotion_sets) == dict(b.emotion_sets)
    assert dict(a.parts) == dict(b.parts)
    assert a.identities == b.identities
    pairs = [(a.offsets, b.offsets), (a.triangles, b.triangles), (a.mirror, b.mirror)]
    pairs += [(a.neutrals[n], b.neutrals[n]) for n in a.neutrals]
    pairs += [(a.regions[n], b.regions[n]) for n in a.regions]
    pairs += [(a.adjustments[n].offsets, b.adjustments[n].offsets) for n in a.adjustments]
    pairs += [(a.adjustments[n].shapes, b.adjustments[n].shapes) for n in a.adjustments]
    assert all(np.array_equal(x, y) and x.dtype == y.dtype for x, y in pairs)


def test_a_saved_rig_is_loaded(tmp_path):
    saved = save_rig(full_rig(), tmp_path / "a.rig")
    check_same(saved, load_rig(tmp_path / "a.rig"))


def test_saving_rounds_by_at_most_a_step_and_only_once(tmp_path):
    rig = full_rig()
    saved = save_rig(rig, tmp_path / "a.rig")
    assert np.abs(saved.offsets - rig.offsets).max() <= STEP
    assert save_rig(saved, tmp_path / "b.rig").hash == saved.hash
    assert (tmp_path / "a.rig").read_bytes() == (tmp_path / "b.rig").read_bytes()


def test_the_hash_follows_the_meaning(tmp_path):
    saved = save_rig(full_rig(), tmp_path / "a.rig")
    moved = replace(saved, offsets=saved.offsets + np.float32(STEP))
    assert save_rig(moved, tmp_path / "b.rig").hash != saved.hash


def broken():
    rig = full_rig()
    nan = rig.offsets.copy()
    nan[0, 0, 0] = np.nan
    genes = rig.genes
    yield "offset", replace(rig, offsets=rig.offsets[:-1])
    yield "finite", replace(rig, offsets=nan)
    yield "64 mm", replace(rig, offsets=rig.offsets * 1000)
    yield "neutral", replace(rig, neutrals={"female": rig.neutrals["female"][:-1]})
    yield "identity", replace(rig, neutrals={}, adjustments={})
    yield "triangles", replace(rig, triangles=rig.triangles + VERTICES)
    yield "mirror", replace(rig, mirror=rig.mirror[:-1])
    yield "lips", replace(rig, regions={"lips": np.array([VERTICES], np.int32)})
    yield "part", replace(rig, parts={"skin": (1, VERTICES - 2)})
    yield "parts", replace(rig, parts={"skin": (0, 3)})
    yield "genes", replace(rig, genes=(*genes[1:], genes[1]))
    yield "flags", replace(rig, genes=(replace(genes[0], flags=frozenset({"odd"})), *genes[1:]))
    yield "region", replace(rig, genes=(replace(genes[0], region="elbow"), *genes[1:]))
    yield "members", replace(rig, genes=(replace(genes[0], members=("nothing",)), *genes[1:]))
    yield "members", replace(rig, genes=(replace(genes[0], members=genes[1].members), *genes[1:]))
    yield "parents", replace(rig, combinations=(Combination("c01", ("g0", "g1L")), rig.combinations[1]))
    yield "happy", replace(rig, emotion_sets={"happy": EmotionSet(("grin",), (1.0,), (), "nowhere")})
    for strengths in ((), (1.0, 1.0), (0.0,), (1.01,), (float("nan"),)):
        yield "strengths", replace(rig, emotion_sets={"happy": EmotionSet(("g0",), strengths, (), "nowhere")})
    yield "adjust", replace(rig, adjustments={"nobody": rig.adjustments["male"]})
    yield (
        "adjust",
        replace(rig, adjustments={"male": Adjustment(np.array([99]), np.zeros((1, VERTICES, 3), np.float32))}),
    )


@pytest.mark.parametrize(("said", "rig"), list(broken()))
def test_a_rig_that_contradicts_itself_is_not_saved(tmp_path, said, rig):
    with pytest.raises(RigFileError, match=said):
        save_rig(rig, tmp_path / "a.rig")
    assert not (tmp_path / "a.rig").exists()


def test_a_file_of_the_version_without_strengths_says_so(tmp_path):
    save_rig(full_rig(), tmp_path / "a.rig")
    document, arrays, _ = read_container(tmp_path / "a.rig", KIND, VERSION)
    write_container(tmp_path / "a.rig", KIND, 1, document, arrays)
    with pytest.raises(RigFileError, match="expected version 2, got 1"):
        load_rig(tmp_path / "a.rig")


def rewritten(tmp_path, change):
    """Store a rig, let ``change`` alter its document or arrays, and store that with a hash that fits."""
    save_rig(full_rig(), tmp_path / "a.rig")
    document, arrays, _ = read_container(tmp_path / "a.rig", KIND, VERSION)
    change(document, arrays)
    write_container(tmp_path / "a.rig", KIND, VERSION, document, arrays)
    return tmp_path / "a.rig"


@pytest.mark.parametrize(
    "change",
    [
        lambda d, _: d.pop("genes"),
        lambda d, _: d.update(vertices=10**9),
        lambda d, _: d.update(vertices="many"),
        lambda d, _: d.update(core_shapes="browUp"),
        lambda d, _: d.update(identities=["ghost"]),
        lambda d, _: d["genes"].__setitem__(0, None),
        lambda d, _: d["parts"].append(["nose"]),
        lambda _, a: a.pop("triangles"),
        lambda _, a: a.update({"offset/count": a["offset/count"] + 1}),
        lambda _, a: a.update({"offset/vertex": a["offset/vertex"] + VERTICES}),
        lambda _, a: a.update({"offset/vertex": -a["offset/vertex"] - 1}),
        lambda _, a: a.update({"adjusted/male/shapes": np.array([-1, 0], np.int32)}),
        lambda _, a: a.update({"adjusted/male/shapes": np.array([1, 1], np.int32)}),
        lambda _, a: a.update({"adjusted/male/shapes": a["adjusted/male/shapes"][:, None]}),
        lambda _, a: a.update({"triangles": a["triangles"].astype(np.float64)}),
        lambda _, a: a.update({"triangles": a["triangles"].ravel()}),
        lambda _, a: a.update({"neutral/male": a["neutral/male"].astype(np.float32)}),
        lambda _, a: a.update({"region/lips": a["region/lips"] > 2}),
        lambda d, a: (d.update(vertices=2**20), a.update({"offset/count": np.zeros(100, np.int32)})),
    ],
)
def test_a_file_whose_hash_fits_but_whose_content_does_not_is_refused(tmp_path, change):
    with pytest.raises(RigFileError, match="expected"):
        load_rig(rewritten(tmp_path, change))


def test_a_look_is_not_a_rig(tmp_path):
    write_container(tmp_path / "a.look", "look", VERSION, {}, {})
    with pytest.raises(RigFileError, match="expected kind rig"):
        load_rig(tmp_path / "a.look")


def test_a_damaged_rig_is_refused_in_one_line_or_sound(tmp_path):
    """A short run of fuzz.py."""
    found = fuzz(tmp_path, range(300))
    assert found["refused"] > 200
    assert sum(found.values()) == 300
