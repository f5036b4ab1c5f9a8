"""Heads in the making: the newest wins, one that rests is quick, and nothing is kept for ever."""

from __future__ import annotations

import threading
import time

import pytest

from emogen_core.face.identity import Identity
from emogen_core.rigs.identities import preset
from emogen_core.rigs.look.presets import presets
from server.services.errors import ConflictError, InvalidError, NotFoundError
from server.services.faces.expressions import NEUTRAL
from server.services.faces.fitting_room import REMEMBERED
from tests.conftest import PIXEL


def head(name="Somebody", **values):
    return Identity(name, {"age": 40.0, **values})


def test_presets_start_with_the_look_that_follows_their_sliders(house):
    assert house.heads.presets == ("female", "male")
    identity = house.heads.start("male")
    assert identity == preset("male")
    assert house.heads.appearance(identity) == presets()["male"]
    for name in ("custom-123", "african-male-old"):
        with pytest.raises(NotFoundError):
            house.heads.start(name)
        with pytest.raises(NotFoundError):
            house.heads.portrait(name)


def test_a_presets_portrait_is_drawn_once(house, drawer):
    assert house.heads.portrait("female").result(5) == PIXEL
    assert house.heads.portrait("female").result(5) == PIXEL
    assert len(drawer.drawn) == 1


def test_a_head_at_rest_is_fitted_without_its_shapes_and_remembered(house, tailor, drawer):
    for _ in range(2):
        assert house.heads.preview(head(), NEUTRAL, "ines").result(5) == PIXEL
    assert tailor.fitted == [("Somebody", False)]
    for emotion in ("happy", "sad", NEUTRAL):
        house.heads.preview(head(), emotion, "ines").result(5)
    assert tailor.fitted == [("Somebody", False), ("Somebody", True)]
    assert {name.endswith("-still") for name in drawer.heads} == {True, False}


def test_only_a_few_are_remembered(house, tailor):
    for age in range(20, 30):
        house.heads.preview(head(age=age), NEUTRAL, "ines").result(5)
    assert house.heads._room.remembered == REMEMBERED
    house.heads.preview(head(age=20), NEUTRAL, "ines").result(5)
    assert len(tailor.fitted) == 11


def test_the_newest_preview_of_a_person_wins(house, tailor):
    tailor.gate.clear()
    outcomes = {}

    def ask(age, user):
        try:
            outcomes[age, user] = house.heads.preview(head(age=age), NEUTRAL, user).result(5)
        except ConflictError as error:
            outcomes[age, user] = str(error)

    threads = [threading.Thread(target=ask, args=one) for one in ((20, "i"), (21, "i"), (50, "j"), (22, "i"))]
    for thread in threads:
        thread.start()
        time.sleep(0.1)
    tailor.gate.set()
    for thread in threads:
        thread.join(10)
    assert outcomes[22, "i"] == outcomes[50, "j"] == PIXEL
    assert "newer" in outcomes[21, "i"]
    assert len(tailor.fitted) == 3, "one was being fitted; what waited behind it was dropped"


def test_unknown_emotions_are_refused(house):
    with pytest.raises(InvalidError) as caught:
        house.heads.preview(head(), "bored", "ines")
    assert "happy" in caught.value.expected
