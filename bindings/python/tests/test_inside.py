"""Sets of the inside of meshes, against every pair and many places."""

import numpy as np
import pytest

import azulejo
from naive import farthest, smallest_distance

CORNERS = np.array([[x, y, z] for z in (0, 2) for y in (0, 1) for x in (0, 1)], np.float32)
SQUARES = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]]
FACES = np.array([f for a, b, c, d in SQUARES for f in ([a, b, c], [a, c, d])], np.uint32)
BOX = (CORNERS, FACES)


def deep(depth, steps=16):
    """Places of the box that are deeper than the report says can be open."""
    axes = [np.linspace(depth, side - depth, steps) for side in (1, 1, 2)]
    return np.stack(np.meshgrid(*axes), axis=-1).reshape(-1, 3)


@pytest.mark.parametrize("surface", ["open", "first"])
def test_a_set_lies_inside_and_is_maximal(surface):
    points = azulejo.volume_sample_inside(BOX, 0.15, seed=4, surface=surface)
    positions, report = points.positions, points.report
    assert (positions >= 0).all() and (positions <= CORNERS[7]).all()
    assert smallest_distance(positions) >= 0.15
    assert 0 < report.depth < 0.11 * 0.15
    assert farthest(deep(report.depth), positions) <= 0.15 + 1e-5
    assert (report.radius, report.covering_radius) == (0.15, 0.15)
    assert points.normals is None and points.triangles is None and points.domain_min is None
    first, rest = np.split(positions, [report.surface_samples])
    on_surface = lambda p: np.isclose(p, 0).any(axis=1) | np.isclose(p, CORNERS[7]).any(axis=1)
    assert on_surface(first).all() and (len(first) > 100) == (surface == "first")
    assert not on_surface(rest).any() and len(rest) > 200


@pytest.mark.parametrize("surface", ["open", "first"])
def test_a_shell_is_filled_and_no_more(surface):
    points = azulejo.volume_sample_inside(BOX, 0.15, seed=4, surface=surface, thickness=0.2)
    positions, report = points.positions, points.report
    to_faces = lambda places: np.minimum(places, CORNERS[7] - places.astype(float)).min(axis=1)
    assert (to_faces(positions) <= 0.2).all() and smallest_distance(positions) >= 0.15
    places = deep(report.depth, 30)
    shell = places[to_faces(places) < 0.2 - report.depth]
    assert len(shell) > 5_000 and farthest(shell, positions) <= 0.15 + 1e-5
    everything = azulejo.volume_sample_inside(BOX, 0.15, seed=4, surface=surface)
    assert len(points) < len(everything)
    whole = azulejo.volume_sample_inside(BOX, 0.15, seed=4, surface=surface, thickness=0.501)
    assert (whole.positions == everything.positions).all()
    assert len(azulejo.volume_sample_inside(BOX, count=123, thickness=0.1)) == 123


def test_a_gap_would_be_noticed():
    points = azulejo.volume_sample_inside(BOX, 0.15)
    inner = ((points.positions > 0.3) & (points.positions < 0.7)).all(axis=1)
    positions = np.delete(points.positions, np.flatnonzero(inner)[0], axis=0)
    assert farthest(deep(points.report.depth, 40), positions) > 0.15 + 1e-5


def test_counts_orders_and_given_samples():
    points = azulejo.volume_sample_inside(BOX, count=200, order="progressive", quotient=1.2)
    assert len(points) == 200 and points.ranks.shape == (200,)
    given = points.positions[:10]
    around = azulejo.volume_sample_inside(BOX, 0.1, given_positions=given, tolerance=0.03)
    assert smallest_distance(np.concatenate([given, around.positions])) >= 0.1


@pytest.mark.parametrize("surface", ["open", "first"])
def test_relaxed_points_stay_inside(surface):
    start = azulejo.volume_sample_inside(BOX, 0.15, surface=surface)
    fixed = np.arange(len(start)) < start.report.surface_samples
    points = azulejo.volume_relax_inside(BOX, start.positions, fixed=fixed, max_iterations=60, tolerance=0)
    positions, report = points.positions, points.report
    assert (positions[fixed] == start.positions[fixed]).all()
    assert azulejo.Mesh(CORNERS, FACES).contains(positions[~fixed]).all()
    assert (positions[~fixed] != start.positions[~fixed]).any(axis=1).mean() > 0.5
    assert (report.iterations, report.stopped) == (60, "steps")
    assert smallest_distance(positions) == pytest.approx(report.smallest_distance)
    assert surface == "first" or report.smallest_distance > 0.16
    again = azulejo.volume_relax_inside(BOX, start.positions, fixed=fixed, max_iterations=60, tolerance=0, threads=2)
    assert (again.positions == positions).all()


def test_the_samples_of_the_surface_slide():
    start = azulejo.volume_sample_inside(BOX, 0.15, surface="first")
    sliding = np.arange(len(start)) < start.report.surface_samples
    points = azulejo.volume_relax_inside(BOX, start.positions, sliding=sliding, max_iterations=60)
    (slid, rest), size = (points.positions[sliding], points.positions[~sliding]), CORNERS[7]
    assert (np.minimum(slid, size - slid).min(axis=1) < 1e-6).all() and azulejo.Mesh(CORNERS, FACES).contains(rest).all()
    assert (slid >= 0).all() and (slid <= size).all() and points.report.smallest_distance > 0.16
    with pytest.raises(ValueError, match="sliding: point 0 is fixed"):
        azulejo.volume_relax_inside(BOX, start.positions, fixed=sliding, sliding=sliding)
    with pytest.raises(ValueError, match="sliding: has 1 entries for"):
        azulejo.volume_relax_inside(BOX, start.positions, sliding=[True])


def test_relaxation_inside_refuses_what_it_cannot_do():
    inside = [[0.5, 0.5, 0.5], [0.5, 0.5, 1.5]]
    for mesh, positions, fixed, said in [
        (BOX, [[0.5, 0.5, 2.5]], None, r"positions: point 0 is \(0.5, 0.5, 2.5\), outside the mesh"),
        (BOX, [[0.5, 0.5, np.nan]], None, "positions"),
        (BOX, inside, [True], "fixed: has 1 entries for 2 points"),
    ]:
        with pytest.raises(ValueError, match=said):
            azulejo.volume_relax_inside(mesh, np.float32(positions), fixed=None if fixed is None else np.array(fixed))


def test_points_of_a_closed_mesh_are_inside():
    mesh = azulejo.Mesh(CORNERS, FACES)
    places = np.random.default_rng(3).uniform(-0.5, 2.5, (2000, 3)).astype(np.float32)
    expected = ((places > 0) & (places < CORNERS[7])).all(axis=1)
    assert mesh.is_closed and 100 < expected.sum() < 1900
    inside = mesh.contains(places)
    assert inside.dtype == bool and (inside == expected).all()
    assert (mesh.contains(places, threads=2) == expected).all()
    with pytest.raises(ValueError, match="positions"):
        mesh.contains([[np.nan, 0, 0]])
    assert mesh.contains(np.empty((0, 3))).shape == (0,)


def test_the_inside_of_an_open_mesh_is_where_it_winds():
    mesh = azulejo.Mesh(CORNERS, FACES[2:])  # without its floor
    assert not mesh.is_closed
    assert mesh.contains([[0.5, 0.5, 1.5], [0.5, 0.5, 2.5], [0.5, 0.5, -1.0]]).tolist() == [True, False, False]
    points = azulejo.volume_sample_inside(mesh, 0.2)
    assert smallest_distance(points.positions) >= 0.2 and azulejo.Mesh(CORNERS, FACES).contains(points.positions).all()
    with pytest.raises(ValueError, match="mesh: encloses nothing"):
        azulejo.volume_sample_inside((CORNERS, FACES[:1]), 0.2)


def test_a_far_mesh_contains_in_the_frame_of_the_caller():
    origin = np.array([1e6 + 0.3, 0.0, -1e6 - 0.7])
    mesh = azulejo.Mesh(CORNERS + origin, FACES)
    assert mesh.contains(np.array([[0.5, 0.5, 1.0], [0.5, 0.5, 3.0]]) + origin).tolist() == [True, False]


def test_a_far_mesh_keeps_its_origin():
    origin = np.array([1e6 + 0.3, 0.0, -1e6 - 0.7])
    far = azulejo.volume_sample_inside((CORNERS + origin, FACES), 0.2)
    moved = far.positions - origin
    assert far.positions.dtype == np.float64 and smallest_distance(moved) > 0.2 - 1e-6
    assert ((moved > -1e-6) & (moved < CORNERS[7] + 1e-6)).all() and len(far) > 100


@pytest.mark.parametrize(
    "wrong, argument",
    [
        (dict(tolerance=0.7), "tolerance"),
        (dict(thickness=-0.1), "thickness"),
        (dict(thickness=1e-5), "thickness"),
        (dict(surface="second"), "surface"),
        (dict(surface="first", order="progressive"), "surface"),
        (dict(radius=-0.1), "radius"),
        (dict(mesh=(CORNERS, FACES[:1])), "mesh"),
    ],
)
def test_bad_arguments_are_named(wrong, argument):
    with pytest.raises(ValueError, match=f"^{argument}: "):
        azulejo.volume_sample_inside(**{"mesh": BOX, "radius": 0.1, **wrong})
