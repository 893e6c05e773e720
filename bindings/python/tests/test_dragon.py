"""The Stanford dragon, which test.sh fetches: the file that AZULEJO_DRAGON names."""

import hashlib
import os
import pathlib

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


@pytest.mark.skipif(not FILE, reason="AZULEJO_DRAGON names no file")
def test_its_samples_are_those_that_every_package_must_give():
    """packaging/installed.sh holds the packages that are published against this sum."""
    expected = (pathlib.Path(__file__).parents[3] / "packaging/installed/sum.txt").read_text().strip()
    positions = azulejo.psp_sample(azulejo.Mesh.load(FILE), 0.002, seed=4).positions
    assert hashlib.sha256(positions.tobytes()).hexdigest() == expected


def test_missing_samples_and_a_close_one_would_be_noticed():
    positions = azulejo.psp_sample(azulejo.Mesh(*torus()), 0.2).positions
    assert 0.2 <= smallest_distance_below(0.4, positions) == smallest_distance(positions)
    assert smallest_distance_below(0.4, np.vstack([positions, positions[:1] + np.float32(0.01)])) < 0.1
    places = random_places(azulejo.Mesh(*torus()))
    assert farthest(places, positions) <= 0.2 + 1e-6 < farthest(places, positions[30:])
