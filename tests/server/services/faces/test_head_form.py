"""A head as a form and back: nothing is lost on the way, and what is wrong is named."""

from __future__ import annotations

import numpy as np
import pytest

from emogen_core.face.appearance import Appearance
from emogen_core.face.identity import Identity, identity_hash, read_identity
from emogen_core.face.space import ANCESTRIES
from emogen_core.face.space_file import load_bundled_space
from emogen_core.rigs.identities import IDENTITIES
from server.services.errors import InvalidError
from server.services.faces import head_form

SPACE = load_bundled_space()
LOOK = Appearance(skin_depth=0.815, iris_colour=(1, 200, 255), undertone=-0.5)


def some_head(seed):
    rng = np.random.default_rng(seed)
    point = {"sex": round(rng.random(), 2), "age": round(rng.uniform(18, 90), 1)}
    point |= {name: round(float(rng.uniform(SPACE.ranges[name].low, 1)), 2) for name in SPACE.details}
    return Identity(f"head {seed}", point, LOOK.to_document() if seed % 2 else {})


@pytest.mark.parametrize("seed", range(4))
def test_a_head_comes_back_as_itself(seed):
    identity = some_head(seed)
    form = dict(head_form.fields(identity, LOOK, SPACE))
    again = read_identity(head_form.document(form, SPACE), SPACE)
    assert identity_hash(again, SPACE) == identity_hash(identity, SPACE)
    assert again.name == identity.name


@pytest.mark.parametrize("name", IDENTITIES)
def test_every_preset_stands_on_its_sliders(name):
    form = dict(head_form.fields(Identity(name, IDENTITIES[name]), LOOK, SPACE))
    again = read_identity(head_form.document(form, SPACE), SPACE)
    assert identity_hash(again, SPACE) == identity_hash(Identity(name, IDENTITIES[name]), SPACE)


def test_every_parameter_has_one_labelled_control_within_its_bounds():
    controls = [c for some in head_form.groups(Identity("x", {}), SPACE).values() for c in some]
    assert sorted(control.name for control in controls) == sorted(SPACE.ranges)
    looks = [c for some in head_form.looks(LOOK).values() for c in some]
    assert sorted(c.name for c in looks) == sorted(f"look.{name}" for name in LOOK.to_document())
    for control in (*controls, *looks):
        assert control.label and control.hint
        assert control.colour or control.low <= float(control.value) <= control.high


def test_amounts_of_ancestry_become_shares():
    form = dict.fromkeys(ANCESTRIES, "0.7")
    head = read_identity(head_form.document(form, SPACE), SPACE).head
    assert [head[name] for name in ANCESTRIES] == pytest.approx([1 / 3] * 3, abs=1e-4)


@pytest.mark.parametrize(
    ("field", "text", "wanted"),
    [
        ("nose-width", "wide", "a number"),
        ("look.skin_depth", "dark", "a number"),
        ("look.iris_colour", "blue", "a colour"),
        ("ancestry", "", "above 0"),
    ],
)
def test_what_cannot_be_read_is_named(field, text, wanted):
    form = {head_form.OWN_LOOK: "1", field: text} if text else dict.fromkeys(ANCESTRIES, "0")
    with pytest.raises(InvalidError) as caught:
        head_form.document(form, SPACE)
    assert (caught.value.field, wanted in str(caught.value.expected)) == (field, True)
