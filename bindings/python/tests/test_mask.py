"""Blue-noise masks."""

import numpy as np
import pytest

import azulejo


def test_ranks_are_permutations():
    for channels, depth, shape in [(1, 1, (12, 20)), (3, 1, (3, 12, 20)), (1, 5, (5, 12, 20)), (2, 5, (2, 5, 12, 20))]:
        ranks = azulejo.mask_create(20, 12, depth=depth, channels=channels, seed=4)
        assert ranks.shape == shape and ranks.dtype == np.uint32
        for channel in ranks.reshape(channels, -1):
            assert (np.sort(channel) == np.arange(channel.size)).all()


def test_seeds_and_not_threads_decide():
    one, other = (azulejo.mask_create(16, 16, channels=3, seed=1, threads=threads) for threads in (1, 2))
    assert (one == other).all()
    assert (one[0] == azulejo.mask_create(16, 16, seed=1)).all()
    assert (one[0] != azulejo.mask_create(16, 16, seed=2)).any()


def test_a_tone_becomes_its_share_of_pixels():
    ranks = azulejo.mask_create(32, 32)
    for share in (0.25, 0.5, 0.75):
        dots = np.full((64, 64), share) > np.tile((ranks + 0.5) / ranks.size, (2, 2))
        assert dots.sum() == share * 64 * 64


@pytest.mark.parametrize(
    "name, value", [("width", 1), ("height", 2000), ("depth", 65), ("channels", 0), ("sigma", float("nan"))]
)
def test_bad_arguments_are_refused_by_name(name, value):
    with pytest.raises(ValueError, match=name):
        azulejo.mask_create(**{**dict(width=8, height=8), name: value})
