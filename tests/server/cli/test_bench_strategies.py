"""Every strategy is measured after every choice of a trial."""

from emogen_core.search.strategies import STRATEGIES
from server.cli.bench_strategies import bench_strategies


def test_every_strategy_is_measured_after_every_choice():
    report = bench_strategies(1)
    assert set(report["strategies"]) == set(STRATEGIES)
    for found in report["strategies"].values():
        assert [one["generation"] for one in found["after_choice"]] == list(range(11))
        assert 0 < found["peak_mib"]["first"] <= found["peak_mib"]["all"]
        slowest = max(one["wall"]["p99"] for one in found["after_choice"])
        assert 0 < found["wall_ms"]["mean"] <= found["wall_ms"]["p99"] <= slowest
    slow, quick = (report["strategies"][name]["processor_ms"]["mean"] for name in ("preference", "emogen"))
    assert slow > quick, "what learns is measured with what it learns"
