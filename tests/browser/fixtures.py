"""Fixtures of all tests that drive a browser: one server and one Chromium a folder, gone before other tests begin."""

from __future__ import annotations

import pytest

from .player import Player
from .stage import chromium, running


@pytest.fixture(scope="package")
def stage(tmp_path_factory):
    with running(tmp_path_factory.mktemp("stage")) as started:
        yield started


@pytest.fixture(scope="package")
def browser():
    with chromium() as started:
        yield started


@pytest.fixture
def context(browser):
    made = browser.new_context(viewport={"width": 1280, "height": 800})
    yield made
    made.close()


@pytest.fixture
def player(context):
    made = Player(context.new_page())
    yield made
    assert made.problems == []


@pytest.fixture
def phone(browser):
    made = browser.new_context(
        viewport={"width": 390, "height": 844}, has_touch=True, is_mobile=True, device_scale_factor=2
    )
    player = Player(made.new_page())
    yield player
    made.close()
    assert player.problems == []
