"""Sets of cuboids, against every pair and many places."""

import hashlib
import re
from pathlib import Path

import numpy as np
import pytest

import azulejo
from naive import distances, farthest, smallest_distance

SUMS = Path(__file__).parents[3] / "tests" / "sums.txt"
SLAB = dict(domain_min=(-1.0, 2.0, 0.0), domain_max=(1.0, 2.5, 0.25), boundary="bounded")


def places(low, high, steps=24):
    axes = [np.linspace(a, b, steps, endpoint=False) for a, b in zip(low, high)]
    return np.stack(np.meshgrid(*axes), axis=-1).reshape(-1, 3)


def given_samples():
    """Those of tests/sums/volume.rs."""
    given = np.array([[(i * step % 256) / 256 for step in (31, 47, 83)] for i in range(60)], np.float32)
    return given, np.array([0.3 / (1.0, 7.0, 60.0, 1000.0)[i % 4] for i in range(60)])


def test_a_set_is_conflict_free_and_maximal():
    for seed in range(3):
        points = azulejo.volume_sample(0.15, seed=seed)
        assert points.positions.dtype == np.float32 and points.positions.shape == (len(points), 3)
        assert smallest_distance(points.positions, period=1.0) >= 0.15
        assert farthest(places([0] * 3, [1] * 3), points.positions, period=1.0) <= 0.15 + 1e-6
        assert (points.report.radius, points.report.covering_radius) == (0.15, 0.15)
        assert points.ranks is None and points.normals is None and points.triangles is None
        assert (points.domain_min, points.domain_max, points.boundary) == ([0.0] * 3, [1.0] * 3, "periodic")


def test_a_tiled_set():
    points = azulejo.volume_sample(0.0288, leaf_size=6.0)
    assert 1.005 < len(points) / len(azulejo.volume_sample(0.0288)) < 1.06
    measured = azulejo.space_measure(points, radius=0.0288)
    assert measured.conflicts == 0 and measured.covering_radius <= 0.0288 + 1e-6


def test_a_gap_would_be_noticed():
    positions = np.delete(azulejo.volume_sample(0.15).positions, 17, axis=0)
    assert farthest(places([0] * 3, [1] * 3), positions, period=1.0) > 0.15 + 1e-6


def test_a_bounded_cuboid():
    points = azulejo.volume_sample(0.05, **SLAB)
    positions = points.positions
    assert points.boundary == "bounded" and len(points) > 1000
    assert (positions >= SLAB["domain_min"]).all() and (positions < SLAB["domain_max"]).all()
    assert smallest_distance(positions) >= 0.05
    assert farthest(places(SLAB["domain_min"], SLAB["domain_max"]), positions) <= 0.05 + 1e-6


def test_a_count_is_met_exactly():
    points = azulejo.volume_sample(count=500, seed=3)
    assert len(points) == 500
    assert smallest_distance(points.positions, period=1.0) >= points.report.radius
    assert farthest(places([0] * 3, [1] * 3), points.positions, period=1.0) <= points.report.covering_radius + 1e-6
    assert points.report.covering_radius <= 1.1 * points.report.radius


def test_every_prefix_of_a_progressive_set_is_well_spread():
    points = azulejo.volume_sample(count=600, order="progressive", quotient=1.2)
    assert points.ranks.dtype == np.float32 and (np.diff(points.ranks[1:]) <= 0).all()
    for count in (100, 250, 600):
        prefix, rank = points.positions[:count], points.ranks[count - 1]
        assert smallest_distance(prefix, period=1.0) >= rank
        assert farthest(places([0] * 3, [1] * 3), prefix, period=1.0) <= 1.2 * rank + 1e-6
    fewer = azulejo.volume_sample(count=250, order="progressive", quotient=1.2)
    assert (fewer.positions == points.positions[:250]).all()


def test_given_samples_keep_their_clearances():
    given, clearances = given_samples()
    positions = azulejo.volume_sample(0.1, given_positions=given, given_clearances=clearances).positions
    apart = distances(positions, given, period=1.0)
    assert (apart.min(axis=0) >= clearances).all() and len(positions) > 100
    open_places = places([0] * 3, [1] * 3)
    open_places = open_places[(distances(open_places, given, period=1.0) >= clearances).all(axis=1)]
    assert 0 < len(open_places) < 24**3
    assert farthest(open_places, positions, period=1.0) <= 0.1 + 1e-6
    alike = azulejo.volume_sample(0.1, given_positions=given).positions
    assert distances(alike, given, period=1.0).min() >= 0.1


def test_classes_keep_their_distances():
    radii = azulejo.classes_radii([0.25, 0.15, 0.15])
    given, clearances = np.float32([[0.5, 0.5, 0.5]]), [[0.4, 0.0, 0.1]]
    points = azulejo.volume_sample_classes(radii, boundary="bounded", given_positions=given, given_clearances=clearances)
    of, at = points.classes, points.positions.astype(float)
    apart = np.linalg.norm(at[:, None] - at, axis=2) + np.diag(np.full(len(at), np.inf))
    assert (apart >= radii[of][:, of]).all() and (np.linalg.norm(at - given, axis=1) >= np.array(clearances)[0][of]).all()
    shares = np.bincount(of)
    assert len(shares) == 3 and shares[0] > 10 and abs(shares[1] / shares[2] - 1) < 0.2
    # For each class no place is open.
    for own in range(3):
        free = np.ones(len(places([0] * 3, [1] * 3)), bool)
        for position, radius in zip(at, radii[own][of]):
            free &= np.linalg.norm(places([0] * 3, [1] * 3) - position, axis=1) > radius + 1e-6
        free &= np.linalg.norm(places([0] * 3, [1] * 3) - given[0], axis=1) > clearances[0][own]
        assert not free.any()
    for bad, said in [([[1, 2], [3, 1]], "radii"), (np.eye(3)[:2], "radii"), ([[1e-9]], "radii")]:
        with pytest.raises(ValueError, match=said):
            azulejo.volume_sample_classes(bad)
    far = azulejo.volume_sample_classes([[0.4]], domain_min=(1e7, 0, 0), domain_max=(1e7 + 1, 1, 1))
    assert far.positions.dtype == np.float64 and (far.classes == 0).all()


def test_a_cuboid_far_from_the_origin_is_in_doubles():
    low, high = (3.5e6, -2e6, 100.0), (3.5e6 + 1, -2e6 + 1, 101.0)
    points = azulejo.volume_sample(0.2, domain_min=low, domain_max=high)
    assert points.positions.dtype == np.float64 and points.local_positions.dtype == np.float32
    assert (points.positions >= low).all() and (points.positions < high).all()
    assert (points.origin != 0).tolist() == [True, True, False]
    assert smallest_distance(points.local_positions, period=1.0) >= 0.2


CALLS = {
    "volume torus": dict(radius=0.02, seed=71),
    "volume bar": dict(radius=0.05, seed=75, domain_min=(0.25, -7, 0), domain_max=(0.26, 7, 0.3), boundary="bounded"),
    "volume torus, given": dict(radius=0.04, seed=81, given=True),
    "volume cube, progressive, given": dict(
        radius=0.04, seed=81, order="progressive", quotient=1.3, boundary="bounded", given=True
    ),
    "volume torus, count, progressive": dict(count=5000, seed=82, order="progressive"),
}


@pytest.mark.parametrize("name", CALLS)
def test_the_bytes_are_those_of_the_rust_calls(name):
    given = given_samples() if CALLS[name].get("given") else (None, None)
    options = {key: value for key, value in CALLS[name].items() if key != "given"}
    points = azulejo.volume_sample(**options, given_positions=given[0], given_clearances=given[1])
    parts = [points.positions.ravel()] + ([] if points.ranks is None else [points.ranks])
    line = re.search(rf"^(\w+)  {re.escape(name)} \(", SUMS.read_text(), re.MULTILINE)
    assert hashlib.sha256(np.concatenate(parts).astype("<f4").tobytes()).hexdigest() == line[1]


def test_refusals_name_the_argument():
    for arguments, name in [
        (dict(), "radius"),
        (dict(radius=0.1, count=3), "count"),
        (dict(radius=-1.0), "radius"),
        (dict(radius=5.0), "radius"),
        (dict(count=-1), "count"),
        (dict(radius=0.1, domain_min=(2.0, 0.0, 0.0)), "domain_max"),
        (dict(radius=0.1, domain_min=(0.0, 0.0)), "domain_min"),
        (dict(radius=0.1, boundary="open"), "boundary"),
        (dict(radius=0.1, quotient=1.2), "quotient"),
        (dict(radius=0.1, order="progressive", quotient=3.0), "quotient"),
        (dict(count=10, given_positions=[[0.5, 0.5, 0.5]]), "given_clearances"),
        (dict(radius=0.1, given_positions=[[0.5, 0.5]]), "given_positions"),
        (dict(radius=0.1, seed=-1), "seed"),
        (dict(radius=0.1, leaf_size=5.0), "leaf_size"),
        (dict(count=10, leaf_size=20.0), "leaf_size"),
    ]:
        with pytest.raises(ValueError, match=f"^{name}: "):
            azulejo.volume_sample(**arguments)
    with pytest.raises(MemoryError):
        azulejo.volume_sample(1e-6)


def test_progress_cancels():
    with pytest.raises(azulejo.Cancelled):
        azulejo.volume_sample(0.01, progress=lambda done: done < 0.1)


def test_measures_agree_with_numpy():
    points = azulejo.volume_sample(0.2, domain_min=(-1, 0, 5), domain_max=(0, 1, 6.5), seed=3)
    xyz = points.positions.astype(float)
    offsets = np.abs(xyz[:, None] - xyz[None])
    offsets = np.minimum(offsets, np.array([1, 1, 1.5]) - offsets)
    distances = np.sqrt((offsets**2).sum(axis=2))[np.triu_indices(len(xyz), 1)]
    report = azulejo.space_measure(points, 0.25)
    assert report.count == len(xyz) and report.smallest_distance == pytest.approx(distances.min(), rel=1e-12)
    assert report.conflicts == (distances < 0.25).sum() > 0
    assert report.packed_distance == pytest.approx((2**0.5 * 1.5 / len(xyz)) ** (1 / 3))
    assert report.rho == report.smallest_distance / report.packed_distance
    assert report.relative_covering_radius == report.covering_radius / report.packed_distance
    covered = azulejo.space_coverage(points, 0.2)
    assert covered.gaps == 0 and covered.covering_radius == report.covering_radius <= 0.2 + 1e-5
    assert azulejo.space_coverage(points, 0.17).gaps > 0
    domain = dict(domain_min=(-1, 0, 5), domain_max=(0, 1, 6.5))
    assert repr(azulejo.space_measure(points.positions, 0.25, **domain)) == repr(report)
    bounded = azulejo.space_coverage(points.positions, 0.2, boundary="bounded", **domain)
    assert bounded.covering_radius > 0.2 and bounded.gaps > 0


def test_spectra_and_distributions_agree_with_numpy():
    domain = dict(domain_min=(-1, 0, 5), domain_max=(0, 1, 6.5))
    points = azulejo.volume_sample(0.2, **domain, seed=3)
    turns = (points.positions.astype(float) - [-1, 0, 5]) / [1, 1, 1.5]
    count = len(turns)

    def power(*waves):
        return np.abs(np.exp(-2j * np.pi * (turns @ waves)).sum()) ** 2 / count

    for axis in range(3):
        waves = np.eye(3)[axis]
        expected = [power(*(k * waves)) for k in range(1, 21)]
        np.testing.assert_allclose(azulejo.space_axis_power(points, axis, 20), expected, rtol=1e-9, atol=1e-9)
    steps = 1 / (np.array([1, 1, 1.5]) * (count / 1.5) ** (1 / 3))
    grid = np.stack(np.meshgrid(*[np.arange(-12, 13)] * 3, indexing="ij"), -1).reshape(-1, 3)
    lengths = np.linalg.norm(grid * steps, axis=1)
    for row in azulejo.space_spectrum(points, 0.9, width=0.3):
        inside = grid[(lengths // 0.3 == row[0] // 0.3) & (lengths > 0) & (lengths <= 0.9)]
        assert len(inside) == 2 * row[3]
        assert np.mean([power(*waves) for waves in inside]) == pytest.approx(row[1], rel=1e-5)
    unit = (2**0.5 * 1.5 / count) ** (1 / 3)
    density = azulejo.space_radial_distribution(points.positions, 1.9, 20, **domain)
    offsets = np.abs(turns[:, None] - turns[None])
    distances = np.linalg.norm(np.minimum(offsets, 1 - offsets) * [1, 1, 1.5], axis=2)[~np.eye(count, dtype=bool)]
    pairs, edges = np.histogram(distances / unit, 20, (0, 1.9))
    shells = 4 / 3 * np.pi * np.diff((edges * unit) ** 3) / 1.5 * count * (count - 1)
    np.testing.assert_allclose(density, pairs / shells, rtol=1e-9)


def test_relaxed_points_are_far_from_each_other():
    start = np.random.default_rng(5).random((400, 3), np.float32)
    relaxed = azulejo.volume_relax(start, boundary="periodic")
    report, spacing = relaxed.report, (2**0.5 / 400) ** (1 / 3)
    assert smallest_distance(relaxed.positions, period=1.0) == pytest.approx(report.smallest_distance, rel=1e-9)
    assert report.rho == pytest.approx(report.smallest_distance / spacing, rel=1e-9) and report.rho > 0.88
    assert (azulejo.volume_relax(start, boundary="periodic", threads=2).positions == relaxed.positions).all()
    assert (azulejo.volume_relax(start, max_iterations=0, boundary="bounded").positions == start).all()


def test_relaxed_points_keep_their_cuboid():
    points = azulejo.volume_sample(0.08, **SLAB)
    relaxed = azulejo.volume_relax(points)
    assert (relaxed.domain_min, relaxed.domain_max, relaxed.boundary) == (points.domain_min, points.domain_max, "bounded")
    assert (relaxed.positions >= SLAB["domain_min"]).all() and (relaxed.positions < SLAB["domain_max"]).all()
    assert relaxed.report.smallest_distance > 0.08


def test_relaxation_far_from_the_origin_is_that_at_the_origin():
    start = np.random.default_rng(6).integers(0, 256, (200, 3)) / 256.0
    origin = np.array([4e6, -2e6, 1e6])
    near = azulejo.volume_relax(start, domain_min=(0, 0, 0), domain_max=(1, 1, 1), boundary="bounded")
    far = azulejo.volume_relax(start + origin, domain_min=origin, domain_max=origin + 1, boundary="bounded")
    assert far.report.rho == pytest.approx(near.report.rho, rel=0.05)


def test_wrong_points_of_a_relaxation_are_named():
    for wrong, argument in [({"positions": [[0.5, 0.5, 1.5]]}, "positions"), ({"tolerance": -1.0}, "tolerance")]:
        with pytest.raises(ValueError, match=f"^{argument}"):
            azulejo.volume_relax(**{"positions": [[0.5] * 3], "boundary": "bounded", **wrong})


@pytest.mark.parametrize("boundary", ["periodic", "bounded"])
def test_radii_on_a_grid_are_kept_and_covered(boundary):
    values = np.array([[[0.1, 0.2]], [[0.15, 0.1]]], np.float32)
    points = azulejo.volume_adaptive_sample(values, boundary=boundary, seed=3)
    same = azulejo.volume_adaptive_sample(values, boundary=boundary, seed=3, threads=1)
    assert (points.positions == same.positions).all() and (points.radii == same.radii).all()

    def radius(at):
        x, z = at[:, 0].astype(float), at[:, 2].astype(float)
        low, high = (v[0, 0] + x * (float(v[0, 1]) - v[0, 0]) for v in values.astype(float))
        return low + z * (high - low)

    def between(a, b):
        d = np.abs(a[:, None].astype(float) - b[None].astype(float))
        d = np.minimum(d, 1 - d) if boundary == "periodic" else d
        return np.sqrt((d**2).sum(axis=2))

    assert np.allclose(radius(points.positions), points.radii, rtol=1e-9) and len(points) > 200
    means = 0.5 * (points.radii[:, None] + points.radii[None])
    apart = between(points.positions, points.positions) - means + 9 * np.eye(len(points))
    assert apart.min() >= -1e-12
    probes = np.random.default_rng(5).random((5000, 3))
    excess = between(probes, points.positions) - 0.5 * (radius(probes)[:, None] + points.radii[None])
    assert excess.min(axis=1).max() <= 1e-6
    assert points.report.radius == points.radii.min() and abs(points.report.covering_radius - 0.2) < 1e-7
