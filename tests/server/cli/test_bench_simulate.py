"""The benchmark of simulated searches."""

from server.cli.bench_simulate import bench_simulate


def test_the_parts_add_up_to_the_whole():
    told = bench_simulate(100, 1)
    assert told["repetitions"] == 100
    assert told["generations"] == 10
    parts = told["weights_s"] + told["distances_s"] + told["search_s"]
    assert abs(parts - told["wall_s"]) < 0.005
    assert min(told["weights_s"], told["distances_s"], told["search_s"]) > 0
