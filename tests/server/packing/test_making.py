"""From a rig to cards."""

import json

import numpy as np
import pytest

from emogen_core.transfer.packing.pack import Options
from server.packing.facts import proof, told
from server.packing.making import make
from server.packing.studio import painted, rgb
from tests.server.packing.made import DOCUMENT, MADE, RIG, FlatRenderer, studio


def test_cards_count_and_add_up():
    made = make(RIG, "male", Options())
    assert [card.number for card in made.cards] == list(range(1, 26))
    assert {card.of for card in made.cards} == {25}
    shares = [card.share for card in made.cards]
    assert shares == sorted(shares)
    assert shares[-1] == pytest.approx(1)
    assert max(shares) <= 1
    shown = [name for card in made.cards for movement in card.movements for name in movement.shapes]
    assert sorted(shown) == sorted(made.names)


def test_shares_are_of_everything_even_where_only_the_first_are_wanted():
    whole = make(RIG, "male", Options())
    assert [card.share for card in MADE.cards] == [card.share for card in whole.cards[:3]]


def test_weights_are_those_of_all_core_shapes():
    assert MADE.weights.shape == (3, len(RIG.core_shapes))
    for row, card in zip(MADE.weights, MADE.cards, strict=True):
        worn = {name for movement in card.movements for name in movement.shapes}
        assert {RIG.core_shapes[k] for k in np.flatnonzero(row)} == worn
    assert set(MADE.left_out) == set(RIG.core_shapes) - set(MADE.names)


def test_cards_are_drawn_from_the_front_and_turned_with_correctives():
    front, turned = FlatRenderer(), FlatRenderer()
    cards = MADE.drawn(studio(front, turned))
    assert [name for name, _ in front.drawn] == ["male"] * 3
    np.testing.assert_array_equal([w for _, w in front.drawn], [w for _, w in turned.drawn])
    drawn = np.array([w for _, w in front.drawn])
    np.testing.assert_array_equal(drawn[:, : len(RIG.core_shapes)], MADE.weights)
    assert drawn[:, len(RIG.core_shapes) :].any(), "correctives come with the shapes"
    shapes = {pixels.shape for card in cards for pixels in (card.views.front, card.views.turned)}
    assert len(shapes) == 1


def test_every_movement_is_painted_in_its_colour_where_it_moves_most_and_nowhere_else():
    packing, card = MADE.packing, MADE.cards[0]
    colours = painted(packing, MADE.names, card.movements)
    rows = [MADE.names.index(name) for movement in card.movements for name in movement.shapes]
    for movement in card.movements:
        farthest = [int(packing.reach[MADE.names.index(name)].argmax()) for name in movement.shapes]
        np.testing.assert_allclose(colours[farthest], [rgb(movement.colour)] * len(farthest), atol=0.03)
    still = packing.reach[rows].max(0) == 0
    assert still.sum() > 1000
    np.testing.assert_allclose(colours[still], colours[still][0, 0])
    active = packing.active[rows].any(0)
    assert (np.abs(colours[active] - colours[still][0]).max(1) > 0.2).all()


def test_the_map_is_coloured():
    card = MADE.drawn(studio())[0]
    assert (np.ptp(card.views.moves.astype(int), axis=2) > 60).mean() > 0.05


def test_the_document_says_everything():
    assert json.loads(json.dumps(DOCUMENT, allow_nan=False)) == DOCUMENT
    assert (DOCUMENT["needed"], DOCUMENT["minimum"], len(DOCUMENT["expressions"])) == (25, 25, 3)
    assert DOCUMENT["options"]["most"] == 3
    assert DOCUMENT["importance"] == pytest.approx(sum(one["importance"] for one in DOCUMENT["expressions"]))
    assert DOCUMENT["left_out"] == list(MADE.left_out)
    for one in DOCUMENT["expressions"]:
        names = [name for unit in one["adds"] for name in unit]
        assert one["importance"] == pytest.approx(sum(DOCUMENT["shapes"][name] for name in names))


def test_what_is_told_has_the_proof():
    lines = told(MADE).splitlines()
    assert (
        lines[0]
        == "25 expressions show 80 shapes, of which these are the first 3. 25 is the least possible number: proven."
    )
    assert len(lines) == 4
    assert "jaw open" in lines[1]
    more = make(RIG, "male", Options(mu=0.25)).packing
    assert proof(more) == "27 would be the least possible number, proven: --order minimal finds them."


def test_importance_depends_on_whose_triangles_are_compared():
    own, old = (make(RIG, head, Options()).packing.importance for head in (RIG.identities[0], "caucasian-male-old"))
    assert np.abs(own - old).max() > 0.005
