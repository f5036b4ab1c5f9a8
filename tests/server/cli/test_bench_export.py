"""What the export is measured on is a study like any other."""

from server.cli.bench_export import FACES, GENERATIONS, _fill
from server.cli.filled import SETS
from tests.conftest import small_study
from tests.server.exported import lines


def test_the_study_that_is_filled_has_whole_participations(house):
    study = house.studies.create(small_study())
    _fill(house, study.id, 2)
    counts = {table.name: table.rows for table in house.exports.overview(study.id)}
    assert counts["faces"] == 2 * SETS * GENERATIONS * FACES
    assert counts["choices"] == counts["generations"] == counts["faces"] / FACES
    faces = lines(house, study.id, "faces")
    assert len({row["face"] for row in faces}) == len(faces)
    assert sum(row["elite"] for row in faces) == counts["choices"]
    numbers = [value for row in faces for name, value in row.items() if name.startswith(("gene_", "weight_"))]
    assert 0.1 < sum(value == 0 for value in numbers) / len(numbers) < 0.9
    assert len({row["weight_" + house.journal.rig.shape_names[0]] for row in faces} - {0}) > 1
