"""Axes: round ticks, ends that hold every value, times in their own zone."""

from datetime import UTC, datetime, timedelta, timezone

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from server.charts import exact_axis, log_axis, name_axis, number_axis, time_axis

NOON = datetime(2026, 11, 22, 12, 0, tzinfo=UTC)
finite = st.floats(-1e6, 1e6, allow_nan=False)


@given(finite, finite)
def test_a_number_axis_holds_its_range_at_round_steps(one, other):
    low, high = sorted((one, other))
    axis = number_axis(low, high)
    slack = 1e-8 * (axis.high - axis.low)
    assert axis.low <= low + slack and axis.high >= high - slack and axis.low < axis.high
    assert 2 <= len(axis.ticks) <= 12
    gaps = {round(b.at - a.at, 6) for a, b in zip(axis.ticks, axis.ticks[1:], strict=False)}
    assert max(gaps) - min(gaps) <= 1e-5
    assert all(0 <= axis.share(value) <= 1 for value in (low, high, low - 1, high + 1))


@pytest.mark.parametrize(
    ("low", "high", "labels"),
    [(0, 6, "0 2 4 6"), (0, 1.9, "0 0.5 1 1.5 2"), (0.7, 1, "0.7 0.8 0.9 1"), (0, 0, "0 1"), (0, 0.3, "0 0.1 0.2 0.3")],
)
def test_labels_are_what_a_person_would_write(low, high, labels):
    assert [tick.label for tick in number_axis(low, high).ticks] == labels.split()


def test_counts_have_no_half_people():
    assert [tick.label for tick in number_axis(0, 2, least=1).ticks] == ["0", "1", "2"]


@given(finite, finite)
def test_an_exact_axis_ends_where_its_range_does_with_round_ticks_inside(one, other):
    low, high = sorted((one, other))
    assume(high - low > 1e-3)
    axis = exact_axis(low, high)
    assert (axis.low, axis.high) == (low, high)
    assert 1 <= len(axis.ticks) <= 6
    assert all(low - 1e-6 <= tick.at <= high + 1e-6 for tick in axis.ticks)


@given(st.floats(1e-6, 1e6), st.floats(1, 1e6))
def test_on_a_logarithmic_axis_equal_ratios_are_equally_long(low, ratio):
    axis = log_axis(low, low * ratio)
    assert axis.low <= low * (1 + 1e-6) and low * ratio <= axis.high * (1 + 1e-6)
    shares = [axis.share(tick.at) for tick in axis.ticks]
    assert shares == pytest.approx([at / (len(shares) - 1) for at in range(len(shares))])
    assert axis.share(0) == axis.share(-1) == 0 and axis.share(axis.high * 2) == 1


@pytest.mark.parametrize(
    ("low", "high", "labels"),
    [(0.013, 1.3, "0.01 0.1 1 10"), (0.1, 10, "0.1 1 10"), (1, 1, "1 10"), (1e-6, 2e-6, "0.000001 0.00001")],
)
def test_powers_of_ten_are_written_out(low, high, labels):
    assert [tick.label for tick in log_axis(low, high).ticks] == labels.split()


def test_names_stand_one_apart():
    axis = name_axis(["Consent", "Set 1", "End"])
    assert [(tick.at, tick.label) for tick in axis.ticks] == [(0, "Consent"), (1, "Set 1"), (2, "End")]
    assert name_axis(["only"]).high == 1


@pytest.mark.parametrize(
    ("span", "first"),
    [
        (timedelta(hours=1), ["12:00", "12:10", "12:20"]),
        (timedelta(hours=6), ["12:00", "13:00", "14:00"]),
        (timedelta(hours=24), ["12:00", "18:00", "23 Nov"]),
        (timedelta(days=7), ["23 Nov", "25 Nov", "27 Nov"]),
        (timedelta(days=30), ["23 Nov", "30 Nov", "7 Dec"]),
        (timedelta(days=300), ["Jan 2027", "Mar 2027", "May 2027"]),
    ],
)
def test_times_are_round(span, first):
    labels = [tick.label for tick in time_axis(NOON, NOON + span).ticks]
    assert labels[: len(first)] == first
    assert len(labels) <= 8


@given(st.integers(1, 4000 * 24 * 3600), st.integers(-12, 14))
def test_time_ticks_lie_inside_and_in_order(seconds, hours):
    begin = datetime(2026, 11, 22, 13, 7, 31, tzinfo=timezone(timedelta(hours=hours)))
    axis = time_axis(begin, begin + timedelta(seconds=seconds))
    places = [tick.at for tick in axis.ticks]
    assert places == sorted(set(places))
    assert all(axis.low <= at <= axis.high for at in places)
    assert len(places) <= 9


def test_a_zone_moves_the_words_and_not_the_places():
    east = timezone(timedelta(hours=1))
    here, there = (
        time_axis(NOON, NOON + timedelta(hours=3)),
        time_axis(NOON.astimezone(east), NOON.astimezone(east) + timedelta(hours=3)),
    )
    assert (here.low, here.high) == (there.low, there.high)
    assert here.ticks[0].label == "12:00" and there.ticks[0].label == "13:00"
