"""One face, large, by one command."""

import io

import numpy as np
import pytest
from PIL import Image

from emogen_core.errors import InvalidInputError
from emogen_core.face.bundled import load_bundled_rig
from emogen_core.rigs.close_up import close_up, genome

rig = load_bundled_rig()


@pytest.mark.gl
def test_it_is_the_face_asked_for():
    calm, smiling = (
        np.asarray(Image.open(io.BytesIO(close_up("male", genes, size=200)))).astype(int)
        for genes in ((), ("mouthSmile=1",))
    )
    assert calm.shape == (200, 200, 3)
    changed = np.abs(smiling - calm).max(2) > 20
    assert changed[100:].sum() > 10 * changed[:60].sum() > -1
    assert changed[100:].sum() > 100


def test_genes_are_set_after_the_emotion():
    happy = rig.emotion_sets["happy"]
    genes = genome(rig, ["mouthSmile=0.25", "jawOpen=0.5"], "happy")
    assert genes[rig.gene_names.index("mouthSmile")] == 0.25
    assert genes[rig.gene_names.index("jawOpen")] == 0.5
    assert (
        genes[rig.gene_names.index("cheekRaise")] == dict(zip(happy.genes, happy.strengths, strict=True))["cheekRaise"]
    )
    assert (genes > 0).sum() == len(happy.genes) + 1


@pytest.mark.parametrize("word", ["mouthSmile", "mouthSmile=", "mouthSmile=much", "noSuchGene=1"])
def test_a_word_that_is_no_gene_and_value_is_refused(word):
    with pytest.raises(InvalidInputError, match="expected"):
        genome(rig, [word])


def test_an_unknown_emotion_is_refused():
    with pytest.raises(InvalidInputError, match="glad"):
        genome(rig, [], "glad")
