"""A report of the search's own estimates: they are read in the place of the faces chosen as best, or it is refused."""

import numpy as np
import pytest

from emogen_client import Export
from server.analysis.reading import read
from server.services.errors import InvalidError
from server.services.reports.tables.package import write_zip
from server.services.reports.tables.selection import Filters
from tests.conftest import small_study
from tests.server.walker import Walker

LEARNING = {"strategy": "preference", "activation": (2, 3)}


def recorded(house, client, folder, people=1, **options):
    study = house.studies.create(small_study(practice=None, **options))
    for _ in range(people):
        Walker(client, study.links[0]).finish()
    path = folder / "export.zip"
    write_zip(house.exports.package(study.id, "parquet", Filters()).entries(), path)
    return Export(path), house.journal.rig


def test_faces_are_the_estimates_and_the_faces_chosen_lead_to_them(house, client, tmp_path):
    export, rig = recorded(house, client, tmp_path, search=LEARNING)
    chosen, found = (read(export, rig, result=result) for result in ("elite", "estimate"))
    table = export.table("estimates").set_index("trial").loc[list(found.trials)]
    assert np.array_equal(found.faces.genes, table[[f"gene_{name}" for name in rig.gene_names]].to_numpy())
    assert np.array_equal(found.faces.weights, table[[f"weight_{name}" for name in rig.shape_names]].to_numpy())
    assert not np.array_equal(found.faces.weights, chosen.faces.weights)
    assert np.array_equal(found.chosen.weights, chosen.faces.weights)
    for way, before, face in zip(found.faces.elites, chosen.faces.elites, found.faces.weights, strict=True):
        assert np.array_equal(way, [*before, face])
    assert (found.result, set(found.face_ids)) == ("estimate", {""}), "an estimate is no face of the export"
    assert (chosen.result, chosen.trials) == ("elite", found.trials)


def test_where_a_trial_has_none_it_is_refused_in_words(house, client, tmp_path):
    conditions = [
        {"name": "learning", "changes": {"search": {**LEARNING, "random_genes": 6}}},
        {"name": "paper", "changes": {}},
    ]
    export, rig = recorded(house, client, tmp_path, people=2, conditions=conditions)
    with pytest.raises(InvalidError, match=r"expected one for each of 4 finished faces, got 2 .*emogen/1"):
        read(export, rig, result="estimate")
    assert len(read(export, rig).faces) == 4
