"""What a page measured is read strictly, admitted by the study's rules, and a visual angle is what geometry says."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from server.services.config import Devices
from server.services.errors import DeviceError, InvalidError
from server.services.participation.arrival import Browser
from server.services.participation.devices import Device, check_device, device_of, tile_height
from server.store import runs
from tests.conftest import small_study
from tests.server.dump import dump
from tests.server.walker import Walker

DESK = {"viewport": "1280x800", "pixel_ratio": "1.5", "touch": "false"}
PHONE = Device(390, 844, 3, touch=True)


def test_what_a_page_says_is_read():
    assert device_of(DESK) == Device(1280, 800, 1.5, touch=False)
    assert device_of({**DESK, "touch": "true"}).kind == "tablet"
    assert (PHONE.kind, device_of(DESK).kind) == ("phone", "computer")
    assert Device(500, 800, 1, touch=False).kind == "narrow window"
    assert device_of({**DESK, "screen": "1920x1080"}).room == (1920, 1080)
    assert device_of({}) is None


@given(st.text(max_size=20), st.text(max_size=8))
def test_anything_else_is_refused(viewport, ratio):
    try:
        found = device_of({"viewport": viewport, "pixel_ratio": ratio})
    except InvalidError as error:
        assert error.field in {"viewport", "pixel_ratio"}
    else:
        assert found is None or (found.width > 0 and found.height > 0 and 0 <= found.pixel_ratio <= 20)


def test_a_study_says_what_it_admits():
    check_device(Devices(), PHONE)
    check_device(Devices(phones=False), None)
    with pytest.raises(DeviceError) as refused:
        check_device(Devices(phones=False), PHONE)
    assert refused.value.reason == "phone"
    with pytest.raises(DeviceError) as refused:
        check_device(Devices(least_height=900), Device(1280, 800, 1, touch=False))
    assert (refused.value.reason, refused.value.got) == ("small", "1280 x 800")


def test_a_zoomed_page_is_no_small_device():
    """At 200 % a window of 1280 x 800 says 640 x 400; what counts is the screen that it is on."""
    zoomed = Device(640, 400, 2, touch=False, screen=(1280, 800))
    check_device(Devices(phones=False, least_width=1280, least_height=800), zoomed)
    check_device(Devices(), Device(427, 267, 3, touch=False, screen=(427, 267)))
    with pytest.raises(DeviceError) as refused:
        check_device(Devices(least_width=1281), zoomed)
    assert (refused.value.reason, refused.value.got) == ("small", "1280 x 800")
    with pytest.raises(DeviceError):
        check_device(Devices(phones=False), Device(390, 844, 3, touch=True, screen=(844, 390)))


@given(st.floats(1, 30), st.floats(1, 20), st.floats(150, 3000))
def test_a_picture_spans_its_angle(degrees, px_per_mm, distance):
    height = tile_height(degrees, px_per_mm, distance) / px_per_mm
    seen = math.degrees(2 * math.atan(height / 2 / distance))
    assert seen == pytest.approx(degrees, abs=0.05 / px_per_mm / distance * 180 + 1e-6)


def test_who_is_refused_takes_no_place_and_comes_back_on_another_device(house):
    made = house.studies.create(small_study(devices={"phones": False}, quota=1, user_agent=True))
    before = dump(house.database)
    with pytest.raises(DeviceError):
        house.joining.join(made.links[0], {"PROLIFIC_PID": "a"}, browser=Browser(device=PHONE))
    assert {**dump(house.database), "server_keys": []} == {**before, "server_keys": []}
    desk = Browser(device=device_of(DESK), user_agent="Browser/1")
    joined = house.joining.join(made.links[0], {"PROLIFIC_PID": "a"}, browser=desk)
    with house.database.read() as tx:
        kept = runs.participation(tx, joined.participation).device
    assert kept == {
        "viewport": [1280, 800], "pixel_ratio": 1.5, "touch": False, "kind": "computer", "user_agent": "Browser/1",
    }  # fmt: skip


def test_no_browser_is_named_where_the_study_does_not_ask(house, study):
    joined = house.joining.join(study.links[0], browser=Browser(user_agent="Browser/1"))
    with house.database.read() as tx:
        assert runs.participation(tx, joined.participation).device == {}


@pytest.fixture
def sized(house, client):
    made = house.studies.create(small_study(devices={"face_degrees": 6}))
    return Walker(client, made.links[0])


def test_a_screen_is_measured_between_consent_and_instructions(sized):
    state = sized.answer("consent", given=True)
    assert (state["step"], state["calibration"]) == ("calibration", {"degrees": 6})
    state = sized.answer("calibration", px_per_mm=4, distance_mm=570)
    assert (state["step"], state["study"]["tile_height"]) == ("instructions", 239.0)
    begun = sized.answer("instructions")
    assert begun["study"]["tile_height"] == 239.0


def test_without_a_card_the_faces_are_as_large_as_the_window_allows(sized, house):
    sized.answer("consent", given=True)
    assert sized.answer("calibration")["study"]["tile_height"] is None
    with house.database.read() as tx:
        (found,) = [runs.participation(tx, one) for one in runs.participation_ids(tx, _only(house))]
    assert found.device == {"calibrated": False}


def test_half_a_measurement_is_refused(sized):
    sized.answer("consent", given=True)
    for half in ({"px_per_mm": 4}, {"distance_mm": 570}, {"px_per_mm": 0, "distance_mm": 570}):
        reply = sized.post({"id": "6f5fbc4e-65a3-4d64-b5b5-0f1f3ef1d0a1", "kind": "calibration", **half})
        assert reply.status_code == 422
    assert sized.state()["step"] == "calibration"


def _only(house):
    return house.studies.all()[0].id
