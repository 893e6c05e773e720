"""Coordinates far from the origin, as maps have them: in doubles, of which floats would keep half a metre."""

import itertools

import numpy as np
import pytest

import azulejo
from meshes import torus
from naive import distances, smallest_distance

UTM = np.array([500000.0, 4649776.0])
PLACE = np.array([500000.0, 4649776.0, 12.5])


def cloud(seed, count=1500, size=20.0):
    return np.random.default_rng(seed).random((count, 2)) * size + UTM


@pytest.fixture(scope="module")
def far():
    positions, indices = torus()
    return azulejo.Mesh(positions.astype(float) + PLACE, indices)


@pytest.fixture(scope="module")
def near():
    return azulejo.Mesh(*torus())


@pytest.mark.parametrize("seed, radius", list(itertools.product(range(4), (0.2, 0.5, 2.0))))
def test_thinned_doubles_keep_the_radius(seed, radius):
    points = cloud(seed)
    kept = points[azulejo.thin(points, radius=radius).indices]
    assert smallest_distance(kept - UTM) >= radius
    assert distances(points - UTM, kept - UTM).min(axis=1).max() < radius + 1e-5
    # Rounded by the caller, as the library once did, they do not.
    wrong = points[azulejo.thin(points.astype(np.float32), radius=radius).indices]
    assert smallest_distance(wrong - UTM) < radius


def test_doubles_near_the_origin_keep_the_radius_too():
    for seed in range(20):
        points = np.random.default_rng(seed).integers(0, 40, (400, 3)) * 0.1
        kept = points[azulejo.thin(points, radius=0.3).indices]
        assert smallest_distance(kept) >= 0.3


def test_thinning_in_space_and_of_whole_numbers():
    points = np.random.default_rng(1).integers(0, 1000, (800, 3)) + np.array([2**40, 5, -(2**33)])
    kept = points[azulejo.thin(points, radius=100).indices]
    assert smallest_distance((kept - points[0]).astype(float)) >= 100
    ordered = azulejo.thin(points, count=50, order="progressive")
    local = (points[ordered.indices] - points[0]).astype(float)
    assert smallest_distance(local) >= ordered.ranks[-1] - 1e-3


def test_a_mesh_has_an_origin_and_the_right_area(far, near):
    assert far.area == pytest.approx(near.area, rel=1e-6)
    assert (near.origin == 0).all() and near.positions.dtype == near.local_positions.dtype == np.float32
    assert np.abs(far.origin - PLACE)[:2].max() < 3 and far.origin[2] == 0
    positions = torus()[0].astype(float) + PLACE
    assert far.positions.dtype == np.float64 and np.abs(far.positions - positions).max() < 1e-6
    assert (far.origin + far.local_positions == far.positions).all()
    # What floats hold is kept as it is.
    floats = (torus()[0] * 64 + 4096).round()
    assert (azulejo.Mesh(floats.astype(float), torus()[1]).positions == floats).all()
    moved = far.deform(positions + [0, 0, 1e6])
    assert moved.origin[2] != 0 and moved.area == pytest.approx(near.area, rel=1e-6)


def test_samples_of_a_far_mesh_are_in_its_frame(far):
    points = azulejo.psp_sample(far, 0.2, seed=3)
    assert (points.origin == far.origin).all() and points.positions.dtype == np.float64
    assert smallest_distance(points.local_positions) >= 0.2
    assert smallest_distance(points.positions - PLACE) >= 0.2 - 1e-8
    corners = far.positions[far.indices[points.triangles]]
    u, v = points.barycentrics.astype(float).T[:, :, None]
    expected = (1 - u - v) * corners[:, 0] + u * corners[:, 1] + v * corners[:, 2]
    assert np.abs(points.positions - expected).max() < 1e-6
    for same in (points, points.positions):
        assert azulejo.mesh_coverage(far, same, 0.2 + 1e-5).gaps == 0
        assert azulejo.mesh_uncovered_fraction(far, same, 0.2 + 1e-5) == 0
        assert azulejo.space_smallest_distance(same) == pytest.approx(smallest_distance(points.local_positions))
    at = far.points(points.triangles, points.barycentrics)
    assert (at.positions == points.positions).all()
    relaxed = azulejo.dcr_surface_relax(far, points.triangles, points.barycentrics, max_iterations=5)
    made, _ = azulejo.dcr_remesh(far, points.triangles, points.barycentrics)
    assert np.abs(relaxed.positions - PLACE).max() < 2 and (made.positions == points.positions).all()
    azulejo.Differences(far, points, points.normals)


def test_given_samples_and_edits_of_a_far_mesh(far):
    given = far.positions[::100]
    for points in (azulejo.psp_sample(far, 0.2, given_positions=given), azulejo.Psp(far, 0.2, given_positions=given)):
        if isinstance(points, azulejo.Psp):
            points.fill()
            growing, points = points, points.points()
        assert smallest_distance(points.positions - PLACE, given - PLACE) >= 0.2 - 1e-6
    erased = growing.erase(points.positions[7], 0.5)
    assert len(erased) > 3 and np.abs(erased.positions - points.positions[7]).max() <= 0.5
    growing.restore(erased)
    box = growing.erase(min=PLACE - 1, max=PLACE + [0, 0, 1])
    assert len(box) > 3 and (box.positions <= PLACE + [0, 0, 1]).all()


DOMAIN = dict(domain_min=UTM, domain_max=UTM + [20, 10])


@pytest.mark.parametrize("boundary", ["periodic", "bounded"])
def test_a_far_domain_is_as_fine_as_a_near_one(boundary):
    near = azulejo.kdrt_sample(0.1, domain_max=(20, 10), boundary=boundary)
    points = azulejo.kdrt_sample(0.1, **DOMAIN, boundary=boundary)
    assert points.positions.dtype == np.float64 and (points.origin != 0).all() and len(points) > 10000
    assert ((points.positions >= UTM) & (points.positions < UTM + [20, 10])).all()
    figures = azulejo.plane_measure(points)
    assert figures.smallest_distance >= 0.1 and figures.covering_radius <= 0.1 + 1e-5
    assert azulejo.plane_coverage(points, 0.1 + 1e-5).gaps == 0
    again = azulejo.plane_measure(points.positions, **DOMAIN, boundary=boundary)
    assert again.smallest_distance == pytest.approx(figures.smallest_distance, rel=1e-6)
    assert len(points) == pytest.approx(len(near), rel=0.02)


def test_windows_edits_and_streams_of_a_far_domain():
    whole = azulejo.kdrt_sample(0.2, **DOMAIN)
    window = azulejo.KdrtPlane(0.2, **DOMAIN).window(UTM + 1, UTM + [9, 5])
    inside = ((whole.positions >= UTM + 1) & (whole.positions < UTM + [9, 5])).all(axis=1)
    assert set(map(tuple, window.positions)) == set(map(tuple, whole.positions[inside]))
    parts = []
    azulejo.kdrt_stream(parts.append, 0.2, **DOMAIN)
    assert (np.vstack(parts) == whole.positions).all()
    plane = azulejo.Plane(0.2, **DOMAIN)
    erased = plane.erase(UTM + 5, 1.0)
    assert len(erased) > 10 and np.abs(erased.positions - UTM - 5).max() <= 1
    assert azulejo.plane_smallest_distance(plane.points()) >= 0.2
    given = azulejo.kdrt_sample(0.2, **DOMAIN, given_positions=[UTM + 3], given_clearances=[2.0])
    assert np.hypot(*(given.positions - UTM - 3).T).min() >= 2 - 1e-6


def test_relaxation_in_a_far_domain():
    start = azulejo.dcr_scatter(np.ones((1, 2)), 400, **DOMAIN)
    for points in (start, start.positions):
        options = {} if points is start else DOMAIN
        relaxed = azulejo.dcr_relax(points, max_iterations=30, **options)
        assert relaxed.report.rho > 0.6 and (relaxed.positions >= UTM).all()
    assert (azulejo.Spectrum(start, 16).power == azulejo.Spectrum(start.positions, 16, **DOMAIN).power).mean() > 0.5


def test_points_carry_their_domain():
    points = azulejo.kdrt_sample(0.05, domain_max=(1, 2), boundary="bounded")
    assert (points.domain_min, points.domain_max, points.boundary) == ([0, 0], [1, 2], "bounded")
    assert azulejo.plane_measure(points).smallest_distance >= 0.05
    assert azulejo.plane_smallest_distance(points.positions, domain_max=(1, 2)) < 0.05, "as a torus"
    assert azulejo.plane_smallest_distance(points, boundary="periodic") < 0.05
    relaxed = azulejo.dcr_relax(points, max_iterations=5)
    assert (relaxed.domain_max, relaxed.boundary) == ([1, 2], "bounded")
    stipples = azulejo.dcr_relax_density(points, [[1.0, 2.0]], max_iterations=2)
    assert stipples.boundary == "bounded" and azulejo.Plane(0.05, points).points().domain_max == [1, 2]
    assert azulejo.psp_sample(azulejo.Mesh(*torus()), 0.3).boundary is None


def test_text_files_far_from_the_origin(tmp_path):
    positions, indices = torus()
    with open(tmp_path / "a.obj", "w") as file:
        file.writelines("v %r %r %r\n" % tuple(map(float, row)) for row in positions + PLACE)
        file.writelines("f %d %d %d\n" % tuple(row + 1) for row in indices.astype(int))
    mesh = azulejo.Mesh.load(tmp_path / "a.obj")
    assert (mesh.origin[:2] != 0).all() and np.abs(mesh.positions - positions - PLACE).max() < 1e-5
