"""Oracles that are obviously right: every pair, and many places."""

import numpy as np


def distances(a, b, period=None):
    offsets = a[:, None].astype(float) - b[None].astype(float)
    if period is not None:
        offsets -= period * np.round(offsets / period)
    return np.sqrt((offsets**2).sum(axis=2))


def smallest_distance(a, b=None, period=None):
    if b is not None:
        return distances(a, b, period).min()
    all_pairs = distances(a, a, period)
    np.fill_diagonal(all_pairs, np.inf)
    return all_pairs.min()


def covering_radius(positions, period):
    """Of a square torus, too small by less than the distance of its places."""
    line = np.arange(200) / 200 * period
    places = np.stack(np.meshgrid(line, line), axis=-1).reshape(-1, 2)
    return max(distances(part, positions, period).min(axis=1).max() for part in np.array_split(places, 40))
