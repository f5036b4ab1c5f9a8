"""`emogen bench transfer` on a small rig."""

from emogen_core.face.rig_file import save_rig
from server.cli.bench_transfer import EXPRESSIONS, TRAINED, UNTRAINED, bench_transfer
from tests.rig_factory import small_rig


def test_every_method_is_measured_and_more_expressions_are_better(tmp_path):
    report = bench_transfer(save_rig(small_rig(), tmp_path / "small.rig"), seeds=2, rounds=1)
    rows = {(row["method"], row["expressions"]): row for row in report["synthetic"]}
    assert {method for method, _ in rows} == {*UNTRAINED, *TRAINED}
    counts = sorted(count for method, count in rows if method == "fields")
    assert counts
    assert max(counts) <= max(*EXPRESSIONS, report["shapes"])
    assert rows["fields", counts[-1]]["mean_mm"] < rows["warp", 0]["mean_mm"]
    assert all(0 <= row["mean_mm"] <= row["max_mm"] for row in report["synthetic"])
    assert {(row["head"], row["method"]) for row in report["identities"]} == {("male", method) for method in UNTRAINED}
    assert [row["method"] for row in report["time"]] == [*UNTRAINED, *TRAINED]
