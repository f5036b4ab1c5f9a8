"""The counts behind docs/analysis.md: every design without and with what its test looks for."""

from server.cli.bench_analysis import bench_analysis


def test_every_design_is_counted_without_and_with_an_effect():
    report = bench_analysis(2, 5)
    assert (report["studies"], report["alpha"]) == (2, 0.05)
    asked = [{(one["design"], one["test"]) for one in report[part]} for part in ("false_positives", "power")]
    assert asked[0] == asked[1]
    assert len(asked[0]) == 11
    for one in (*report["false_positives"], *report["power"]):
        low, high = one["interval_95"]
        assert 0 <= low <= one["share"] == one["significant"] / 2 <= high <= 1
