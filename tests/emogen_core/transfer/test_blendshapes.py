"""What holds for every way of transfer, and what each gives."""

from dataclasses import replace

import numpy as np
import pytest

from emogen_core.errors import InvalidInputError
from emogen_core.transfer.blendshapes import METHODS, Template, Training, transfer
from emogen_core.transfer.synthetic import errors
from tests.emogen_core.transfer.heads import REFLECTED, across, head, mirror, moved, packed, trained, truth

every = pytest.mark.parametrize("method", METHODS)


def seen(method, count=None):
    neutral, _, training = truth()
    return transfer(head(), neutral, Training(training.weights[:count], training.meshes[:count]), method)


@every
def test_the_same_head_has_the_same_shapes(method):
    assert np.allclose(transfer(head(), head().neutral, method=method), head().offsets, atol=1e-7)
    same = trained(head().neutral, head().offsets, packed())
    assert np.allclose(transfer(head(), head().neutral, same, method), head().offsets, atol=1e-7)


@every
def test_offsets_move_turn_and_scale_with_the_target(method):
    neutral, _, training = truth()
    there, carried = moved(neutral)
    shown = Training(training.weights, moved(training.meshes)[0])
    assert np.allclose(transfer(head(), there, shown, method), carried(seen(method)), atol=1e-6)


@every
def test_a_head_elsewhere_and_of_another_size_wears_the_templates_own(method):
    there, carried = moved(head().neutral, scale=0.1)
    assert np.allclose(transfer(head(), there, method=method), carried(head().offsets), atol=1e-7)


@every
def test_symmetric_heads_have_symmetric_shapes(method):
    rows = mirror()
    neutral = head().neutral * [1.1, 0.95, 1.2] + [[0, 3, 0]] * np.cos(head().neutral[:, :1] / 40)
    assert np.allclose(neutral[rows] * REFLECTED, neutral, atol=1e-4)
    true = head().offsets * 1.2
    true[..., 1] += 0.3 * np.abs(head().offsets[..., 2])
    symmetric = packed()[(packed()[:, across()] == packed()).all(1)]
    # The made-up grid's diagonals all run one way.
    template = replace(head(), triangles=np.r_[head().triangles, rows[head().triangles][:, ::-1]])
    found = transfer(template, neutral, trained(neutral, true, symmetric), method)
    assert np.allclose(found[:, rows] * REFLECTED, found[across()], atol=2e-3)
    assert len(symmetric) > 5
    assert np.abs(found).max() > 5


@every
def test_the_order_of_shapes_and_expressions_does_not_matter(method):
    neutral, _, training = truth()
    rng = np.random.default_rng(6)
    shapes, rows = rng.permutation(len(head().offsets)), rng.permutation(len(training.weights))
    turned = Training(training.weights[np.ix_(rows, shapes)], training.meshes[rows])
    found = transfer(replace(head(), offsets=head().offsets[shapes]), neutral, turned, method)
    assert np.allclose(found, seen(method)[shapes], atol=1e-7)


@pytest.mark.parametrize("method", ["copy", "deformation", "examples"])
def test_the_order_of_triangles_does_not_matter(method):
    neutral, _, training = truth()
    order = np.random.default_rng(6).permutation(len(head().triangles))
    turned = np.roll(head().triangles[order], 1, axis=1)
    found = transfer(replace(head(), triangles=turned), neutral, training, method)
    assert np.allclose(found, seen(method), atol=1e-6)


@pytest.mark.parametrize("method", ["copy", "warp", "deformation"])
def test_methods_that_learn_nothing_carry_each_shape_alone(method):
    alone = transfer(replace(head(), offsets=head().offsets[[3, 30]]), truth()[0], method=method)
    assert np.allclose(alone, seen(method)[[3, 30]], atol=1e-9)


# Deformation transfer is left out: its triangles have normals, which do not grow in proportion.
@pytest.mark.parametrize("method", ["copy", "warp"])
def test_half_a_shape_is_half_a_shape_on_another_head(method):
    half = transfer(replace(head(), offsets=0.5 * head().offsets), truth()[0], method=method)
    assert np.allclose(half, 0.5 * seen(method), atol=1e-9)


@every
def test_a_shape_that_moves_nothing_moves_nothing_on_another_head(method):
    still = replace(head(), offsets=np.concatenate([head().offsets, 0 * head().offsets[:1]]))
    found = transfer(still, truth()[0], method=method)
    assert np.allclose(found[-1], 0, atol=1e-9)
    assert np.allclose(found[:-1], transfer(head(), truth()[0], method=method), atol=1e-7)


@every
def test_the_same_call_gives_the_same_bits(method):
    assert np.array_equal(seen(method), seen(method))


def test_what_is_given_is_not_changed():
    neutral, _, training = truth()
    before = [array.copy() for array in (neutral, training.meshes, head().offsets)]
    for method in METHODS:
        transfer(head(), neutral, training, method)
    assert all(np.array_equal(*pair) for pair in zip(before, (neutral, training.meshes, head().offsets), strict=True))


def test_the_default_is_the_best_and_more_expressions_are_better():
    true = truth()[1]
    found = {method: errors(seen(method), true)[0] for method in METHODS}
    assert found["fields"] == min(found.values())
    assert found["fields"] < found["ridge"] < found["examples"] < found["deformation"]
    assert errors(transfer(head(), *truth()[::2]), true)[0] == found["fields"]
    counted = [errors(seen("fields", count), true)[0] for count in (0, 4, 8, len(packed()))]
    assert counted == sorted(counted, reverse=True)
    assert counted[0] == errors(seen("warp"), true)[0]


@pytest.mark.parametrize("method", ["fields", "ridge"])
def test_expressions_are_met(method):
    neutral, _, training = truth()
    worn = neutral + np.tensordot(training.weights, seen(method), 1)
    assert np.abs(worn - training.meshes).max() < 0.02


@pytest.mark.parametrize("method", ["fields", "ridge", "examples"])
def test_shapes_in_no_expression_stay_as_they_were_guessed(method):
    neutral, _, training = truth()
    guess = transfer(head(), neutral, method="deformation" if method == "examples" else "warp")
    unseen = ~training.weights[:3].any(0)
    assert np.allclose(seen(method, 3)[unseen], guess[unseen], atol=1e-9)


def test_single_precision_and_flat_heads_are_taken():
    flat = head().neutral * [1, 1, 0]
    single = Template(*(array.astype(np.float32) for array in (flat, head().offsets)), head().triangles)
    for method in METHODS:
        assert np.allclose(transfer(single, flat, method=method), head().offsets, atol=1e-4)


NAN = head().neutral * np.nan


@pytest.mark.parametrize(
    ("changed", "target", "training", "message"),
    [
        ({}, head().neutral[:-1], None, r"target: expected shape \(625, 3\), got \(624, 3\)"),
        ({}, NAN, None, r"target: expected finite lengths, got 'nan at \[0, 0\]'"),
        ({}, head().neutral * 0, None, "target: expected a head, got 'all vertices in one place'"),
        ({"neutral": NAN}, head().neutral, None, "neutral: expected finite"),
        ({"offsets": head().offsets[:, 1:]}, head().neutral, None, r"offsets: expected shape \(53, 625, 3\)"),
        ({"triangles": np.array([[0, 1, 625]])}, head().neutral, None, "triangles: expected .* within 625"),
        ({"triangles": np.array([[0, -1, 2]])}, head().neutral, None, "triangles: expected"),
        ({"triangles": np.array([0, 1, 2])}, head().neutral, None, "triangles: expected"),
        ({}, head().neutral, (packed()[:2], head().neutral[None]), r"weights: expected shape \(1, 53\)"),
        ({}, head().neutral, (packed()[:1], NAN[None]), "expressions: expected finite lengths"),
        ({}, head().neutral, (packed()[:1], head().neutral[None, 1:]), r"expressions: expected shape \(1, 625, 3\)"),
        ({}, head().neutral, (packed()[:1] + np.inf, head().neutral[None]), "weights: expected finite"),
        ({}, head().neutral, (-packed()[:1], head().neutral[None]), "weights: expected finite"),
        ({}, head().neutral, (0 * packed()[:1], head().neutral[None]), "weights: expected finite"),
    ],
)
def test_what_does_not_fit_is_named(changed, target, training, message):
    shown = Training(*training) if training else None
    with pytest.raises(InvalidInputError, match=message):
        transfer(replace(head(), **changed), target, shown)


def test_an_unknown_method_is_named():
    with pytest.raises(InvalidInputError, match=r"method: expected one of .*'fields'.*, got 'magic'"):
        transfer(head(), head().neutral, method="magic")
