"""The Stanford dragon, which test.sh fetches: the file that AZULEJO_DRAGON names."""

import os

import numpy as np
import pytest

import azulejo
from meshes import random_places, torus
from naive import farthest, smallest_distance, smallest_distance_below

# Samples of a maximal set of the plane for each squared radius (Rust: MAXIMAL_DENSITY).
MAXIMAL_DENSITY = 0.5470735 * 4 / np.pi
FILE = os.environ.get("AZULEJO_DRAGON")


@pytest.mark.skipif(not FILE, reason="AZULEJO_DRAGON names no file")
def test_the_dragon_is_sampled():
    mesh = azulejo.Mesh.load(FILE)
    assert mesh.triangle_count == 871414
    radius = np.ptp(mesh.positions, axis=0).max() / 100
    points = azulejo.psp_sample(mesh, radius, seed=4)
    assert smallest_distance_below(2 * radius, points.positions) >= radius
    assert farthest(random_places(mesh, 2000), points.positions) <= radius * (1 + 1e-5)
    # That of the plane, as far as the surface is flat over a radius.
    assert len(points) == pytest.approx(MAXIMAL_DENSITY * mesh.area / radius**2, rel=0.03)


def test_missing_samples_and_a_close_one_would_be_noticed():
    positions = azulejo.psp_sample(azulejo.Mesh(*torus()), 0.2).positions
    assert 0.2 <= smallest_distance_below(0.4, positions) == smallest_distance(positions)
    assert smallest_distance_below(0.4, np.vstack([positions, positions[:1] + np.float32(0.01)])) < 0.1
    places = random_places(azulejo.Mesh(*torus()))
    assert farthest(places, positions) <= 0.2 + 1e-6 < farthest(places, positions[30:])
