#!/usr/bin/env python3
"""Figures of small point sets by numpy and scipy, for tests/all/analysis_reference.rs.

    python3 tests/all/analysis/reference.py > tests/all/analysis/reference.txt

Everything is found by the plainest means: direct Fourier sums, all pairs, scipy's Delaunay triangulation of all images of
the points around the torus. The sets stand in the table too, so that it does not matter how they are made.
Each line has the name of a set, that of a figure, and its numbers.
"""

import numpy as np
from scipy.spatial import Delaunay, cKDTree

# Of the annuli, in units of sqrt(density): no multiple of it is the length of a frequency, which rounding would put on
# either side.
WIDTH = 0.0977


def jittered(rng, columns, rows, amount):
    """A square lattice, each point moved at random."""
    x, y = np.meshgrid(np.arange(columns) + 0.5, np.arange(rows) + 0.5)
    points = np.stack([x.ravel(), y.ravel()], axis=1) + amount * (rng.random((columns * rows, 2)) - 0.5)
    return points % [columns, rows], [float(columns), float(rows)]


def darts(rng, count, radius):
    """Points of the unit torus, each as far as the radius from those before."""
    points = []
    while len(points) < count:
        dart = rng.random(2)
        if all(np.hypot(*wrapped(dart - other, np.ones(2))) >= radius for other in points):
            points.append(dart)
    return np.array(points), [1.0, 1.0]


def wrapped(offset, extent):
    return offset - extent * np.round(offset / extent)


def images(points, extent):
    """The points and all their images in two rings around the torus, the points first."""
    shifts = [(i, j) for i in range(-2, 3) for j in range(-2, 3) if (i, j) != (0, 0)]
    return np.concatenate([points] + [points + np.array(shift) * extent for shift in shifts])


def periodogram(points, extent, size):
    waves = np.arange(size) - size // 2
    along = [np.exp(-2j * np.pi * np.outer(waves, points[:, axis] / extent[axis])) for axis in (0, 1)]
    power = np.abs(along[1] @ along[0].T) ** 2 / len(points)
    power[size // 2, size // 2] = 0
    return power


def half_plane(power, extent, density):
    """Lengths and powers of the frequencies out to the largest circle, of opposite ones one."""
    size = len(power)
    waves = np.arange(size) - size // 2
    step = 1 / (extent * np.sqrt(density))
    column, row = np.meshgrid(waves, waves)
    length = np.hypot(column * step[0], row * step[1])
    last = waves[-1] * step.min()
    keep = (length <= last) & ((row > 0) | ((row == 0) & (column > 0)))
    return length[keep], power[keep]


def spectral(points, extent, size):
    density = len(points) / np.prod(extent)
    power = periodogram(points, extent, size)
    length, values = half_plane(power, extent, density)
    annulus = (length / WIDTH).astype(int)
    radial = []
    for index in range(annulus.max() + 1):
        inside = values[annulus == index]
        if len(inside) >= 2:
            mean = inside.mean()
            radial.append([length[annulus == index].mean(), mean, inside.var(ddof=1) / mean**2])
    return power, radial, nyquist(length, values), oscillation(length, values)


def nyquist(length, values):
    """Half of the frequency up to which the mean power is below 0.1 (Heck et al. 2013), one frequency after the other."""
    order = np.argsort(length)
    mean = np.cumsum(values[order]) / np.arange(1, len(order) + 1)
    loud = np.flatnonzero((length[order] >= 0.5) & (mean > 0.5))[0]
    quiet = np.flatnonzero(mean[:loud] < 0.1)
    return 0.5 * length[order][quiet[-1]] if len(quiet) else 0.0


def oscillation(length, values):
    """As in psa (Heck et al. 2013), less what the means of annuli scatter by chance."""
    annulus = (length / WIDTH).astype(int)
    curve = []
    for index in range(annulus.max() + 1):
        inside = values[annulus == index]
        if len(inside) >= 2:
            curve.append([length[annulus == index].mean(), inside.mean(), inside.var(ddof=1) / len(inside)])
    frequency, power, chance = np.array(curve).T
    first = np.flatnonzero(power >= 0.98)[0]
    keep = (np.arange(len(power)) >= first) & (frequency <= frequency[first] + 5)
    square = (power[keep] - 1) ** 2 - chance[keep]
    return 10 * np.sqrt(max(0.0, np.sum(square * frequency[keep]) / np.sum(frequency[keep])))


def pairs(points, extent, periodic, reach, bins):
    """g(r) by all pairs; in a bounded domain with the translation correction."""
    unit = np.sqrt(2 * np.prod(extent) / (np.sqrt(3) * len(points)))
    offset = points[:, None] - points[None, :]
    if periodic:
        offset = wrapped(offset, extent)
        weight = np.ones(offset.shape[:2])
    else:
        weight = 1 / np.prod(1 - np.abs(offset) / extent, axis=2)
    distance = np.hypot(offset[..., 0], offset[..., 1])
    apart = ~np.eye(len(points), dtype=bool)
    edges = np.linspace(0, reach * unit, bins + 1)
    found, _ = np.histogram(distance[apart], edges, weights=weight[apart])
    ring = np.pi * (edges[1:] ** 2 - edges[:-1] ** 2)
    nearest = np.where(apart, distance, np.inf).min(axis=1)
    histogram, _ = np.histogram(nearest, edges)
    g = found * np.prod(extent) / (len(points) * (len(points) - 1) * ring)
    return g, histogram, nearest


def triangles(points, extent):
    """Delaunay statistics of the torus: triangles whose first corner, of three that are images, is counted by thirds."""
    count = len(points)
    sites = images(points, extent)
    mesh = Delaunay(sites)
    inner = mesh.simplices[(mesh.simplices < count).any(axis=1)]
    weight = (inner < count).sum(axis=1) / 3
    corners = sites[inner]
    side = np.roll(corners, -1, axis=1) - corners
    length = np.hypot(side[..., 0], side[..., 1])
    cosine = -np.sum(side * np.roll(side, 1, axis=1), axis=2) / (length * np.roll(length, 1, axis=1))
    area = 0.5 * np.abs(side[:, 0, 0] * side[:, 1, 1] - side[:, 0, 1] * side[:, 1, 0])
    radius = length.prod(axis=1) / (4 * area)
    total = weight.sum()
    edge = np.average(length.mean(axis=1), weights=weight)
    edge_square = np.average((length**2).mean(axis=1), weights=weight)
    mean_area = np.average(area, weights=weight)
    indptr, neighbours = mesh.vertex_neighbor_vertices
    orders = []
    for point in range(count):
        way = sites[neighbours[indptr[point] : indptr[point + 1]]] - sites[point]
        orders.append(np.abs(np.exp(6j * np.arctan2(way[:, 1], way[:, 0])).mean()))
    return {
        "triangles": round(total),
        "obtuse": np.average((cosine < 0).any(axis=1), weights=weight),
        "below_30_degrees": np.average((cosine > np.sqrt(0.75)).any(axis=1), weights=weight),
        "edge_mean": edge,
        "edge_variation": edge_square / edge**2 - 1,
        "area_variation": np.average(area**2, weights=weight) / mean_area**2 - 1,
        "covering_radius": radius.max(),
        "bond_order": np.mean(orders),
    }


def figures(points, extent, size, reach, bins):
    points = points.astype(np.float32).astype(float)
    extent = np.array(extent)
    power, radial, effective_nyquist, omega = spectral(points, extent, size)
    table = triangles(points, extent)
    g, histogram, nearest = pairs(points, extent, True, reach, bins)
    bounded, _, _ = pairs(points, extent, False, reach, bins)
    tree, _ = cKDTree(images(points, extent)).query(points, k=2)
    assert np.allclose(tree[:, 1], nearest)
    table |= {
        "extent": extent,
        "points": points,
        "size": size,
        "width": WIDTH,
        "power": power[size // 2 :: 7, ::5],
        "radial": radial,
        "effective_nyquist": effective_nyquist,
        "oscillation": omega,
        "reach": reach,
        "distribution": g,
        "distribution_bounded": bounded,
        "nearest": histogram,
        "smallest_distance": nearest.min(),
        "mean_distance": nearest.mean(),
    }
    return table


def main():
    rng = np.random.default_rng(2013)
    sets = {
        "poisson": (rng.random((200, 2)), [1.0, 1.0]),
        "jittered": jittered(rng, 18, 12, 0.6),
        "darts": darts(rng, 230, 0.05),
    }
    for name, (points, extent) in sets.items():
        size = 321 if name == "jittered" else 211
        for figure, numbers in figures(points, extent, size, 3.0, 12).items():
            print(name, figure, *(f"{number:.10g}" for number in np.ravel(numbers)))


main()
