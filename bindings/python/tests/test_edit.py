"""Sets that are edited, in the plane and on meshes."""

import numpy as np
import pytest

import azulejo
from meshes import torus


@pytest.fixture
def mesh():
    return azulejo.Mesh(*torus())


def bytes_by_id(points):
    return {int(i): p.tobytes() for i, p in zip(points.ids, points.positions)}


def plane_is_maximal(points, radius):
    return (
        azulejo.plane_smallest_distance(points.positions) >= radius
        and azulejo.plane_covering_radius(points.positions) <= radius + 1e-6
    )


def test_a_stroke_in_the_plane_and_its_undo():
    plane = azulejo.Plane(0.01, seed=4)
    before = plane.points()
    assert before.positions.tobytes() == azulejo.kdrt_sample(0.01, seed=4).positions.tobytes()
    assert (before.ids == np.arange(len(before))).all() and before.ids.dtype == np.uint64
    # Over the seam.
    erased = plane.erase([1.0, 0.5], 0.1)
    assert (erased.positions[:, 0] < 0.2).any() and (erased.positions[:, 0] > 0.8).any()
    added = plane.refill(5)
    after = plane.points()
    assert plane_is_maximal(after, 0.01)
    kept = bytes_by_id(before).items() - bytes_by_id(erased).items()
    assert bytes_by_id(after).items() == kept | bytes_by_id(added).items()

    assert len(plane.erase_ids(added.ids)) == len(added)
    plane.restore(erased)
    assert bytes_by_id(plane.points()) == bytes_by_id(before)
    plane.erase([1.0, 0.5], 0.1)
    assert plane.refill(5, threads=2).positions.tobytes() == added.positions.tobytes()
    nothing = plane.refill(5)
    assert len(nothing) == 0 and nothing.ids.shape == (0,)


def test_given_samples_and_positions_in_the_plane():
    plane = azulejo.Plane(0.05, [[0.25, 0.5], [0.7, 0.1234567]], domain_max=[1, 2], boundary="bounded")
    plane.refill()
    assert (plane.points().positions[0] == [0.25, 0.5]).all()
    first, erased = plane.add_given([[0.5, 1]], [0.3])
    assert first == 0 and len(erased) > 50
    plane.refill()
    assert (np.hypot(*(plane.points().positions - [0.5, 1]).T) >= 0.3).all()
    plane.remove_given([0])
    assert len(plane.refill(1)) > 50
    assert len(plane.erase(min=[0, 0], max=[1, 0.5])) > 100


def test_a_stroke_on_a_mesh_and_its_undo(mesh):
    growing = azulejo.Psp(mesh, 0.1)
    growing.fill()
    assert growing.points().ids is None
    place = growing.points().positions[7]
    erased = growing.erase(place, 0.4)
    before = growing.points()
    added = growing.refill(3)
    assert added.report.accepted == len(added) > 10 and added.report.samples == len(growing.points())
    after = growing.points()
    assert bytes_by_id(after).items() == bytes_by_id(before).items() | bytes_by_id(added).items()
    assert azulejo.space_smallest_distance(after.positions) >= 0.1
    assert azulejo.mesh_coverage(mesh, after.positions, 0.1).gaps == 0

    growing.erase_ids(added.ids)
    growing.restore(erased)
    assert len(growing.points()) == len(before) + len(erased)
    assert (growing.points().triangles[7], growing.points().ids[7]) == (erased.triangles[list(erased.ids).index(7)], 7)
    first, gone = growing.add_given([place], [0.3])
    assert first == 0 and 7 in gone.ids
    growing.remove_given([first])
    assert growing.fill().accepted > 0
    with pytest.raises(ValueError, match="iterations: of a set that has been edited"):
        growing.advance(1)


def test_refusals(mesh):
    plane, growing = azulejo.Plane(0.1), azulejo.Psp(mesh, 0.3)
    growing.fill()
    for edited in (plane, growing):
        with pytest.raises(ValueError, match="ids: .* which no sample of the set has"):
            edited.erase_ids([2**64 - 1])
        with pytest.raises(ValueError, match="ids: -1 is not in 0 to"):
            edited.erase_ids([-1])
        with pytest.raises(ValueError, match="ids: 3 is listed twice"):
            edited.erase_ids([3, 3])
        with pytest.raises(ValueError, match="ids: .* which no given sample has"):
            edited.remove_given([0])
        with pytest.raises(ValueError, match="centre: None"):
            edited.erase(radius=1)
        with pytest.raises(ValueError, match="radius: None"):
            edited.erase([0] * (2 if edited is plane else 3))
        with pytest.raises(ValueError, match="stands already"):
            edited.restore(edited.points())
    with pytest.raises(ValueError, match="points: "):
        plane.restore(growing.points())
    with pytest.raises(ValueError, match="points: are not samples of a set that is edited"):
        plane.restore(azulejo.kdrt_sample(0.1))
    with pytest.raises(ValueError, match=r"positions: \[1\] is closer to \[0\]"):
        azulejo.Plane(0.1, [[0.5, 0.5], [0.5, 0.55]])
    plane.erase()

    def meddle(done):
        with pytest.raises(RuntimeError, match="in use by another call"):
            plane.erase()
        return False

    with pytest.raises(azulejo.Cancelled):
        plane.refill(progress=meddle)
    assert len(plane.points()) == 0 and len(plane.refill()) > 50
