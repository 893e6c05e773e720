"""Sets on meshes."""

import numpy as np
import pytest

import azulejo
from meshes import random_places, torus
from naive import distances, smallest_distance


@pytest.fixture(scope="module")
def mesh():
    return azulejo.Mesh(*torus())


def test_a_mesh_is_what_was_given(mesh):
    positions, indices = torus()
    assert (mesh.positions == positions).all() and (mesh.indices == indices).all()
    assert (mesh.vertex_count, mesh.triangle_count) == (len(positions), len(indices))
    assert mesh.area == pytest.approx(4 * np.pi**2 * 0.4, rel=0.01) and not mesh.has_normals


def test_a_set_is_conflict_free_and_maximal(mesh):
    points = azulejo.psp_sample(mesh, 0.15, seed=2)
    assert smallest_distance(points.positions) >= 0.15
    assert distances(random_places(mesh), points.positions).min(axis=1).max() <= 0.15 + 1e-6
    assert azulejo.mesh_coverage(mesh, points.positions, 0.15 + 1e-6).gaps == 0
    assert azulejo.mesh_uncovered_fraction(mesh, points.positions, 0.15 + 1e-6) == 0
    assert azulejo.space_smallest_distance(points.positions) == pytest.approx(smallest_distance(points.positions))
    assert points.report.radius == 0.15 and points.report.uncovered_after == 0


def test_a_set_that_grows(mesh):
    growing = azulejo.Psp(mesh, 0.15, seed=2)
    assert len(growing.points()) == 0
    first = growing.advance(1)
    second = growing.advance(2, threads=1)
    assert (first.iterations, second.iterations) == (1, 2) and second.samples == first.samples + second.accepted
    projected = azulejo.psp_sample(mesh, 0.15, seed=2, iterations=3, maximal=False)
    assert growing.points().positions.tobytes() == projected.positions.tobytes()
    assert growing.fill().uncovered_after == 0
    filled = azulejo.psp_sample(mesh, 0.15, seed=2, iterations=3)
    assert growing.points().positions.tobytes() == filled.positions.tobytes()
    assert growing.fill().accepted == 0


def test_samples_lie_on_their_triangles(mesh):
    points = azulejo.psp_sample(mesh, 0.15, iterations=2, priority="projector")
    a, b, c = np.moveaxis(mesh.positions[mesh.indices[points.triangles]].astype(float), 1, 0)
    u, v = points.barycentrics.astype(float).T[:, :, None]
    np.testing.assert_allclose(points.positions, (1 - u - v) * a + u * b + v * c, atol=1e-6)
    assert points.normals.shape == (len(points), 3) and points.interpolated_normals is None


def test_a_count_and_an_order(mesh):
    points = azulejo.psp_sample(mesh, count=321, order="progressive")
    assert len(points) == 321
    for count in (2, 40, 321):
        assert smallest_distance(points.positions[:count]) >= points.ranks[count - 1]


def test_a_mask_and_normals():
    positions, indices = torus()
    mask = positions[indices][:, :, 0].mean(axis=1) > 0
    normals = positions - 0.1
    mesh = azulejo.Mesh(positions, indices, normals=normals, mask=mask)
    points = azulejo.psp_sample(mesh, 0.2)
    assert mesh.has_normals and points.interpolated_normals.shape == points.positions.shape
    assert mask[points.triangles].all()


def test_classes_keep_their_distances(mesh):
    radii = azulejo.classes_radii([0.2, 0.3], 0.9)
    points = azulejo.psp_sample_classes(mesh, radii)
    for i in range(2):
        for j in range(2):
            a, b = (points.positions[points.classes == k] for k in (i, j))
            assert smallest_distance(a, None if i == j else b) >= radii[i, j]
    ordered = azulejo.psp_sample_classes(mesh, radii, order="progressive")
    for i in range(2):
        ranks = ordered.ranks[ordered.classes == i]
        assert (np.diff(ranks) <= 0).all()
        assert smallest_distance(ordered.positions[ordered.classes == i][:12]) >= ranks[11]


def test_classes_follow_a_density(mesh):
    radii = azulejo.classes_radii([0.2, 0.3], 0.9)
    density = 1.0 + 3.0 * (mesh.positions[:, 0] > 0)
    masks = np.where(mesh.positions[mesh.indices][:, :, 2].mean(axis=1) > 0, 3, 1)
    points = azulejo.psp_classes_with_density(mesh, radii, density, radius=1, masks=masks, seed=3)
    assert points.radii.max() == pytest.approx(1) and points.radii.min() == pytest.approx(0.5)
    keep = radii[points.classes[:, None], points.classes] * (points.radii[:, None] + points.radii) / 2
    between = distances(points.positions, points.positions)
    np.fill_diagonal(between, np.inf)
    assert (between >= keep).all()
    assert set(points.classes) == {0, 1} and (masks[points.triangles[points.classes == 1]] == 3).all()
    # No sample of class 0 fits anywhere: of a place on a triangle of one density the local radius is known.
    places = random_places(mesh)
    places = places[np.abs(places[:, 0]) > 0.2]
    local = np.where(places[:, 0] > 0, 0.5, 1.0)
    reach = radii[0, points.classes] * (local[:, None] + points.radii) / 2
    assert (distances(places, points.positions) <= reach + 1e-6).any(axis=1).all()
    dense = points.positions[:, 0] > 0
    alone = azulejo.psp_sample_classes(mesh, radii, masks=masks, seed=3)
    for of in (0, 1):
        assert (dense & (points.classes == of)).sum() > 2.5 * ((alone.positions[:, 0] > 0) & (alone.classes == of)).sum()
    ordered = azulejo.psp_classes_with_density(mesh, radii, density, radius=1, order="progressive", quotient=1.3)
    for of in (0, 1):
        own = ordered.classes == of
        assert (np.diff(ordered.ranks[own]) <= 0).all()
        first, rank = ordered.positions[own][:12], ordered.ranks[own][11] / radii[of, of]
        local = ordered.radii[own][:12]
        between = distances(first, first) + np.diag(np.full(12, np.inf))
        assert (between >= radii[of, of] * rank * (local[:, None] + local) / 2).all()


def test_classes_with_a_density_are_refused_by_name(mesh):
    radii = azulejo.classes_radii([0.2, 0.3])
    density = np.ones(len(mesh.positions))
    for more, name in [
        (dict(), "radius"),
        (dict(radius=1, count=100), "radius"),
        (dict(radius=1, given_positions=[[1.4, 0, 0]]), "given_clearances"),
        (dict(radius=1, masks=[1]), "mask_count"),
        (dict(radius=1, quotient=1.1), "quotient"),
    ]:
        with pytest.raises(ValueError, match=f"^{name}"):
            azulejo.psp_classes_with_density(mesh, radii, density, **more)
    with pytest.raises(ValueError, match="^density"):
        azulejo.psp_classes_with_density(mesh, radii, density[1:], radius=1)


def test_radii_vary(mesh):
    radii = np.where(mesh.positions[:, 0] > 0, 0.1, 0.3)
    points = azulejo.psp_adaptive_sample(mesh, radii)
    mean = (points.radii[:, None] + points.radii) / 2
    between = distances(points.positions, points.positions)
    np.fill_diagonal(between, np.inf)
    assert (between >= mean).all() and points.radii.min() < 0.11 and points.radii.max() > 0.28


def test_a_density_at_vertices_and_in_an_image(mesh):
    density = 1.0 + 3.0 * (mesh.positions[:, 0] > 0)
    points = azulejo.psp_adaptive_with_density(mesh, density, count=500)
    assert 400 < len(points) < 600 and (points.positions[:, 0] > 0).mean() > 0.7
    texture = mesh.positions[:, :2] / 4 + 0.5
    for places in (texture, texture[mesh.indices]):
        image = azulejo.psp_adaptive_with_density(mesh, np.ones((4, 8)), radius=0.2, texture=places)
        assert image.radii == pytest.approx(0.2, rel=1e-6)


def test_varying_radii_in_progressive_order(mesh):
    density = 1.0 + 3.0 * (mesh.positions[:, 0] > 0)
    points = azulejo.psp_adaptive_with_density(mesh, density, count=400, order="progressive")
    fewer = azulejo.psp_adaptive_with_density(mesh, density, count=150, order="progressive")
    assert (len(points), len(fewer)) == (400, 150) and (points.positions[:150] == fewer.positions).all()
    assert (np.diff(points.ranks[1:]) <= 0).all() and points.report.radius == points.ranks[-1]
    radii = np.where(mesh.positions[:, 0] > 0, 0.1, 0.3)
    ranks = azulejo.psp_adaptive_sample(mesh, radii, order="progressive", quotient=1.3).ranks
    assert ranks[-1] >= 1 and azulejo.psp_adaptive_sample(mesh, radii).ranks is None
    with pytest.raises(ValueError, match="quotient"):
        azulejo.psp_adaptive_sample(mesh, radii, order="progressive", quotient=2)


def test_given_samples(mesh):
    given = mesh.positions[::100]
    points = azulejo.psp_sample(mesh, 0.15, given_positions=given)
    assert smallest_distance(points.positions, given) >= 0.15


def test_relaxation_on_a_mesh(mesh):
    points = azulejo.psp_sample(mesh, 0.2)
    relaxed = azulejo.dcr_surface_relax(mesh, points.triangles, points.barycentrics, max_iterations=20)
    assert len(relaxed) == len(points) and relaxed.report.relative_covering_radius is None
    assert smallest_distance(relaxed.positions) >= smallest_distance(points.positions)


def test_relaxation_on_a_mesh_to_a_density(mesh):
    x = mesh.positions[:, 0]
    density = (x > 0).astype(np.float32)
    points = azulejo.psp_sample(mesh, 0.1)
    relaxed = azulejo.dcr_surface_relax(mesh, points.triangles, points.barycentrics, density=density)
    # Triangles of which no vertex has a density have no samples.
    corners = mesh.indices[relaxed.triangles]
    assert len(relaxed) == len(points) and (density[corners].max(axis=1) > 0).all()
    assert relaxed.report.rho > 0
    even = azulejo.dcr_surface_relax(mesh, points.triangles, points.barycentrics, density=np.ones(len(x), np.float32))
    assert even.report.rho > 0.8
    with pytest.raises(ValueError, match="texture"):
        azulejo.dcr_surface_relax(mesh, points.triangles, points.barycentrics, texture=points.barycentrics)
    with pytest.raises(ValueError, match="density"):
        azulejo.dcr_surface_relax(mesh, points.triangles, points.barycentrics, density=density[1:])


def test_samples_become_a_mesh(mesh):
    points = azulejo.psp_sample(mesh, 0.2)
    made, report = azulejo.dcr_remesh(mesh, points.triangles, points.barycentrics)
    assert (made.positions == points.positions).all()
    corners = made.indices.astype(int)
    sides = np.vstack([corners[:, [0, 1]], corners[:, [1, 2]], corners[:, [2, 0]]])
    # Closed, and wound alike: each side once in each direction.
    assert len(set(map(tuple, sides))) == len(sides)
    assert set(map(tuple, sides)) == set(map(tuple, sides[:, ::-1]))
    assert report.triangles == made.triangle_count and report.inner_edges == len(sides) // 2
    assert (report.boundary_edges, report.non_manifold_edges, report.non_manifold_vertices) == (0, 0, 0)
    assert report.euler == len(points) - len(sides) // 2 + len(corners) == 0
    places = made.positions.astype(float)[corners]
    a, b = (np.roll(places, -step, axis=1) - places for step in (1, 2))
    angles = np.degrees(np.arccos((a * b).sum(axis=2) / np.linalg.norm(a, axis=2) / np.linalg.norm(b, axis=2)))
    assert report.smallest_angle == pytest.approx(angles.min(), abs=1e-6)
    assert report.largest_angle == pytest.approx(angles.max(), abs=1e-6)
    assert report.mean_smallest_angle == pytest.approx(angles.min(axis=1).mean(), abs=1e-6)


def test_samples_follow_a_deformed_mesh(mesh):
    points = azulejo.psp_sample(mesh, 0.2)
    moved = mesh.deform(mesh.positions * np.float32(2.0))
    np.testing.assert_allclose(
        moved.points(points.triangles, points.barycentrics).positions, 2 * points.positions, rtol=1e-6
    )


def test_differences(mesh):
    points = azulejo.psp_sample(mesh, 0.1)
    differences = azulejo.Differences(mesh, points.positions, points.normals)
    assert differences.density.shape == (128, 128) and differences.radial.shape == (512,)
    assert differences.radial[:40].max() == 0
    together = azulejo.Differences.mean([differences, differences])
    assert (together.power([0.25, 1.0]) == differences.power([0.25, 1.0])).all()


def test_files(tmp_path, mesh):
    path = tmp_path / "torus.obj"
    with open(path, "w") as file:
        file.writelines("v %r %r %r\n" % tuple(map(float, row)) for row in mesh.positions)
        file.writelines("f %d %d %d\n" % tuple(row + 1) for row in mesh.indices.astype(int))
    loaded = azulejo.Mesh.load(path)
    assert (loaded.positions == mesh.positions).all() and (loaded.indices == mesh.indices).all()
    with pytest.raises(FileNotFoundError, match="nothing.ply"):
        azulejo.Mesh.load(str(tmp_path / "nothing.ply"))
    (tmp_path / "bad.obj").write_text("v 0 0\nf 1 2 3\n")
    with pytest.raises(ValueError, match="bad.obj"):
        azulejo.Mesh.load(tmp_path / "bad.obj")
