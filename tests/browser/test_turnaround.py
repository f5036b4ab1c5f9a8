"""The bench takes part through the real pages; how long that takes is not tested."""

import pytest

from server.cli.turnaround import measure

pytestmark = pytest.mark.browser


def test_it_goes_through_whole_participations(stage, browser):
    before = stage.one("SELECT count(*) FROM participations")
    found = measure(browser, stage.address, stage.links["small"], 3, 0.5)
    assert found["n"] == 3
    assert stage.one("SELECT count(*) FROM participations") == before + 2
    assert 0 < found["turnaround_ms"]["median"] <= found["shown_ms"]["max"]
    assert all(part["median"] >= 0 for part in found["split_ms"].values())
