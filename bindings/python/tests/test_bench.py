"""What a call costs beside the work."""

from bench import CALLS, microseconds


def test_a_window_of_one_sample_costs_less_than_20_microseconds():
    # The best of many short rounds: what else the machine does takes none of them, or not all.
    assert microseconds(CALLS["a window of one sample"], threads=1, count=20, rounds=200) < 20
