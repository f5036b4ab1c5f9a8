"""Heads that a study brings along: frozen with it, fitted outside of transactions, the same in every process."""

from __future__ import annotations

import asyncio
import threading
import time

import httpx2
import numpy as np
import pytest
from starlette.testclient import TestClient

from emogen_core.errors import InvalidInputError
from emogen_core.face.appearance import Appearance
from emogen_core.face.identity import Identity, signed_document
from emogen_core.face.space_file import load_bundled_space
from server.app import create_app
from server.services.errors import ConflictError, InvalidError, UnavailableError
from server.services.faces.wardrobe import Wardrobe
from server.services.house import build_house
from server.services.studies.simulation import Simulation
from tests.conftest import FakeDrawer, FakeTailor, small_study
from tests.server.exported import lines
from tests.server.walker import Walker

SPACE = load_bundled_space()


def document(name="Somebody", **head):
    return signed_document(Identity(name, {"age": 40.0, **head}), SPACE)


def plain(**head):
    """A document as people write it."""
    return {"format": "emogen-identity", "version": 1, "name": "By hand", "head": head}


def name_of(signed):
    return f"custom-{signed['hash'][:12]}"


@pytest.fixture
def wardrobe(rig, tailor):
    made = Wardrobe(tailor, patience=0.2, limit=3)
    yield made
    tailor.gate.set()
    made.close()


def study_of(*documents, **changes):
    return small_study(identities=documents, **changes)


def test_documents_are_frozen_canonical_and_signed(wardrobe):
    frozen = wardrobe.frozen(study_of("male", plain(age=40, details={"nose-width": 0.25})))
    assert frozen.identities[0] == "male"
    assert frozen.identities[1] == document("By hand", **{"nose-width": 0.25})
    assert frozen.heads == ("male", name_of(frozen.identities[1]))
    assert wardrobe.frozen(frozen) == frozen
    assert frozen.hash() == wardrobe.frozen(frozen).hash()


@pytest.mark.parametrize(
    ("head", "field", "expected", "got"),
    [
        (plain(sex=2), "identities.1.sex", "a number in [0, 1]", "2.0"),
        (plain(sex="male"), "identities.1.head.sex", "a finite number", "'male'"),
        (plain(ancestry={"african": 0.5}), "identities.1.ancestry", "shares that sum to 1", "0.5"),
        (plain(age=12), "identities.1.age", "at least 18", "12.0"),
        ({**plain(), "version": 2}, "identities.1.version", "1", "2"),
        ({**document(), "name": "Renamed"}, "identities.1.hash", "", document()["hash"]),
        ({**plain(), "appearance": {"skin": 1}}, "identities.1.appearance", "no missing field", "balding"),
        ({"name": "x"}, "identities.1", "the fields", "format"),
    ],
)
def test_a_wrong_document_is_named_by_place_field_and_value(house, head, field, expected, got):
    with pytest.raises(InvalidError) as caught:
        house.studies.create(study_of("female", head))
    assert caught.value.field == field
    assert expected in str(caught.value.expected)
    assert got in str(caught.value.got)
    assert house.studies.all() == []


def test_children_are_allowed_in_so_many_words(house):
    made = house.studies.create(study_of(plain(age=12), children=True))
    assert made.config_hash


def test_a_head_is_ready_after_waiting_and_never_inside_a_transaction(wardrobe, tailor, rig):
    config = study_of(document())
    (name,) = config.heads
    wardrobe.know(config)
    for ask in (wardrobe.rig, wardrobe.head):
        with pytest.raises(UnavailableError) as caught:
            ask(name)
        assert caught.value.retry_after > 0
    assert tailor.fitted == []
    wardrobe.wait(name)
    wardrobe.wait(name)
    assert tailor.fitted == [("Somebody", True)]
    assert wardrobe.rig(name).neutral(name) == pytest.approx(rig.neutral("female") + 2)
    assert wardrobe.head(name).name == name
    assert wardrobe.rig(name).hash == rig.hash


def test_heads_of_the_rig_and_strangers_are_left_to_the_rig(wardrobe, rig):
    wardrobe.wait("male")
    assert wardrobe.rig("male") is rig
    assert wardrobe.head("male") is None
    with pytest.raises(InvalidInputError, match="identity: expected one of"):
        wardrobe.rig("custom-nobody").neutral("custom-nobody")


def test_a_head_that_gave_its_place_to_others_is_fitted_again(wardrobe, tailor):
    many = study_of(*(document(name) for name in "abcde"))
    wardrobe.know(many)
    for name in many.heads:
        wardrobe.wait(name)
    assert [wardrobe.ready(name) is not None for name in many.heads] == [False, False, True, True, True]
    first = many.heads[0]
    for ask in (wardrobe.rig, wardrobe.head):
        with pytest.raises(UnavailableError):
            ask(first)
    wardrobe.wait(first)
    assert wardrobe.head(first).name == first
    assert [name for name, _ in tailor.fitted] == [*"abcde", "a"]
    assert wardrobe.ready(many.heads[2]) is None, "the one that was used longest ago"


def test_waiting_is_bounded(wardrobe, tailor):
    tailor.gate.clear()
    config = study_of(document("a"), document("b"))
    wardrobe.prepare(config)
    while not tailor.fitted:
        time.sleep(0.01)
    begun = time.monotonic()
    with pytest.raises(UnavailableError, match="being made"):
        wardrobe.wait(config.heads[1])
    assert time.monotonic() - begun < 5
    tailor.gate.set()
    wardrobe.wait(config.heads[1])
    assert sorted(tailor.fitted) == [("a", True), ("b", True)]


def test_many_who_wait_for_one_head_fit_it_once(wardrobe, tailor):
    config = study_of(document())
    wardrobe.know(config)
    threads = [threading.Thread(target=wardrobe.wait, args=config.heads) for _ in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(10)
    assert len(tailor.fitted) == 1


def test_only_so_many_heads_are_kept(wardrobe, tailor):
    studies = [study_of(document(str(number))) for number in range(4)]
    for config in studies:
        wardrobe.know(config)
        wardrobe.wait(*config.heads)
    assert wardrobe.head(studies[3].heads[0]) is not None
    wardrobe.know(studies[0])
    with pytest.raises(UnavailableError):
        wardrobe.rig(studies[0].heads[0])
    wardrobe.wait(studies[0].heads[0])
    assert len(tailor.fitted) == 5


def test_a_head_of_another_space_is_told_for_good(wardrobe):
    signed = {**document(), "space": "0" * 64}
    config = study_of(signed)
    wardrobe.know(config)
    for _ in range(2):
        with pytest.raises(ConflictError, match="space: expected"):
            wardrobe.wait(*config.heads)


def test_the_heads_of_open_studies_are_fitted_at_the_start(house, settings, rig, tailor):
    tailor.gate.clear()  # ahead of it nothing was fitted
    made = house.studies.create(study_of(document("open")))
    house.studies.create(study_of(document("closed")), "closed")
    tailor = FakeTailor(rig)
    again = build_house(settings, rig, FakeDrawer(rig), tailor)
    again.studies.prepare()
    again.journal.wardrobe.close()
    assert tailor.fitted == [("open", True)]
    assert made.status == "recruiting"
    again.close()


def test_a_participant_waits_for_the_head_and_is_told_to_come_again(house, tailor, drawer):
    tailor.gate.clear()
    object.__setattr__(house.journal.wardrobe, "_patience", 0.1)
    study = house.studies.create(study_of(document()))
    with TestClient(create_app(house)) as client:
        walker = Walker(client, study.links[0])
        walker.answer("consent", given=True)
        body = {"id": "0f9d5fd4-3a53-4f0c-9a0f-0d9d3f7d4c10", "kind": "instructions"}
        refused = walker.post(body)
        assert (refused.status_code, refused.json()["error"]["code"]) == (503, "unavailable")
        assert int(refused.headers["retry-after"]) > 0
        tailor.gate.set()
        house.journal.wardrobe._ahead.submit(lambda: None).result(10)
        assert walker.post(body).status_code == 200


def test_another_process_draws_a_custom_head_from_the_row(house, settings, rig, drawer):
    look = {"appearance": Appearance(skin_depth=0.8).to_document()}
    study = house.studies.create(study_of({**plain(age=50), **look}))
    with TestClient(create_app(house)) as client:
        state = Walker(client, study.links[0]).start()
    key = state["trial"]["faces"][0]["portrait"].removeprefix("/portraits/").removesuffix(".png")
    house.portraits.settle()
    other = FakeDrawer(rig)
    unseen = build_house(
        settings.model_copy(update={"data_dir": settings.data_dir / "moved", "database_url": settings.url}),
        rig, other, FakeTailor(rig),
    )  # fmt: skip
    assert unseen.portraits.request(key).result(5)
    (name,) = other.heads
    assert name.startswith("custom-")
    assert other.heads[name].appearance["skin_depth"] == 0.8
    assert np.array_equal(other.heads[name].neutral, drawer.heads[name].neutral)
    unseen.close()


def test_it_replays_and_the_export_says_where_the_document_is(client, house, settings, rig):
    signed = document()
    study = house.studies.create(study_of("male", signed))
    for _ in range(2):
        Walker(client, study.links[0]).finish()
    names = {row["identity"] for row in lines(house, study.id, "trials")}
    assert names == {"male", name_of(signed)}
    (version,) = house.exports.configurations(study.id)
    assert version["config_hash"] == study.config_hash
    assert version["config"]["identities"] == ["male", signed]
    later = build_house(settings, rig, FakeDrawer(rig), FakeTailor(rig))
    replayed = later.replay.study(study.id)
    assert (replayed.difference, replayed.generations) == (None, 2 * 7)
    later.close()


def test_simulated_participants_come_again_while_a_head_is_made(house, tailor, monkeypatch):
    monkeypatch.setattr("server.services.faces.wardrobe.AGAIN", 0)
    object.__setattr__(house.journal.wardrobe, "_patience", 0.05)
    tailor.gate.clear()
    study = house.studies.create(study_of(document(), "male"))
    token = house.tokens.create("test", ["simulate"])
    threading.Timer(0.4, tailor.gate.set).start()

    async def run():
        transport = httpx2.ASGITransport(create_app(house))
        async with httpx2.AsyncClient(base_url="http://testserver", transport=transport) as client:
            return await Simulation(client, study.links[0], token, 1, house.journal.rig).run(2)

    report = asyncio.run(run())
    assert len(report.trials) == 4
    assert house.replay.study(study.id).difference is None


def test_renewal_after_an_update_of_the_look_fits_nothing(client, house, settings, rig):
    study = house.studies.create(study_of(document()))
    before = Walker(client, study.links[0]).start()["trial"]["faces"][0]["portrait"]
    drawer, tailor = FakeDrawer(rig), FakeTailor(rig)
    drawer.key = lambda *face: house.portraits.key(*face)[::-1]
    after = build_house(settings, rig, drawer, tailor)
    after.housekeeping.begin()
    assert tailor.fitted == []
    key = before.removeprefix("/portraits/").removesuffix(".png")[::-1]
    assert after.portraits.request(key).result(5)
    after.close()
