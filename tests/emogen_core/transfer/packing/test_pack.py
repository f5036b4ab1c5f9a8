"""Whole packings: what the paper demands of every one, and the same as its procedure taken literally."""

from dataclasses import replace
from itertools import product

import numpy as np
import pytest

from emogen_core.errors import InvalidInputError
from emogen_core.transfer.packing.activity import displacements
from emogen_core.transfer.packing.importance import (
    Importance,
    displacement_strength,
    similarities,
    triangle_distortion,
)
from emogen_core.transfer.packing.made_up import face_bumps, made_up_face
from emogen_core.transfer.packing.pack import Options, pack
from tests.emogen_core.transfer.packing.brute import algorithm_1, chromatic_number, fits, random_template

FACE = made_up_face(face_bumps(), 33)
EVERY = [
    Options(mu, 0.5, beta, None, symmetric, poseable, order)
    for mu, beta, symmetric, poseable, order in product(
        (0.25, 0.4), (0.0, 0.5), (True, False), (True, False), ("greedy", "minimal")
    )
]


def added(expression):
    return [k for unit in expression.adds for k in unit]


def importance(template, packing, options):
    return Importance(
        displacement_strength(displacements(template.offsets), packing.active),
        triangle_distortion(packing.active, template.triangles, template.neutral, template.neutral),
        similarities(template.offsets),
        options.alpha,
        options.beta,
    )


@pytest.mark.parametrize("options", EVERY, ids=str)
def test_every_packing_keeps_every_rule(options):
    packing = pack(FACE, options)
    shapes = [k for one in packing.expressions for k in added(one)]
    assert sorted(shapes) == list(range(len(FACE.names)))
    for one in packing.expressions:
        # A pair counts once where both of it are active, and so does what is held.
        holds = packing.rules.holds
        room = [[*unit, *(holds[k] for k in unit if k in holds)] for unit in one.adds]
        assert (np.sum([packing.active[worn].any(0) for worn in room], axis=0) <= 1).all()
        assert set(one.holds) == {packing.rules.holds[k] for k in added(one) if k in packing.rules.holds}
        assert all((a in one.shapes) == (b in one.shapes) for a, b in packing.rules.together)
        assert not any({a, b} <= set(one.shapes) for a, b in packing.rules.apart)
    if options.symmetric:
        gaze = set(FACE.gaze) if options.poseable else set()
        assert {pair for pair in packing.mirrored.pairs if not set(pair) & gaze} <= set(packing.rules.together)
    assert packing.needed == len(packing.expressions) >= packing.minimum
    if options.order == "minimal":
        assert packing.needed == packing.minimum


@pytest.mark.parametrize("options", EVERY, ids=str)
def test_weights_and_objective_say_what_the_expressions_are(options):
    packing = pack(FACE, options)
    weights, shown, left = packing.weights, [], set(range(len(FACE.names)))
    assert set(np.unique(weights)) == {0, 1}
    values = importance(FACE, packing, options)
    for row, one in zip(weights, packing.expressions, strict=True):
        assert np.flatnonzero(row).tolist() == list(one.shapes)
        now = values.of(sorted(left), shown)
        assert one.importance == pytest.approx(now[added(one)].sum())
        np.testing.assert_allclose(packing.importance[added(one)], now[added(one)])
        shown += added(one)
        left -= set(added(one))


@pytest.mark.parametrize("beta", [0.0, 0.7])
@pytest.mark.parametrize("symmetric", [True, False])
@pytest.mark.parametrize("seed", range(12))
def test_greedy_is_algorithm_1(seed, symmetric, beta):
    template, options = random_template(seed), Options(beta=beta, symmetric=symmetric, poseable=False)
    packing = pack(template, options)
    pairs = packing.mirrored.pairs if symmetric else ()
    wanted = algorithm_1(packing.active, pairs, importance(template, packing, options).of)
    found = [(set(one.shapes), one.importance) for one in packing.expressions]
    assert [shapes for shapes, _ in found] == [shapes for shapes, _ in wanted]
    np.testing.assert_allclose([value for _, value in found], [value for _, value in wanted])


def test_the_random_heads_have_pairs_to_keep():
    kept = [len(pack(random_template(seed)).mirrored.pairs) for seed in range(12)]
    assert min(kept) >= 2


@pytest.mark.parametrize("seed", range(20))
def test_minimal_is_the_chromatic_number(seed):
    template = random_template(seed, pairs=0, singles=8, vertices=8)
    packing = pack(template, Options(mu=0.3, poseable=False, order="minimal"))
    apart = packing.active @ packing.active.T.astype(int) > 0
    np.fill_diagonal(apart, False)
    assert len(packing.expressions) == packing.minimum == chromatic_number(apart)


def test_minimal_is_sometimes_fewer_than_greedy_and_no_less_important_where_it_need_not_be():
    fewer = 0
    for seed in range(60):
        template = random_template(seed, pairs=0, singles=9, vertices=8)
        first, second = (
            pack(template, Options(mu=0.2, poseable=False, order=order)) for order in ("greedy", "minimal")
        )
        assert first.minimum == second.minimum == second.needed <= first.needed
        fewer += second.needed < first.needed
        if first.needed == second.needed:
            assert first.expressions == second.expressions
    assert fewer > 0


def test_the_first_expressions_are_kept():
    whole, few = pack(FACE), pack(FACE, Options(most=4))
    assert few.expressions == whole.expressions[:4]
    assert (few.needed, few.minimum) == (whole.needed, whole.minimum)
    assert few.weights.shape == (4, len(FACE.names))
    assert pack(FACE, Options(most=99)).expressions == whole.expressions


def test_the_same_template_is_packed_the_same():
    assert pack(FACE).expressions == pack(FACE).expressions


def test_a_larger_share_never_needs_more_expressions():
    needed = [
        pack(FACE, Options(mu=mu, order="minimal", poseable=False)).minimum for mu in (0.1, 0.25, 0.3, 0.33, 0.4, 0.8)
    ]
    assert needed == sorted(needed, reverse=True)


def test_pairs_that_overlap_are_worn_together_all_the_same():
    packing = pack(FACE, Options(mu=0.1))
    both = [pair for pair in packing.rules.together if (packing.active[pair[0]] & packing.active[pair[1]]).any()]
    assert both
    for one in packing.expressions:
        assert all((a in one.shapes) == (b in one.shapes) for a, b in both)
        assert fits(packing.active, packing.rules.together, set(added(one)))


def test_the_target_changes_what_is_important():
    long_faced = FACE.neutral.copy()
    long_faced[FACE.neutral[:, 1] < -40, 1] *= 1.6
    plain, other = (pack(replace(FACE, target=target), Options(alpha=0.0)) for target in (None, long_faced))
    jaw, brow = FACE.names.index("jawForward"), FACE.names.index("browDown_L")
    assert other.importance[brow] / other.importance[jaw] < plain.importance[brow] / plain.importance[jaw]


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"mu": 0.0}, "mu: expected"), ({"mu": 1.2}, "mu: expected"), ({"mu": float("nan")}, "mu: expected"),
        ({"alpha": -0.1}, "alpha: expected"), ({"alpha": 1.1}, "alpha: expected"),
        ({"alpha": float("nan")}, "alpha: expected"), ({"beta": -1.0}, "beta: expected"),
        ({"beta": float("inf")}, "beta: expected"), ({"beta": float("nan")}, "beta: expected"),
        ({"most": 0}, "max: expected"), ({"order": "best"}, "order: expected"),
    ],
)  # fmt: skip
def test_an_option_out_of_its_range_is_named(change, said):
    with pytest.raises(InvalidInputError, match=f"^{said}.*, got "):
        pack(FACE, replace(Options(), **change))
