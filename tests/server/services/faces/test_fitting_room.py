"""What is remembered of heads in the making, and whose turn is over."""

import pytest

from server.services.errors import ConflictError
from server.services.faces.fitting_room import REMEMBERED, FittingRoom


def test_what_is_known_under_any_key_is_not_made_again():
    room, made = FittingRoom[str](), []

    def tried(*keys):
        return room.tried(keys, lambda: made.append(keys) or keys[0])

    assert tried("moving") == "moving"
    assert tried("still", "moving") == "moving"
    assert tried("other", "more") == "other"
    assert tried("more") == "more", "it is remembered under its first key only"
    assert made == [("moving",), ("other", "more"), ("more",)]


def test_the_oldest_is_forgotten_and_a_failure_is_not_remembered():
    room = FittingRoom[int]()
    for number in range(REMEMBERED + 1):
        room.tried([str(number)], lambda number=number: number)
    with pytest.raises(ZeroDivisionError):
        room.tried(["wrong"], lambda: 1 // 0)
    assert room.remembered == REMEMBERED
    assert room.tried(["1"], lambda: -1) == 1
    assert room.tried(["0"], lambda: -1) == -1


def test_the_turn_of_a_person_ends_with_their_next():
    room = FittingRoom[int]()
    first, other = room.turn("ines"), room.turn("omar")
    first()
    second = room.turn("ines")
    with pytest.raises(ConflictError):
        first()
    second()
    other()
