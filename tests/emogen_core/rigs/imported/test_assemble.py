"""The bundled head comes back as it was; other heads lose what their files lack, and say so."""

import io
import os
import re
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from emogen_core.correctives.collision import has_regions
from emogen_core.correctives.pipeline import shape_weights
from emogen_core.errors import InvalidInputError
from emogen_core.face.bundled import load_bundled_rig
from emogen_core.face.evaluate import vertices
from emogen_core.face.rig_file import load_rig, save_rig
from emogen_core.rendering.look import load_look, save_look
from emogen_core.rendering.protocol import RenderSettings
from emogen_core.rendering.setup import make_renderer
from emogen_core.rigs.collision_check import check_collisions
from emogen_core.rigs.foreign.model import HeadModel
from emogen_core.rigs.imported.assemble import Wishes, import_head
from tests.emogen_core.rigs.foreign.heads import gltf_of, made_head, write_folder
from tests.emogen_core.rigs.imported.conftest import WHO

bundled = load_bundled_rig()


def test_genes_shapes_and_vertices_come_back(imported):
    check_same(imported)


def check_same(made):
    rig, sealed = made.rig, sealed_shapes(made)
    assert set(rig.genes) == set(bundled.genes)
    theirs = dict(zip(bundled.shape_names, bundled.shape_offsets(WHO), strict=True))
    for name, offsets in zip(rig.core_shapes, rig.offsets, strict=False):
        assert np.abs(offsets - theirs[name]).max() < (1 if name in sealed else 1e-4), name
    assert np.abs(rig.neutral("neutral") - bundled.neutral(WHO)).max() < 0.05
    assert np.array_equal(rig.mirror, bundled.mirror)
    assert np.array_equal(rig.regions["brows"], np.sort(bundled.regions["brows"]))
    assert {name: last - first for name, (first, last) in rig.parts.items()} == {
        name: last - first for name, (first, last) in bundled.parts.items()
    }


def sealed_shapes(made):
    """Return the core shapes whose lips the import sealed, as its report says."""
    told = " ".join(sentence for sentence in made.findings.found if sentence.startswith("Sealed"))
    return {member for gene in made.rig.genes for member in gene.members if gene.name in re.findall(r"\w+", told)}


def test_a_folder_of_objs_gives_the_same_as_gltf(imported, tmp_path):
    offsets = dict(zip(bundled.shape_names, bundled.shape_offsets(WHO), strict=True))
    own = {name: offsets[name] for name in bundled.core_shapes}
    model = HeadModel("theirs", bundled.neutral(WHO), bundled.triangles, bundled.parts, own)
    write_folder(tmp_path / "theirs", model)
    made = import_head(tmp_path / "theirs", Wishes(wears=WHO, combinations=False))
    rig = made.rig
    check_same(made)
    assert rig.gene_names == imported.rig.gene_names
    assert np.array_equal(rig.triangles, imported.rig.triangles)
    assert dict(rig.emotion_sets) == dict(imported.rig.emotion_sets)
    assert np.abs(rig.offsets - imported.rig.offsets).max() < 1e-3


def test_emotions_are_the_same_faces(imported):
    rig, sealed = imported.rig, sealed_shapes(imported)
    assert dict(rig.emotion_sets) == dict(bundled.emotion_sets)
    for emotion in bundled.emotion_sets:
        faces = [
            vertices(one, who, only_core(one, one.emotion_genes(emotion), without=sealed))[0]
            for one, who in ((rig, "neutral"), (bundled, WHO))
        ]
        assert np.abs(faces[0] - faces[1]).max() < 0.06, emotion


def only_core(rig, genes, without):
    weights = shape_weights(rig, genes[None])
    weights[:, len(rig.core_shapes) :] = 0
    weights[:, [rig.core_shapes.index(name) for name in without]] = 0
    return weights


def test_its_lips_are_kept_apart_as_the_bundled_ones(imported):
    # The same genes in the same order make the same random faces.
    assert imported.rig.gene_names == bundled.gene_names
    found = check_collisions(imported.rig, "neutral", faces=60)
    assert not found["neutral_collides"]
    assert found["untouched_identical"]
    assert found["collided"]["any"] > 0.1
    assert found["depth_before_mm"]["max"] > 1
    assert found["over_half_mm_after"] <= 0.02


def test_it_is_stored_and_drawn(imported, tmp_path):
    save_rig(imported.rig, tmp_path / "head.rig")
    save_look(tmp_path / "head.look", imported.look)
    load_look(tmp_path / "head.look").check(load_rig(tmp_path / "head.rig"))
    pictures = []
    for rig, who in ((tmp_path / "head.rig", "neutral"), (None, WHO)):
        renderer, model = make_renderer("software", rig)
        weights = np.zeros((1, len(model.shape_names)), np.float32)
        pictures.append(renderer.draw(who, weights, RenderSettings(96, 96))[0].astype(int))
        renderer.close()
    # The same head in the same skin: only what moved by the overlay's tenths of a millimetre differs.
    assert np.abs(pictures[0] - pictures[1]).mean() < 1.5


@pytest.mark.gl
def test_sheets_and_portraits_take_the_file(imported, tmp_path):
    from emogen_core.rigs.close_up import close_up
    from emogen_core.rigs.sheets import make_sheets

    save_rig(imported.rig, tmp_path / "head.rig")
    save_look(tmp_path / "head.look", imported.look)
    mine = picture(close_up(emotion="happy", size=160, rig=tmp_path / "head.rig"))
    theirs = picture(close_up(WHO, emotion="happy", size=160))
    # The bundled rig's correctives of pairs are not in it.
    assert np.abs(mine - theirs).mean() < 2.5
    [sheet] = make_sheets(tmp_path / "sheets", only=["identities"], rig=tmp_path / "head.rig")
    assert picture(sheet.read_bytes()).std() > 20
    with pytest.raises(InvalidInputError, match=r"sheets: expected of this rig .*'genes'.*got \['appearance'\]"):
        make_sheets(tmp_path / "none", only=["appearance"], rig=tmp_path / "head.rig")


def picture(data):
    with Image.open(io.BytesIO(data)) as image:
        return np.asarray(image.convert("RGB")).astype(int)


def test_its_skin_lies_where_it_lay(imported):
    mine = imported.look.layers["skin"]
    theirs = load_look_of_bundled().layers["skin"]
    at = {}
    for source, uv in zip(theirs.source, theirs.uv, strict=True):
        at.setdefault(int(source), []).append(uv)
    gaps = [
        min(np.linalg.norm(uv - other) for other in at[int(source)])
        for source, uv, kind in zip(mine.source, mine.uv, mine.surface[:, 0], strict=True)
        if int(source) in at and kind > 0.95
    ]
    assert np.quantile(gaps, 0.98) < 0.002


def load_look_of_bundled():
    from emogen_core.rendering.setup import bundled_look

    return bundled_look()


@pytest.mark.parametrize("lacking", ["eye", "teeth"])
def test_a_head_without_eyes_or_teeth_works_and_says_so(head_file, tmp_path, monkeypatch, lacking):
    monkeypatch.setattr("emogen_core.rigs.imported.assemble.read_head", without(lacking))
    made = import_head(head_file, Wishes(combinations=False))
    save_rig(made.rig, tmp_path / "head.rig")
    save_look(tmp_path / "head.look", made.look)
    made.look.check(made.rig)
    assert not any(name.startswith(lacking) for name in made.rig.parts)
    assert has_regions(made.rig) == (lacking == "eye")
    assert ("eyes" in made.look.layers) == (lacking == "teeth")
    told = " ".join(made.findings.missing)
    assert {"eye": "No part is named as eyes", "teeth": "Collisions of the lips are not corrected"}[lacking] in told


def without(part):
    """Return a reader that loses the triangles of some parts."""
    from dataclasses import replace

    from emogen_core.rigs.foreign import read
    from emogen_core.rigs.foreign.parts import say_roles

    def reading(*arguments):
        head = read.read_head(*arguments)
        model, rows, start = head.model, {}, 0
        for name, (first, last) in model.parts.items():
            if not name.startswith(part):
                rows[name] = (start, start + last - first)
                start += last - first
        kept = np.concatenate([model.triangles[slice(*model.parts[name])] for name in rows])
        lost = replace(model, triangles=kept, parts=rows)
        say_roles(lost, head.findings)
        regions = {name: found for name, found in head.regions.items() if not name.startswith(part)}
        return replace(head, model=lost, regions=regions)

    return reading


def test_a_head_with_no_face_to_speak_of_is_drawn_in_flat_colours(tmp_path, monkeypatch):
    monkeypatch.setattr("emogen_core.rigs.imported.assemble.read_head", without("Eye"))
    model = made_head()
    model.expressions.pop("jawOpen")
    (tmp_path / "ball.glb").write_bytes(gltf_of(model).glb())
    made = import_head(tmp_path / "ball.glb", Wishes(combinations=False))
    made.look.check(made.rig)
    assert "plain" in made.look.name
    assert not made.rig.collision_shapes
    assert any("flat colours" in sentence for sentence in made.findings.missing)
    assert {"gazeLeft", "mouthSmile", "lidsClose"} <= set(made.rig.gene_names)


def test_identity_modes_make_other_heads(tmp_path):
    model = made_head()
    wide = np.zeros_like(model.vertices)
    wide[:, 0] = 0.05 * model.vertices[:, 0]
    modes = {"identity000": wide}
    folder = write_folder(tmp_path / "kit" / "FaceXModel", made_head(identity_modes=modes), "generic_neutral_mesh")
    made = import_head(folder.parent, Wishes(heads={"anna": {"identity000": 1.5}}, random=2, combinations=False))
    rig = made.rig
    assert rig.identities == ("neutral", "anna", "random-1", "random-2")
    widths = {name: np.ptp(rig.neutral(name)[:, 0]) for name in rig.identities}
    assert widths["anna"] == pytest.approx(1.075 * widths["neutral"], rel=1e-4)
    assert all(0.9 <= widths[name] / widths["neutral"] <= 1.1 for name in rig.identities)
    assert widths["random-1"] != widths["random-2"]
    again = import_head(folder.parent, Wishes(random=2, combinations=False)).rig
    assert np.array_equal(again.neutral("random-2"), rig.neutral("random-2"))


def test_heads_need_modes(tmp_path):
    (tmp_path / "ball.glb").write_bytes(gltf_of(made_head()).glb())
    with pytest.raises(InvalidInputError, match="heads: expected a model with identity modes"):
        import_head(tmp_path / "ball.glb", Wishes(random=1, combinations=False))


def test_nobody_wears_an_unknown_skin(head_file):
    with pytest.raises(InvalidInputError, match="wears: expected one of"):
        import_head(head_file, Wishes(wears="nobody"))


@pytest.mark.skipif("EMOGEN_ICT_FACEKIT" not in os.environ, reason="EMOGEN_ICT_FACEKIT names no folder")
def test_ict_facekit_becomes_a_rig():
    made = import_head(Path(os.environ["EMOGEN_ICT_FACEKIT"]), Wishes(random=1, combinations=False))
    rig = made.rig
    assert {"mouthSmile", "lidsClose", "jawOpen", "gazeLeft", "mouthFunnel"} <= set(rig.gene_names)
    assert has_regions(rig)
    assert {"skin", "eyes", "lashes"} == set(made.look.layers)
    assert set(made.look.edges) == {
        f"{part}_{half}" for part in ("left", "right", "mouth") for half in ("upper", "lower")
    }
    # Gaze turns the eyeballs about their middles: no vertex comes nearer to it or goes farther.
    eye = np.unique(rig.triangles[slice(*rig.parts["eye_left"])])
    centre = np.mean([rig.neutral("neutral")[eye].min(0), rig.neutral("neutral")[eye].max(0)], axis=0) * (1, 1, 0)
    offsets = rig.offsets[rig.core_shapes.index("gazeLeft.L")][eye]
    assert 4 < np.abs(offsets).max() < 7
    before = np.linalg.norm(rig.neutral("neutral")[eye] - centre, axis=1)
    after = np.linalg.norm(rig.neutral("neutral")[eye] + offsets - centre, axis=1)
    assert np.abs(after - before).max() < 0.5
    found = check_collisions(rig, "neutral", faces=40)
    assert not found["neutral_collides"]
    assert found["over_half_mm_after"] <= 0.05
