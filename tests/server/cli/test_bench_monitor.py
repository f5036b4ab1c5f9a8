"""The measurement of the monitor runs and tells what it measured; how fast it was is for people to judge."""

from server.cli.bench_monitor import bench_monitor


def test_every_span_and_the_list_are_measured(house):
    report = bench_monitor(house, participations=9, generations=4, studies=2, rounds=1)
    assert list(report) == [
        "participations", "generations", "studies", "look_hour_ms", "look_today_ms", "look_week_ms", "look_all_ms",
        "list_ms",
    ]  # fmt: skip
    assert all(value > 0 for value in report.values())
    assert sorted(one.complete for one in house.overview.all().studies) == [3, 8]
