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


def dithered(ranks, image, levels):
    """What mask_dither returns, pixel by pixel. ranks: channels before the axes; image: channels behind them."""
    axes = image.ndim - 1
    pixels = ranks[0].size
    out = np.empty(image.shape, np.uint8)
    for place in np.ndindex(image.shape):
        at = tuple(i % n for i, n in zip(place[:axes], ranks.shape[1:]))
        threshold = (float(ranks[(place[axes] % len(ranks), *at)]) + 0.5) / pixels
        number = min(max(float(image[place]), 0.0), 1.0)
        out[place] = min(number * (levels - 1) + threshold, levels - 1)
    return out


def test_images_are_dithered():
    random = np.random.default_rng(1)
    for channels, depth in [(1, 1), (3, 1), (1, 5), (2, 5)]:
        ranks = azulejo.mask_create(9, 7, depth=depth, channels=channels, seed=4)
        full = ranks.reshape(channels, *([depth] if depth > 1 else []), 7, 9)
        size = (4, 11, 13) if depth > 1 else (11, 13)
        for levels in (2, 5):
            image = random.uniform(-0.1, 1.1, (*size, 3)).astype(np.float32)
            assert (azulejo.mask_dither(ranks, image, levels) == dithered(full, image, levels)).all()
            grey = image[..., 0]
            assert (azulejo.mask_dither(ranks, grey, levels) == dithered(full, grey[..., None], levels)[..., 0]).all()
            octets = random.integers(0, 256, size, np.uint8)
            expected = dithered(full, octets[..., None] / 255, levels)[..., 0]
            assert (azulejo.mask_dither(ranks, octets, levels) == expected).all()


def test_halftones_keep_their_light_and_bad_ones_are_refused():
    ranks = azulejo.mask_create(16, 16)
    assert azulejo.mask_dither(ranks, np.full((64, 64), 0.25)).sum() == 64 * 64 / 4
    image = np.zeros((4, 4))
    for name, args in [
        ("levels", (ranks, image, 1)), ("levels", (ranks, image, 257)), ("ranks", (ranks[:8], image)), ("ranks", (ranks[0], image)),
        ("image", (ranks, image[0])), ("image", (ranks, image * np.nan)),
    ]:
        with pytest.raises(ValueError, match=name):
            azulejo.mask_dither(*args)
