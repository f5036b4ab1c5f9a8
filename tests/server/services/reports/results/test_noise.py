"""The noise of a study's own search: simulated once, behind the page, and then remembered."""

import hashlib
import json
import logging
import threading
from dataclasses import asdict, replace

import numpy as np
import pytest

from emogen_core.search import preference
from emogen_core.search.strategies import STRATEGIES
from emogen_core.simulation.evaluation.laboratory import Laboratory
from emogen_core.simulation.evaluation.specs import RunSpec
from emogen_core.simulation.evaluation.threshold import threshold
from server.reporting.noise import laboratory
from server.services.own_call import made_aside
from server.services.reports.results import noise as module
from server.services.reports.results.noise import NoiseOfSearch, settling_of
from server.services.trials.evolution import simulated
from tests.conftest import small_study


@pytest.fixture
def noise(rig, tmp_path):
    made = NoiseOfSearch(lambda _: rig, tmp_path / "noise", searches=100)
    yield made
    made.close()


def known(noise, config):
    noise.of(config)
    noise.settle()
    return noise.of(config)


def test_nobody_waits_for_it(noise):
    assert noise.of(small_study()) is None
    assert noise.of(small_study()) is None, "asked for twice, simulated once"
    assert known(noise, small_study()).searches == 100
    assert len(list(noise.folder.iterdir())) == 1


def test_it_depends_on_the_search_and_not_on_the_words(noise):
    first = known(noise, small_study())
    assert noise.of(small_study(title="Another title", quota=20)) == first
    assert noise.of(small_study(generations=3)) is None
    assert known(noise, small_study(generations=3)) != first


def test_other_processes_find_it(noise, rig, tmp_path):
    first = known(noise, small_study())
    other = NoiseOfSearch(lambda _: rig, tmp_path / "noise", searches=100)
    assert other.of(small_study()) == first
    other.close()


@pytest.mark.parametrize("damage", ["", "{}", '{"searches": 1}', "[]"])
def test_a_damaged_file_is_made_anew(noise, rig, tmp_path, damage):
    first = known(noise, small_study())
    next(noise.folder.iterdir()).write_text(damage)
    other = NoiseOfSearch(lambda _: rig, tmp_path / "noise", searches=100)
    assert known(other, small_study()) == first
    other.close()


def test_a_folder_that_cannot_be_written_stops_nobody(rig, tmp_path, caplog):
    (tmp_path / "noise").write_text("a file in the way")
    noise = NoiseOfSearch(lambda _: rig, tmp_path / "noise", searches=100)
    with caplog.at_level(logging.WARNING):
        assert known(noise, small_study()) is not None
    assert "cannot be kept" in caplog.text
    noise.close()


def test_closing_does_not_wait_for_the_end(rig, tmp_path, caplog):
    noise = NoiseOfSearch(lambda _: rig, tmp_path / "noise", searches=10_000)
    noise.of(small_study())
    with caplog.at_level(logging.ERROR):
        noise.close()
    assert caplog.text == ""


def test_it_settles_as_the_simulated_people_do(noise):
    found = known(noise, small_study())
    told = settling_of(found)
    assert told.noisy == tuple(one.mean for one in found.noisy.settling)
    assert told.near == found.faithful.error.mean
    assert len(told.faithful) == len(told.random) == small_study().generations
    assert settling_of(None) is None


def test_selections_and_several_first_populations_count(noise, rig):
    genes = len(rig.genes)
    populations = tuple(tuple(tuple(0.1 * k for _ in range(genes)) for _ in range(10)) for k in (1, 5))
    fixed = {"initialisation": "fixed", "fixed_options": populations}
    plain, other = small_study(), small_study(minimum=5)
    drawn, second = small_study(search=fixed), small_study(search={**fixed, "fixed_option": 2})
    errors = [known(noise, one).faithful.error for one in (plain, other, drawn, second)]
    assert len(set(errors)) == 4


def learning(**changes):
    plain = small_study(**changes)
    return plain.model_copy(update={"search": plain.search.model_copy(update={"strategy": "preference"})})


def test_a_strategy_that_learns_is_simulated_aside_and_known_by_its_own_name(noise, monkeypatch):
    monkeypatch.setitem(STRATEGIES, "preference", preference)
    published, asked = known(noise, small_study()), []

    def aside(stopped, make, laboratory, searches):
        asked.append((make, laboratory.algorithm, laboratory.pause, searches))
        return replace(published, searches=7)

    monkeypatch.setattr(module, "made_aside", aside)
    assert known(noise, learning()).searches == 7
    assert asked == [(threshold, "preference", None, 100)]
    assert noise.of(small_study()) == published


def test_files_of_the_published_search_are_named_as_before_rigs_told_their_geometry(noise, rig):
    """Another name would have every study simulated anew."""
    config = small_study()
    params, _ = simulated(rig, config)
    told = asdict(replace(params, geometry=None)) | {"drawn": None, "rig": rig.hash, "searches": 100, "version": 5}
    del told["geometry"]
    told["algorithm"] = f"emogen/{STRATEGIES['emogen'].VERSION}"
    known(noise, config)
    name = hashlib.sha256(json.dumps(told, sort_keys=True).encode()).hexdigest()
    assert [file.name for file in noise.folder.iterdir()] == [f"{name}.json"]


def test_a_laboratory_goes_to_a_process_and_gives_the_same_there(rig):
    config = learning(generations=1)
    there = laboratory(rig, config, 1)
    spec = RunSpec("people", algorithm=there.algorithm)
    assert spec.learns
    made = made_aside(threading.Event(), Laboratory.chunk, there, spec, 0, 2)
    np.testing.assert_array_equal(made.weights, there.chunk(spec, 0, 2).weights)
