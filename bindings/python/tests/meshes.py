"""Meshes for the tests, and places on them."""

import numpy as np


def torus(columns=48, rows=32):
    """Positions and indices of a torus of radii 1 and 0.4."""
    around_hole, around_tube = np.meshgrid(
        2 * np.pi * np.arange(columns) / columns, 2 * np.pi * np.arange(rows) / rows, indexing="ij"
    )
    radius = 1 + 0.4 * np.cos(around_tube)
    positions = np.stack(
        [radius * np.cos(around_hole), radius * np.sin(around_hole), 0.4 * np.sin(around_tube)], axis=-1
    )
    column, row = np.meshgrid(np.arange(columns), np.arange(rows), indexing="ij")
    right, up = (column + 1) % columns, (row + 1) % rows
    a, b, c, d = (x * rows + y for x, y in ((column, row), (right, row), (right, up), (column, up)))
    indices = np.stack([a, b, c, a, c, d], axis=-1)
    return positions.reshape(-1, 3).astype(np.float32), indices.reshape(-1, 3).astype(np.uint32)


def random_places(mesh, count=20000, seed=5):
    """Random, uniform on the surface: float64, shape (count, 3)."""
    rng = np.random.default_rng(seed)
    corners = mesh.positions[mesh.indices].astype(float)
    areas = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
    chosen = corners[rng.choice(len(corners), count, p=areas / areas.sum())]
    u, v = rng.random((2, count))
    u, v = np.where(u + v > 1, (1 - u, 1 - v), (u, v))
    return chosen[:, 0] + u[:, None] * (chosen[:, 1] - chosen[:, 0]) + v[:, None] * (chosen[:, 2] - chosen[:, 0])
