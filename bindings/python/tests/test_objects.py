"""Points, meshes, selections and reports as objects of Python: parts, iteration, text, copies, pickles, other processes."""

import copy
import multiprocessing
import pickle

import numpy as np
import pytest

import azulejo
from meshes import torus
from naive import smallest_distance
from test_inside import BOX

COLUMNS = (
    "positions local_positions origin normals interpolated_normals triangles barycentrics radii ranks classes ids"
).split()


def mesh(origin=0.0):
    positions, indices = torus()
    mask = positions[indices][:, :, 0].mean(axis=1) > -0.5
    return azulejo.Mesh(positions + np.array(origin), indices, normals=positions, mask=mask)


def sets():
    """Points of every kind, with every column that there is."""
    growing = azulejo.Psp(mesh(), 0.2)
    growing.fill()
    growing.erase([1, 0, 0], 0.5)
    density = np.ones(len(torus()[0]))
    ordered = dict(order="progressive")
    return {
        "plane": azulejo.kdrt_sample(0.05, **ordered),
        "bounded": azulejo.kdrt_sample(0.05, domain_max=(2, 1), boundary="bounded"),
        "far plane": azulejo.kdrt_sample(0.05, domain_min=(5e6, -3e6), domain_max=(5e6 + 1, -3e6 + 1)),
        "classes": azulejo.kdrt_sample_classes(azulejo.classes_radii([0.05, 0.1])),
        "mesh": azulejo.psp_sample(mesh(), 0.2),
        "far mesh": azulejo.psp_sample(mesh(4e6), 0.2, **ordered),
        "adaptive": azulejo.psp_classes_with_density(mesh(), [[1, 1], [1, 2]], density, radius=0.1),
        "edited": growing.points(),
        "box": azulejo.volume_sample(0.2, boundary="bounded", **ordered),
        "far box": azulejo.volume_sample(0.2, domain_min=(1e6,) * 3, domain_max=(1e6 + 1,) * 3),
        "relaxed": azulejo.dcr_relax_classes(azulejo.kdrt_sample(0.1), np.arange(len(azulejo.kdrt_sample(0.1))) % 2),
    }


@pytest.fixture(scope="module")
def all_sets():
    return sets()


def same(a, b):
    """Whether two arrays or values are the same, types and bytes."""
    if isinstance(a, np.ndarray) and isinstance(b, np.ndarray):
        return (a.dtype, a.shape, a.tobytes()) == (b.dtype, b.shape, b.tobytes())
    return type(a) is type(b) and a == b


def fields(report):
    return [name for name in dir(report) if not name.startswith("_")]


def same_reports(a, b):
    return type(a) is type(b) and all(same(getattr(a, name), getattr(b, name)) for name in fields(a))


def same_points(a, b):
    frames = [(p.domain_min, p.domain_max, p.boundary, len(p)) for p in (a, b)]
    return (
        frames[0] == frames[1]
        and all(same(getattr(a, name), getattr(b, name)) for name in COLUMNS)
        and same_reports(a.report, b.report)
    )


def test_all_columns_and_reports_are_tested(all_sets):
    for name in COLUMNS:
        assert any(getattr(points, name) is not None for points in all_sets.values()), name
    assert len({type(points.report) for points in all_sets.values()}) == 5
    assert not same_points(all_sets["plane"], all_sets["bounded"])


@pytest.mark.parametrize("protocol", range(pickle.HIGHEST_PROTOCOL + 1))
def test_points_are_pickled(all_sets, protocol):
    for name, points in all_sets.items():
        assert same_points(pickle.loads(pickle.dumps(points, protocol)), points), name


def test_points_are_copied(all_sets):
    for name, points in all_sets.items():
        shallow, deep = copy.copy(points), copy.deepcopy(points)
        assert same_points(shallow, points) and same_points(deep, points), name
        assert shallow.local_positions is points.local_positions
        assert not np.shares_memory(deep.local_positions, points.local_positions)
        assert (deep.positions is deep.local_positions) == (points.positions is points.local_positions)


def test_pickled_points_go_on(all_sets):
    for name in ("plane", "far plane", "bounded"):
        points = all_sets[name]
        again = pickle.loads(pickle.dumps(points))
        assert same(azulejo.dcr_relax(again).positions, azulejo.dcr_relax(points).positions)
        assert azulejo.plane_covering_radius(again) == azulejo.plane_covering_radius(points)
    growing = azulejo.Psp(mesh(), 0.2)
    growing.fill()
    erased = growing.erase([1, 0, 0], 0.5)
    growing.restore(pickle.loads(pickle.dumps(erased)))
    assert len(erased) > 5 and len(growing.refill()) == 0


def test_parts_have_all_that_is_known(all_sets):
    for name, points in all_sets.items():
        rows = np.arange(len(points))
        for key in (slice(None, 10), slice(None, None, 3), rows % 2 == 0, [5, 1, 1], np.array([3]), slice(0, 0)):
            part = points[key]
            assert type(part) is azulejo.Points and len(part) == len(rows[key]), name
            for column in COLUMNS:
                whole, some = getattr(points, column), getattr(part, column)
                expected = whole if whole is None or column == "origin" else whole[key]
                assert same(some, expected), (name, column)
            assert (part.domain_min, part.domain_max) == (points.domain_min, points.domain_max)
            assert part.boundary == points.boundary
            assert part.report is None


def test_rows_are_positions(all_sets):
    for points in all_sets.values():
        for key in (0, -1, np.int64(3), (slice(None), 0), (2, 1), (slice(3), slice(2)), None):
            assert same(points[key], points.positions[key])
        assert len(list(points)) == len(points)
        assert all(same(row, expected) for row, expected in zip(points, points.positions))
        for beyond in (len(points), -len(points) - 1):
            with pytest.raises(IndexError):
                points[beyond]
        with pytest.raises(IndexError):
            points["x"]


def test_a_prefix_is_a_set(all_sets):
    points = all_sets["plane"]
    prefix = points[:100]
    assert smallest_distance(prefix.positions, period=1.0) >= prefix.ranks[-1]
    assert azulejo.plane_covering_radius(prefix) <= 2 ** (1 / 8) * prefix.ranks[-1] + 1e-6
    moved = mesh().deform(2 * torus()[0]).points(all_sets["mesh"][::2].triangles, all_sets["mesh"][::2].barycentrics)
    np.testing.assert_allclose(moved.positions, 2 * all_sets["mesh"].positions[::2], rtol=1e-6)


def test_points_are_taken_as_dlpack(all_sets):
    for points in all_sets.values():
        taken = np.from_dlpack(points)
        assert same(taken, points.positions) and np.shares_memory(taken, points.positions)
        assert points.__dlpack_device__() == points.positions.__dlpack_device__()


def test_texts_are_readable(all_sets):
    points = all_sets["bounded"]
    report = "azulejo.KdrtReport(radius=0.05, is_maximal=True)"
    assert repr(points) == f"<azulejo.Points: {len(points)} in [0.0, 0.0] to [2.0, 1.0], bounded; {report}>"
    assert repr(points[:3]) == "<azulejo.Points: 3 in [0.0, 0.0] to [2.0, 1.0], bounded>"
    assert "on a mesh, with interpolated normals, ranks; azulejo.PspReport(radius=0.2, " in repr(all_sets["far mesh"])
    masked = (~mesh().mask).sum()
    assert repr(mesh()) == f"<azulejo.Mesh: 1536 vertices, 3072 triangles, {masked} of them masked, with normals>"
    assert repr(azulejo.thin([[0, 0], [1, 1]], radius=0.5)) == "<azulejo.Selection: 2>"


def test_living_sets_have_a_length():
    plane, growing = azulejo.Plane(0.1), azulejo.Psp(mesh(), 0.2)
    assert len(growing) == 0 and repr(growing) == "<azulejo.Psp: 0 on a mesh>"
    growing.fill()
    for living in (plane, growing):
        before = len(living)
        assert before == len(living.points()) > 50
        erased = living.erase([1, 0] if living is plane else [1, 0, 0], 0.4)
        assert len(living) == before - len(erased) < before
    assert repr(plane) == f"<azulejo.Plane: {len(plane)} in [0.0, 0.0] to [1.0, 1.0], periodic>"
    unit = "[0.0, 0.0] to [1.0, 1.0], periodic"
    assert repr(azulejo.KdrtPlane(radii=[[0.1]])) == f"<azulejo.KdrtPlane: {unit}, of several classes>"
    texts = []
    plane.refill(progress=lambda done: texts.append(repr(plane)))
    assert set(texts) == {"<azulejo.Plane: in use in [0.0, 0.0] to [1.0, 1.0], periodic>"}
    with pytest.raises(RuntimeError, match="in use"):
        plane.refill(progress=lambda done: len(plane))


def test_reports_are_what_their_text_says(all_sets):
    reports = [points.report for points in all_sets.values() if points.report is not None]
    xy = azulejo.kdrt_sample(0.05)
    reports += [azulejo.plane_measure(xy), azulejo.plane_coverage(xy, 0.05)]
    reports.append(azulejo.space_measure(azulejo.volume_sample(0.3)))
    reports.append(azulejo.Spectrum(xy, 16).measure(0.1, 0.5, 0.1))
    reports.append(azulejo.dcr_remesh(mesh(), all_sets["mesh"].triangles, all_sets["mesh"].barycentrics)[1])
    reports.append(azulejo.volume_sample_inside(BOX, 0.2).report)
    reports.append(azulejo.kdrt_merge([(xy, (0, 0), (1, 1))], 0.05).report)
    kinds = {name for name in dir(azulejo) if name.endswith("Report")}
    assert {type(report).__name__ for report in reports} == kinds
    for report in reports:
        again = eval(repr(report), dict(azulejo=azulejo, array=np.array, inf=np.inf, nan=np.nan))
        assert fields(again) == fields(report) and repr(again) == repr(report)
        assert same_reports(pickle.loads(pickle.dumps(report)), report)
        assert same_reports(copy.copy(report), report) and same_reports(copy.deepcopy(report), report)


@pytest.mark.parametrize("origin", [0.0, 4e6])
def test_meshes_are_pickled(origin):
    positions, indices = torus()
    corners = azulejo.Mesh(positions, indices, normals=positions[:7], normal_indices=indices % 7)
    plain = azulejo.Mesh(positions + np.array(origin), indices)
    for made in (mesh(origin), corners, plain):
        again = pickle.loads(pickle.dumps(made))
        for name in "positions local_positions origin indices has_normals normals normal_indices mask area".split():
            assert same(getattr(again, name), getattr(made, name)), name
        assert same_points(azulejo.psp_sample(again, 0.2)[:], azulejo.psp_sample(made, 0.2)[:])
        assert copy.copy(made) is made and copy.deepcopy(made) is made
    assert plain.normals is None and plain.normal_indices is None and plain.mask is None
    assert (corners.normal_indices == indices % 7).all() and (corners.normals == positions[:7]).all()


def test_selections_are_indices():
    cloud = np.random.default_rng(1).random((500, 3), np.float32)
    selection = azulejo.thin(cloud, count=20, order="progressive")
    assert (cloud[selection] == cloud[selection.indices]).all() and list(selection) == selection.indices.tolist()
    assert selection[3] == selection.indices[3] and (selection[:5] == selection.indices[:5]).all()
    for again in (pickle.loads(pickle.dumps(selection)), copy.copy(selection), copy.deepcopy(selection)):
        assert same(again.indices, selection.indices) and same(again.ranks, selection.ranks) and len(again) == 20
    assert pickle.loads(pickle.dumps(azulejo.thin(cloud, radius=0.2))).ranks is None


def test_sets_that_change_are_not_pickled():
    for living in (azulejo.Plane(0.1), azulejo.Psp(mesh(), 0.2), azulejo.KdrtPlane(0.1)):
        for make in (pickle.dumps, copy.copy, copy.deepcopy):
            with pytest.raises(TypeError, match="pickle"):
                make(living)


@pytest.mark.parametrize("method", ["spawn", "forkserver"])
def test_other_processes_get_and_return_them(method):
    if method not in multiprocessing.get_all_start_methods():
        pytest.skip(f"no {method} here")
    with multiprocessing.get_context(method).Pool(1) as pool:
        points = pool.apply(azulejo.psp_sample, (mesh(), 0.2))
    assert same(points.positions, azulejo.psp_sample(mesh(), 0.2).positions)
