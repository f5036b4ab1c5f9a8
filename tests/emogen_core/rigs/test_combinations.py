"""Correctives of pairs: derived, measured and chosen."""

from dataclasses import dataclass

import numpy as np
import pytest

from emogen_core.rigs.candidates import EASED, GRADIENT_METHODS, OFFSET_METHODS, RULES, Deriver, Pair, overlap
from emogen_core.rigs.combinations import KEPT, Choice, choose_pairs
from emogen_core.rigs.company import Company
from emogen_core.rigs.quality import Gauge
from tests.emogen_core.rigs.patch import Patch, points


@dataclass
class FlatHead:
    neutral: np.ndarray
    eye_radius: float = 15.0


HEAD = FlatHead(points())
DERIVER = Deriver(Patch(), np.full_like(points(), 7.0))
WIDE = points() * (1.4, 0, 0)
LIFT = np.full_like(points(), 1.0) * (0, 0, 1)
GENES = {"wide": WIDE, "wider": WIDE * 1.1, "lift": LIFT, "still": 0 * LIFT}


def damage(*offsets):
    return Gauge(points(), Patch().triangles).damage(points() + sum(offsets))


def test_the_larger_of_two_aligned_shapes_is_left():
    genes = {"lift": LIFT, "higher": 1.5 * LIFT}
    joined = 2.5 * LIFT + DERIVER.derive(Pair(("lift", "higher"), "max"), HEAD, genes)
    assert joined == pytest.approx(1.5 * LIFT)
    joined = WIDE + GENES["wider"] + DERIVER.derive(Pair(("wide", "wider"), "gradient max"), HEAD, GENES)
    assert np.ptp(joined[:, 0]) == pytest.approx(np.ptp(GENES["wider"][:, 0]), rel=1e-3)


def test_shapes_that_do_not_agree_are_left_alone():
    assert DERIVER.derive(Pair(("wide", "lift"), "max"), HEAD, GENES) == pytest.approx(np.zeros_like(WIDE))


def test_rules_take_back_what_they_say():
    lids = {"lidsClose": WIDE, "lidsTight": LIFT, "gazeDown": 2 * LIFT}
    derive = DERIVER.derive
    assert derive(Pair(("lidsClose", "gazeDown"), "cancel"), HEAD, lids) == pytest.approx(-2 * LIFT)
    eased = derive(Pair(("gazeDown", "lidsTight"), "ease"), HEAD, lids)
    assert eased == pytest.approx(-EASED * LIFT)
    assert derive(Pair(("lidsClose", "gazeDown", "lidsTight"), "undo"), HEAD, lids) == pytest.approx(-eased)
    assert derive(Pair(("jawOpen", "mouthPress"), "close"), HEAD, lids) is DERIVER.shut


def test_overlap_is_where_both_move():
    half = WIDE * (points()[:, :1] > 0)
    assert np.array_equal(overlap(half, LIFT), points()[:, 0] > 0)


def choice(genes):
    return Choice(DERIVER, HEAD, genes)


def test_the_chosen_way_gains_and_mends():
    [parents] = choice(GENES).damaging_pairs()
    assert parents == ("wide", "wider")
    pair = choice(GENES).best(choice(GENES).glanced(parents))
    assert pair.gain > 0
    corrective = DERIVER.derive(pair, HEAD, GENES)
    assert damage(WIDE, GENES["wider"]).stretched > 0
    assert damage(WIDE, GENES["wider"], corrective).total == 0


def test_a_glance_leaves_the_better_way_of_each_kind():
    offsets, gradients = choice(GENES).glanced(("wide", "wider"))
    assert offsets.method in OFFSET_METHODS
    assert gradients.method in GRADIENT_METHODS
    assert not offsets.relaxed
    assert not gradients.relaxed


def test_pairs_that_break_nothing_or_have_a_rule_are_not_looked_at():
    assert choice({"wide": WIDE, "lift": LIFT}).damaging_pairs() == []
    assert choice({"mouthSmile": WIDE, "mouthSmileOpen": WIDE}).damaging_pairs() == []


def test_lids_are_spared_gradients_and_relaxing():
    # browDown moves the lids; their shapes are derived anew on every head, from offsets alone.
    head = FlatHead(points())
    head.eye_centre = np.array([500.0, 0, 0])
    lids = Choice(DERIVER, head, GENES | {"browDown": WIDE})
    [glanced] = lids.glanced(("browDown", "wider"))
    assert glanced.method in OFFSET_METHODS
    assert not lids.best([glanced]).relaxed


def test_rules_come_first_and_only_gaining_pairs_follow():
    brows = {"browInnerUp": LIFT, "browRaise": LIFT}
    pairs = choose_pairs(DERIVER, HEAD, GENES | brows, frozenset({"still"}))
    assert [pair.parents for pair in pairs] == [("browInnerUp", "browRaise"), ("wide", "wider")]
    assert len(pairs) <= KEPT
    assert choose_pairs(DERIVER, HEAD, GENES, frozenset({"wide", "still"})) == []


def test_a_head_has_the_rules_whose_genes_it_has():
    genes = {name for parents in RULES for name in parents}
    assert [pair.parents for pair in DERIVER.rules(genes)] == list(RULES)
    assert [pair.parents for pair in DERIVER.rules(genes - {"gazeDown"})] == [
        parents for parents in RULES if "gazeDown" not in parents
    ]
    # Without a shape that shuts the lips of an open jaw, pressed lips have no rule.
    without = Deriver(Patch(), None).rules(genes)
    assert {pair.parents for pair in DERIVER.rules(genes)} - {pair.parents for pair in without} == {
        ("jawOpen", "mouthPress")
    }


def test_a_head_without_eyes_has_no_eyeballs_to_clear():
    genes = {"lidsClose": LIFT, "lidsSlit": 0.5 * LIFT}
    head = FlatHead(points(), 0.0)
    joined = 1.5 * LIFT + DERIVER.derive(Pair(("lidsClose", "lidsSlit"), "max"), head, genes)
    assert joined == pytest.approx(LIFT)


@dataclass
class Fixed:
    """Derives the same corrective whatever the pair, and none for rules."""

    corrective: np.ndarray
    mender = DERIVER.mender

    def rules(self, genes):
        return []

    def derive(self, pair, head, genes):
        return 0 * LIFT if pair.parents in RULES else self.corrective


@pytest.mark.parametrize(("share", "harm"), [(-5, True), (-1, False), (0, False)])
def test_what_does_harm_on_another_head_is_not_kept(share, harm):
    judged = Choice(Fixed(share * WIDE), HEAD, GENES)
    pair = Pair(("wide", "wider"), "max")
    witnesses = [Company(size * points(), GENES, {}) for size in (1, 2)]
    assert judged.harms(pair, witnesses) == harm
    assert not judged.harms(pair, [])
    assert not judged.harms(Pair(("lidsClose", "wide"), "max"), witnesses)


WITNESS = Company(points(), GENES, {})


def test_the_next_pair_takes_the_place_of_one_that_does_harm(monkeypatch):
    assert choose_pairs(DERIVER, HEAD, GENES, frozenset({"still"}), [WITNESS])
    monkeypatch.setattr(Choice, "harms", lambda self, pair, witnesses: bool(witnesses))
    assert choose_pairs(DERIVER, HEAD, GENES, frozenset({"still"}), [WITNESS]) == []


def test_families_hold_what_is_damped_together():
    assert Pair(("mouthSmile", "mouthRetract"), "max").combination.family == "smile"
    assert Pair(("mouthSmile", "jawOpen"), "max").combination.family == "mouth"
    assert Pair(("lidsClose", "gazeDown"), "cancel").combination.family is None
