"""All methods on one interface, region by region."""

from dataclasses import replace

import numpy as np
import pytest

from emogen_core.errors import InvalidInputError
from emogen_core.landmarks.bank import mixtures
from emogen_core.landmarks.comparison import two_sided
from emogen_core.landmarks.fit import Fitter
from emogen_core.landmarks.motions import Motions
from emogen_core.landmarks.points import NAMES
from emogen_core.landmarks.solvers import METHODS, make_solver

SIDED = ["4.3", "4.4", "4.5", "4.6"]


def all_points(vectors):
    return Motions(np.arange(len(vectors)), vectors)


def mirrored_core(rig, core):
    names = list(rig.core_shapes)
    swapped = [name[:-1] + {"L": "R", "R": "L"}[name[-1]] if name[-2:] in {".L", ".R"} else name for name in names]
    return core[[names.index(name) for name in swapped]]


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("regions", [1, 2, 4])
def test_an_expression_of_the_bank_is_recovered(head, bank, method, regions):
    fitter = Fitter(head, make_solver(method, head, bank), regions)
    for example in (0, 2, 17):
        truth = bank.surfaces[example].astype(float)
        found = fitter.fit(all_points(bank.motions[example]))
        moved = np.linalg.norm(truth, axis=1) > 0.5
        error = np.linalg.norm(found.surface - truth, axis=1)[moved].mean()
        worn = np.linalg.norm(head.surface(head.face(found.core)) - truth, axis=1)[moved].mean()
        bar = (0.92, 0.25) if method == "rig" else (1 - 1e-6, 1e-3)
        assert found.fitness >= bar[0]
        assert error <= bar[1]
        if method == "rig" or regions == 1:
            assert worn <= max(bar[1], 1e-3)
            assert np.abs(found.core - bank.core[example]).max() < (0.4 if method == "rig" else 1e-4)


@pytest.mark.parametrize("method", METHODS)
def test_the_same_seed_gives_the_same_face(head, bank, method):
    core = mixtures(head.rig, 1, np.random.default_rng(5))[0] @ head.rig.gene_to_core
    motions = all_points(head.surface(head.face(core))[head.vertices])
    solver = make_solver(method, head, bank)
    one, again, other = (Fitter(head, solver, 2, seed).fit(motions).surface for seed in (1, 1, 2))
    assert one.tobytes() == again.tobytes()
    assert (one.tobytes() != other.tobytes()) == method.startswith("ga")


@pytest.mark.parametrize("method", METHODS)
def test_emphasis_strengthens_the_expression(head, bank, method):
    fitter = Fitter(head, make_solver(method, head, bank))
    motions = all_points(bank.motions[8] * 0.4)
    weak, strong = (np.linalg.norm(fitter.fit(motions.emphasised(c)).surface, axis=1).sum() for c in (0.7, 1.4))
    assert strong > 1.5 * weak


def test_regions_find_sides_that_differ(head, bank):
    core = two_sided(head.rig, 4, np.random.default_rng(2))
    solver = make_solver("nnls", head, bank)
    errors = []
    for regions in (1, 2, 4):
        fitter = Fitter(head, solver, regions)
        far = []
        for row in core:
            truth = head.surface(head.face(row))
            far.append(np.linalg.norm(fitter.fit(all_points(truth[head.vertices])).surface - truth, axis=1).mean())
        errors.append(np.mean(far))
    assert errors[0] > errors[1] > errors[2]


def test_a_mirrored_input_gives_mirrored_weights(head, bank):
    row = two_sided(head.rig, 1, np.random.default_rng(7))[0]
    fitter = Fitter(head, make_solver("nnls", head, bank), 2)
    one, other = (
        fitter.fit(all_points(head.surface(head.face(core))[head.vertices])).core
        for core in (row, mirrored_core(head.rig, row))
    )
    assert np.abs(mirrored_core(head.rig, one) - other).max() < 0.05
    assert head.asymmetry(one) > 0.05


@pytest.mark.parametrize("method", ["nnls", "ga-line", "rig"])
def test_a_region_without_motion_rests(head, bank, method):
    rows = np.array([NAMES.index(name) for name in SIDED])
    vectors = np.zeros((len(rows), 3))
    vectors[[head.points[row, 0] > 0 for row in rows]] = (0, 4, 0)
    found = Fitter(head, make_solver(method, head, bank), 2).fit(Motions(rows, vectors))
    right = head.neutral[:, 0] < -16
    assert not found.surface[right].any()
    assert np.linalg.norm(found.surface, axis=1).max() > 2


@pytest.mark.parametrize("method", METHODS)
def test_a_frame_in_which_nothing_moves_is_the_face_at_rest(head, bank, method):
    found = Fitter(head, make_solver(method, head, bank), 4).fit(all_points(np.zeros((56, 3))))
    assert not found.surface.any()
    assert not found.core.any()
    assert (found.fitness, found.point_error) == (1.0, 0.0)


def test_points_that_are_still_say_nothing_to_the_genetic_algorithm_and_something_to_least_squares(head, bank):
    motions = all_points(bank.motions[3] + bank.motions[8])
    motions.vectors[::3] = 0
    for method, same in (("ga-line", True), ("nnls", False)):
        fitter = Fitter(head, make_solver(method, head, bank))
        moving = motions.among(motions.moving)
        one, other = (fitter.fit(given).core for given in (motions, moving))
        assert np.allclose(one, other) == same


def test_shapes_are_shared_out_among_regions_where_they_move(head, bank):
    fitter = Fitter(head, make_solver("nnls", head, bank), 4)
    shares = dict(zip(head.rig.core_shapes, fitter.core_shares.T, strict=True))
    assert np.allclose(fitter.core_shares.sum(0), 1)
    assert shares["browOuterUp.L"] == pytest.approx([1, 0, 0, 0], abs=0.01)
    assert shares["mouthSmile.R"][3] > 0.9
    assert shares["jawOpen"] == pytest.approx([0, 0.5, 0, 0.5], abs=0.05)


def test_a_surface_between_regions_is_the_blend_of_both(head, bank):
    motions = all_points(head.surface(head.face(two_sided(head.rig, 1, np.random.default_rng(1))[0]))[head.vertices])
    fitter = Fitter(head, make_solver("nnls", head, bank), 2)
    soft, hard = fitter.fit(motions), replace(fitter, band=0.0).fit(motions)
    far = np.abs(head.neutral[:, 0]) > 60
    assert soft.fitness == pytest.approx(hard.fitness, abs=0.1)
    assert np.linalg.norm(soft.surface - hard.surface, axis=1)[far].max() < 1.5


@pytest.mark.parametrize(
    ("method", "bank_", "said"), [("gradient", True, "method: expected one of"), ("nnls", False, "bank: expected")]
)
def test_what_cannot_be_solved_is_refused(head, bank, method, bank_, said):
    with pytest.raises(InvalidInputError, match=said):
        make_solver(method, head, bank if bank_ else None)
    with pytest.raises(InvalidInputError, match="regions: expected 1, 2 or 4"):
        Fitter(head, make_solver("nnls", head, bank), 3).fit(all_points(bank.motions[0]))
