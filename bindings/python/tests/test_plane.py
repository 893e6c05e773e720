"""Sets of the plane, against what can be said of them with numpy alone."""

import numpy as np
import pytest

import azulejo
from naive import covering_radius, smallest_distance


def test_a_set_is_conflict_free_and_maximal():
    for seed in range(5):
        points = azulejo.kdrt_sample(0.05, seed=seed)
        assert points.positions.dtype == np.float32 and points.positions.shape == (len(points), 2)
        assert smallest_distance(points.positions, period=1.0) >= 0.05
        assert covering_radius(points.positions, period=1.0) <= 0.05
        assert points.report.radius == 0.05 and points.report.is_maximal
        assert points.ranks is None and points.classes is None and points.triangles is None


def test_a_conflict_and_a_gap_would_be_noticed():
    positions = azulejo.kdrt_sample(0.05).positions
    assert smallest_distance(np.vstack([positions, positions[:1] + 0.01]), period=1.0) < 0.05
    assert covering_radius(np.delete(positions, 17, axis=0), period=1.0) > 0.05


def test_a_bounded_rectangle():
    domain = dict(domain_min=(-1.0, 2.0), domain_max=(1.0, 2.5), boundary="bounded")
    positions = azulejo.kdrt_sample(0.05, **domain).positions
    assert (positions >= [-1.0, 2.0]).all() and (positions < [1.0, 2.5]).all()
    assert smallest_distance(positions) >= 0.05
    assert azulejo.plane_covering_radius(positions, **domain) <= 0.05 + 1e-6


def test_a_count_is_met_exactly():
    points = azulejo.kdrt_sample(count=777, seed=3)
    assert len(points) == 777
    assert smallest_distance(points.positions, period=1.0) >= points.report.radius


def test_every_prefix_of_a_progressive_set_is_well_spread():
    points = azulejo.kdrt_sample(0.05, order="progressive")
    assert points.ranks.dtype == np.float32 and (np.diff(points.ranks[1:]) <= 0).all()
    for count in (2, 10, 100, len(points)):
        assert smallest_distance(points.positions[:count], period=1.0) >= points.ranks[count - 1]


def test_given_samples_keep_their_clearances():
    given = np.array([[0.5, 0.5], [0.1, 0.9]], np.float32)
    clearances = np.array([0.2, 0.01])
    positions = azulejo.kdrt_sample(0.05, given_positions=given, given_clearances=clearances).positions
    offsets = positions[:, None].astype(float) - given
    distances = np.hypot(*np.moveaxis(offsets - np.round(offsets), 2, 0))
    assert (distances.min(axis=0) >= clearances).all() and (distances.min(axis=0) < clearances + 0.05).all()


def test_a_window_has_the_bytes_of_the_plane():
    window = ((0.25, 0.5), (0.75, 0.625))
    whole = azulejo.kdrt_sample(0.01, seed=8).positions
    inside = whole[((whole >= window[0]) & (whole < window[1])).all(axis=1)]
    plane = azulejo.KdrtPlane(0.01, seed=8)
    for part in (plane.window(*window), azulejo.kdrt_sample_window(*window, 0.01, seed=8)):
        assert {row.tobytes() for row in part.positions} == {row.tobytes() for row in inside}


def test_classes_keep_their_distances():
    radii = azulejo.classes_radii([0.05, 0.1])
    assert radii.shape == (2, 2) and (radii == radii.T).all() and list(radii.diagonal()) == [0.05, 0.1]
    points = azulejo.kdrt_sample_classes(radii)
    for i in range(2):
        for j in range(2):
            a, b = (points.positions[points.classes == k] for k in (i, j))
            assert smallest_distance(a, None if i == j else b, period=1.0) >= radii[i, j]
    window = azulejo.KdrtPlane(radii=radii).window((0, 0), (0.5, 0.5))
    assert set(window.classes) == {0, 1}
    ordered = azulejo.kdrt_sample_classes(radii, order="progressive", quotient=1.3)
    for i in range(2):
        ranks = ordered.ranks[ordered.classes == i]
        assert (np.diff(ranks) <= 0).all() and ranks[-1] == pytest.approx(radii[i, i])
        first = ordered.positions[ordered.classes == i][:20]
        assert smallest_distance(first, period=1.0) >= ranks[19]


def test_a_stream_is_the_plane_part_by_part():
    parts = []
    for threads in (1, 3):
        parts.append([])
        assert azulejo.kdrt_stream(parts[-1].append, 0.003, seed=3, threads=threads) is None
    one, three = parts
    assert [len(part) for part in one] == [len(part) for part in three] and len(one) > 1
    whole = azulejo.kdrt_sample(0.003, seed=3).positions
    assert one[0].dtype == np.float32 and np.vstack(one).tobytes() == np.vstack(three).tobytes() == whole.tobytes()


def test_pieces_are_merged():
    halves = [((0.0, 0.0), (0.5, 1.0)), ((0.5, 0.0), (1.0, 1.0))]
    pieces = [
        (azulejo.kdrt_sample(0.02, domain_min=low, domain_max=high, boundary="bounded").positions, low, high)
        for low, high in halves
    ]
    merged = azulejo.kdrt_merge(pieces, 0.02)
    assert merged.report.kept + merged.report.inserted == len(merged)
    assert azulejo.plane_coverage(merged.positions, 0.02).gaps == 0
    assert (azulejo.kdrt_merge(pieces, 0.02, maximal_pieces=True).positions == merged.positions).all()
    assert smallest_distance(merged.positions, period=1.0) >= 0.02


def test_relaxation_spreads_points():
    random = azulejo.dcr_scatter(np.ones((1, 1)), 300).positions
    relaxed = azulejo.dcr_relax(random)
    assert len(relaxed) == 300 and relaxed.report.stopped in ("converged", "steps")
    assert relaxed.report.rho > 0.8
    assert relaxed.report.smallest_distance == pytest.approx(smallest_distance(relaxed.positions, period=1.0), rel=1e-6)
    thesis = azulejo.dcr_relax(random, method="thesis", neighbourhood="nearest", distribution="average", max_iterations=5)
    assert thesis.report.iterations <= 5


def test_relaxation_reaches_a_power_and_a_measured_correlation():
    random = azulejo.dcr_scatter(np.ones((1, 1)), 2000)
    correlation = azulejo.dcr_correlation_of_power([0.0], 0.5)
    assert correlation.shape == (480,) and 0.1 < correlation[0] < 0.4
    step = azulejo.dcr_relax_to_correlation(random, correlation, 12.0)
    assert step.report.stopped == "converged" and step.report.residual <= 0.005
    measured = azulejo.plane_radial_distribution(step, 12.0, 480)
    again = azulejo.dcr_relax_to_correlation(random, measured, 12.0)
    assert again.report.stopped == "converged" and again.report.iterations > 1
    nowhere = azulejo.dcr_relax_to_correlation(random, [-1.0], 2.0, max_iterations=3)
    assert nowhere.report.stopped == "steps" and nowhere.report.residual > 0.1
    assert azulejo.dcr_relax(random, max_iterations=1).report.residual is None
    with pytest.raises(ValueError, match="boundary"):
        azulejo.dcr_relax_to_correlation(random, correlation, 12.0, boundary="bounded")
    with pytest.raises(ValueError, match="power"):
        azulejo.dcr_correlation_of_power([-1.0], 0.5)


def test_relaxation_spreads_classes():
    before = azulejo.kdrt_sample_classes(azulejo.classes_radii([0.08, 0.05]))
    after = azulejo.dcr_relax_classes(before.positions, before.classes)
    assert (after.classes == before.classes).all()
    assert after.report.rho > 0.7 and after.report.class_rho.dtype == np.float64
    sets = [slice(None), before.classes == 0, before.classes == 1]
    report = after.report
    rhos = [report.rho, *report.class_rho]
    coverages = [report.relative_covering_radius, *report.class_relative_covering_radius]
    for members, rho, coverage in zip(sets, rhos, coverages):
        points = after.positions[members]
        hexagonal = np.sqrt(2 / (np.sqrt(3) * len(points)))
        assert rho == pytest.approx(smallest_distance(points, period=1.0) / hexagonal, rel=1e-6)
        assert coverage - 0.005 / hexagonal < covering_radius(points, period=1.0) / hexagonal <= coverage + 1e-6
    assert azulejo.dcr_relax(before.positions, max_iterations=1).report.class_rho is None


def test_stippling_follows_an_image():
    image = np.array([[1.0, 3.0]])
    start = azulejo.dcr_scatter(image, 400, boundary="bounded").positions
    stipples = azulejo.dcr_relax_density(start, image, boundary="bounded", max_iterations=30)
    assert (stipples.positions[:, 0] > 0.5).mean() > 0.6


@pytest.mark.parametrize("height, width", [(60, 80), (80, 60), (1, 3)])
def test_stipples_keep_the_proportions_of_the_image(height, width):
    image = np.ones((height, width))
    corner = np.array([width, height]) / max(width, height)
    start = azulejo.dcr_scatter(image, 500)
    stipples = azulejo.dcr_relax_density(start, image, max_iterations=20)
    assert (azulejo.dcr_relax_density(start.positions, image, max_iterations=20).positions == stipples.positions).all()
    for points in (start, stipples):
        assert (points.positions < corner).all() and (points.positions.max(axis=0) > corner - 0.1).all()
    stretched = azulejo.dcr_scatter(image, 500, domain_max=(1, 1)).positions
    assert (stretched.max(axis=0) > 0.9).all()
    assert azulejo.dcr_scatter(image, 500, domain_min=(-1, 0)).positions.max(axis=0).min() > 0.9


@pytest.mark.parametrize("dimensions", [2, 3])
def test_thinning_is_what_it_says(dimensions):
    cloud = np.random.default_rng(1).random((500, dimensions), np.float32)
    kept = []
    for index, point in enumerate(cloud.astype(float)):
        if all(np.sqrt(((point - cloud[other].astype(float)) ** 2).sum()) >= 0.1 for other in kept):
            kept.append(index)
    assert azulejo.thin(cloud, radius=0.1).indices.tolist() == kept
    ordered = azulejo.thin(cloud, count=20, order="progressive", seed=4)
    assert len(ordered) == 20 and (np.diff(ordered.ranks[1:]) <= 0).all()


def test_analysis_agrees_with_numpy():
    positions = azulejo.kdrt_sample(0.05).positions
    smallest = smallest_distance(positions, period=1.0)
    report = azulejo.plane_measure(positions)
    assert azulejo.plane_smallest_distance(positions) == report.smallest_distance == pytest.approx(smallest, rel=1e-12)
    assert report.count == len(positions) and report.triangles == 2 * len(positions)
    histogram = azulejo.plane_nearest_histogram(positions, 2.0, 16)
    assert histogram.dtype == np.uint64 and histogram.sum() == len(positions)
    assert azulejo.plane_radial_distribution(positions, 2.0, 16)[0] == 0


def test_a_spectrum_is_the_direct_sum():
    positions = azulejo.kdrt_sample(0.1).positions.astype(float)
    spectrum = azulejo.Spectrum(positions, 16)
    waves = np.stack(np.meshgrid(np.arange(-8, 8), np.arange(-8, 8)), axis=-1)
    power = np.abs(np.exp(-2j * np.pi * waves @ positions.T).sum(axis=2)) ** 2 / len(positions)
    power[8, 8] = 0
    np.testing.assert_allclose(spectrum.power, power, rtol=1e-4, atol=1e-5)
    assert azulejo.Spectrum.mean([spectrum, spectrum]).size == 16
    assert spectrum.radial(0.1).shape[1] == 4
    assert spectrum.measure(0.1, 0.5, 0.1).contrast >= 0
