"""The benchmark of expression packing."""

from server.cli.bench_packing import SHARES, VARIANTS, bench_packing
from tests.rig_factory import small_rig


def test_it_has_the_size_of_the_public_model_and_counts_every_variant():
    told = bench_packing(small_rig(), 1)
    assert (told["made_up_face"]["shapes"], told["made_up_face"]["vertices"]) == (53, 9409)
    assert told["made_up_face"]["expressions"] >= told["made_up_face"]["minimum"] > 10
    assert [(row["variant"], row["mu"]) for row in told["expressions"]] == [(v, mu) for v in VARIANTS for mu in SHARES]
    for row in told["expressions"]:
        assert row["minimal"] == row["minimum"] <= row["greedy"] <= len(small_rig().core_shapes)
