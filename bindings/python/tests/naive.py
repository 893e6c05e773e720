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


def smallest_distance_below(limit, positions):
    """The smallest distance if it is below the limit, from every pair that is nearer than it along x; else the limit."""
    along_x = positions[np.argsort(positions[:, 0])].astype(float)
    smallest = limit
    for step in range(1, len(along_x)):
        offsets = along_x[step:] - along_x[:-step]
        if offsets[:, 0].min() >= limit:
            break
        smallest = min(smallest, np.sqrt((offsets**2).sum(axis=1).min()))
    return smallest


def farthest(places, positions, period=None):
    """How far the place that is farthest from all positions is from them."""
    parts = np.array_split(places, len(places) // 200 + 1)
    return max(distances(part, positions, period).min(axis=1).max() for part in parts)


def covering_radius(positions, period):
    """Of a square torus, too small by less than the distance of its places."""
    line = np.arange(200) / 200 * period
    return farthest(np.stack(np.meshgrid(line, line), axis=-1).reshape(-1, 2), positions, period)
