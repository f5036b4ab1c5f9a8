"""Faces by their id: those that are wanted, and a missing one is named."""

import numpy as np
import pytest

from server.analysis.shown import Shown
from server.services.errors import InvalidError
from tests.rig_factory import small_rig
from tests.server.analysis.tables import Tables

RIG = small_rig()


def face(name, number):
    genes = {f"gene_{gene}": number + at / 100 for at, gene in enumerate(RIG.gene_names)}
    weights = {f"weight_{shape}": -number - at / 100 for at, shape in enumerate(RIG.shape_names)}
    return {"face": name, **genes, **weights}


EXPORT = Tables(faces=[face("a", 1), face("b", 2), face("c", 3)])


def test_numbers_come_in_the_order_that_is_asked_for():
    shown = Shown(EXPORT, RIG, ["c", "a", "c"])
    assert np.floor(shown.genes(["c", "a", "c"])[:, 0]).tolist() == [3, 1, 3]
    assert np.allclose(shown.weights(["a"])[0], [-1 - at / 100 for at in range(len(RIG.shape_names))])
    assert shown.weights([]).shape == (0, len(RIG.shape_names))


@pytest.mark.parametrize("name", ["b", "d"])
def test_what_was_not_wanted_or_is_not_there_is_named(name):
    shown = Shown(EXPORT, RIG, ["a", "d"])
    with pytest.raises(InvalidError, match=f"got none called {name}"):
        shown.weights(["a", name])
