"""Expressions become genes under the names of this house."""

import numpy as np
import pytest

from emogen_core.errors import InvalidInputError
from emogen_core.rigs.emotion_sets import EMOTION_SETS
from emogen_core.rigs.foreign.model import Findings
from emogen_core.rigs.foreign.pairs import find_pairs
from emogen_core.rigs.foreign.read import ReadHead
from emogen_core.rigs.gene_table import RECIPES
from emogen_core.rigs.imported.emotions import emotion_sets
from emogen_core.rigs.imported.genes import gene_offsets, make_genes
from tests.emogen_core.rigs.foreign.heads import made_head

model = made_head()
SMILE = model.expressions["mouthSmile_L"] + model.expressions["mouthSmile_R"]


def made(**expressions):
    head = made_head(expressions=expressions or dict(model.expressions))
    findings = Findings()
    return make_genes(ReadHead(head, find_pairs(head, findings), {}, findings)), findings


def test_known_names_become_the_bundled_ones():
    found, _ = made()
    genes = {gene.name: gene for gene in found.genes}
    assert [*genes] == ["browInnerUp", "lidsClose", "gazeLeft", "gazeRight", "jawOpen", "mouthSmile", "mouthFunnel"]
    recipes = {recipe.name: recipe.gene for recipe in RECIPES}
    for name in genes.keys() - {"mouthFunnel"}:
        assert genes[name] == recipes[name]
    assert np.array_equal(found.shapes["lidsClose.L"], model.expressions["eyeBlink_L"])
    assert np.array_equal(found.shapes["gazeLeft.R"], model.expressions["eyeLookIn_R"])
    assert np.array_equal(found.correctives["mouthClose"], model.expressions["mouthClose"])
    assert "mouthClose" not in genes
    assert np.allclose(gene_offsets(found.genes, found.shapes)["mouthSmile"], SMILE)


def test_brows_and_cheeks_of_one_shape_are_cut_in_two():
    whole = model.expressions["browInnerUp_L"] + model.expressions["browInnerUp_R"]
    found, _ = made(browInnerUp=whole, jawOpen=model.expressions["jawOpen"])
    left, right = found.shapes["browInnerUp.L"], found.shapes["browInnerUp.R"]
    assert np.allclose(left + right, whole, atol=1e-6)
    far = model.vertices[:, 0] < -10
    assert not left[far].any()
    assert right[far].any()


def test_half_a_pair_is_lateral():
    found, findings = made(mouthSmile_L=model.expressions["mouthSmile_L"], jawOpen=model.expressions["jawOpen"])
    [smile] = [gene for gene in found.genes if "Smile" in gene.name]
    assert (smile.name, smile.members, smile.flags) == ("mouthSmile.L", ("mouthSmile.L",), {"lateral"})
    assert any("moves one side only" in sentence for sentence in findings.guessed)


def test_own_names_are_kept_where_they_move_the_face():
    found, _ = made(weird_L=model.expressions["eyeBlink_L"], weird_R=model.expressions["eyeBlink_R"], grin=SMILE)
    genes = {gene.name: gene for gene in found.genes}
    assert genes["weird"].region == "lid"
    assert genes["grin"].region == "mouth"
    assert genes["weird"].members == ("weird.L", "weird.R")
    assert genes["grin"].action_units == ()


def test_correctives_of_others_are_left_out():
    shapes = {"jawOpen": model.expressions["jawOpen"], "jawOpen+mouthSmile": SMILE, "lipsInnerLeft": SMILE}
    found, findings = made(**shapes)
    assert [*found.shapes] == ["jawOpen"]
    assert any(sentence.startswith("2 correctives were left out") for sentence in findings.found)


def test_one_movement_twice_is_refused():
    with pytest.raises(InvalidInputError, match="expressions: expected every movement once, got \\['mouthSmile'\\]"):
        made(mouthSmile=SMILE, **{f"mouthSmile_{s}": model.expressions[f"mouthSmile_{s}"] for s in "LR"})


def test_nothing_that_moves_is_refused():
    with pytest.raises(InvalidInputError, match="at least one that moves"):
        made(mouthSmile=0 * SMILE)


def test_a_mouth_close_that_nothing_brings_is_told():
    told = "mouthClose is not used: there is no mouthPress, which closes an open jaw with it."
    assert told in made()[1].missing
    pressing = {f"mouthPress_{side}": model.expressions[f"mouthSmile_{side}"] for side in "LR"}
    assert told not in made(**model.expressions, **pressing)[1].missing


ALL = tuple(recipe.gene for recipe in RECIPES)


def test_a_head_with_all_genes_has_the_bundled_emotions():
    findings = Findings()
    assert emotion_sets(ALL, findings) == dict(EMOTION_SETS)
    assert findings.missing == []


def test_a_gene_stands_in_for_those_that_are_missing():
    few = [gene for gene in ALL if gene.name in {"mouthSmile", "cheekRaise", "browDown"}]
    findings = Findings()
    found = emotion_sets(few, findings)
    assert dict(zip(found["happy"].genes, found["happy"].strengths, strict=True)) == {"mouthSmile": 1, "cheekRaise": 1}
    assert found["happy"].action_units == ("6", "12")
    assert "surprised" not in found
    assert any(
        sentence.startswith("surprised: nothing shows") and "cannot" in sentence for sentence in findings.missing
    )
    assert any(sentence.startswith("happy: nothing shows action unit 25") for sentence in findings.missing)


def test_genes_that_are_off_build_no_emotion():
    off = [gene for gene in ALL if gene.flags & {"lateral", "disabled"}]
    assert emotion_sets(off, Findings()) == {}
