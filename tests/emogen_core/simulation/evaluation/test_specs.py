"""Runs as plain data."""

from dataclasses import replace

import numpy as np

from emogen_core.simulation.evaluation.specs import RunSpec
from emogen_core.simulation.observer import Observer
from tests.emogen_core.simulation.evaluation.laboratories import small_laboratory

PLAIN = RunSpec("target 1")


def test_what_is_different_has_another_key():
    others = [
        RunSpec("target 2"),
        replace(PLAIN, metric="vertex_rms"),
        replace(PLAIN, search={"mutations": 1}),
        replace(PLAIN, selections="three"),
        replace(PLAIN, observer=Observer(noise=0.1)),
        replace(PLAIN, algorithm="pressure"),
        replace(PLAIN, algorithm="preference"),
        replace(PLAIN, start="fixed 1"),
        replace(PLAIN, genes=16),
    ]
    assert len({one.key for one in (PLAIN, *others)}) == 1 + len(others)
    assert RunSpec("target 1").key == PLAIN.key


def test_settings_are_compared_by_the_same_first_faces_and_others_are_not():
    noisy = replace(PLAIN, observer=Observer(noise=0.1), search={"mutations": 1})
    assert noisy.entropy(3) == PLAIN.entropy(3)
    assert len({PLAIN.entropy(3), PLAIN.entropy(4), RunSpec("target 2").entropy(3)}) == 3
    laboratory = small_laboratory()
    default = replace(PLAIN, search={"activation": laboratory.params.activation})
    np.testing.assert_array_equal(laboratory.chunk(PLAIN, 0, 9).genes, laboratory.chunk(default, 0, 9).genes)


def test_searches_that_learn_are_made_fewer_at_a_time():
    assert (PLAIN.chunk, replace(PLAIN, algorithm="pressure").chunk) == (100, 100)
    assert replace(PLAIN, algorithm="preference").chunk < 100
