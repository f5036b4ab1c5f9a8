"""A fitted head as plain data: the same one that a rig wears, and one at rest that is named apart."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from emogen_core.errors import IdentityError
from emogen_core.face.appearance import Appearance
from emogen_core.face.bundled import load_bundled_rig
from emogen_core.face.identity import Identity, read_identity, signed_document, worn_as
from emogen_core.face.space_file import load_bundled_space
from emogen_core.rigs.default_look import default_appearance
from emogen_core.rigs.identities import preset
from emogen_core.rigs.wear import fit_head, wear, worn_name

RIG, SPACE = load_bundled_rig(), load_bundled_space()
SOME = Identity("Somebody", {"sex": 1.0, "age": 52.0, "nose-width": 0.4})


@pytest.fixture(scope="module")
def head():
    return fit_head(RIG, SPACE, SOME)


def test_a_rig_wears_what_was_fitted(head):
    worn, name = wear(RIG, SPACE, SOME)
    assert name == head.name == worn_as(signed_document(SOME, SPACE)["hash"])
    assert np.array_equal(worn.neutral(name), head.neutral)
    assert np.array_equal(worn.adjustments[name].offsets, head.adjustment.offsets)
    assert wear(worn, SPACE, SOME) == (worn, name)


def test_a_head_at_rest_has_the_same_neutral_and_another_name(head):
    still = fit_head(RIG, SPACE, SOME, moving=False)
    assert np.array_equal(still.neutral, head.neutral)
    assert (still.name, still.adjustment) == (f"{head.name}-still", None)


def test_it_borrows_light_from_the_nearest_preset_and_wears_the_look_of_its_years(head):
    assert head.like == "male"
    assert Appearance.from_document(dict(head.appearance)) == default_appearance(SOME.head, SPACE)
    still = fit_head(RIG, SPACE, SOME, moving=False)
    assert (still.style, still.like) == (head.style, head.like)


@pytest.mark.parametrize("name", ["female", "asian-male-old"])
def test_a_preset_wears_the_style_that_its_look_file_holds(name):
    assert fit_head(RIG, SPACE, preset(name), moving=False).style == name


def test_an_appearance_in_the_document_wins():
    own = Appearance(skin_depth=0.9).to_document()
    dressed = fit_head(RIG, SPACE, replace(SOME, appearance=own), moving=False)
    assert dressed.appearance == own


def test_heads_of_one_look_share_its_textures():
    wide = replace(SOME, head={**SOME.head, "nose-width": 1.0})
    styles = {fit_head(RIG, SPACE, identity, moving=False).style for identity in (SOME, wide)}
    assert len(styles) == 1


def test_a_signed_document_reads_back_under_the_same_name():
    assert worn_name(read_identity(signed_document(SOME, SPACE), SPACE), SPACE) == worn_name(SOME, SPACE)


def test_children_are_worn_only_when_asked_for():
    with pytest.raises(IdentityError, match="at least 18"):
        wear(RIG, SPACE, Identity("Child", {"age": 12.0}))
