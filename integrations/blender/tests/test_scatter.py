"""Points: their distances in the world, counts, densities, classes, order, and refusals."""

import bpy
import numpy as np
import pytest
import seen


def scatter(source, **options):
    bpy.context.view_layer.objects.active = source
    assert bpy.ops.azulejo.scatter(**options) == {"FINISHED"}
    return bpy.context.object


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("order", ["ANY", "PROGRESSIVE"])
def test_radii_hold_in_the_world(cube, seed, order):
    result = scatter(cube, radius=0.4, seed=seed, order=order)
    radius, points = result.azulejo.radius, seen.in_world(result)
    assert len(points) > 100
    assert seen.smallest_distances(points).min() >= radius
    assert seen.farthest(seen.probes(cube, 3000), points) <= radius * 1.0001
    # On the surface of the cube, in its own frame.
    inverse = np.linalg.inv(seen.matrix(cube))
    own = points @ inverse[:3, :3].T + inverse[:3, 3]
    assert np.abs(np.abs(own).max(axis=1) - 1.0).max() < 1e-4


def test_a_mirrored_object_has_its_normals_outside(cube):
    cube.scale.x = -3.0
    bpy.context.view_layer.update()
    result = scatter(cube, radius=0.4)
    outward = seen.in_world(result) - seen.matrix(cube)[:3, 3]
    normals = seen.attribute(result, "normal")
    assert (np.einsum("px,px->p", outward, normals) > 0.0).all()
    assert np.abs(np.linalg.norm(normals, axis=1) - 1.0).max() < 1e-5


def test_normals_are_those_of_the_shading():
    bpy.ops.mesh.primitive_uv_sphere_add(segments=12, ring_count=8)
    sphere = bpy.context.object
    flat = seen.attribute(scatter(sphere, radius=0.1), "normal")
    sphere.data.shade_smooth()
    result = scatter(sphere, radius=0.1)
    normals, places = seen.attribute(result, "normal"), seen.in_world(result)
    places /= np.linalg.norm(places, axis=1, keepdims=True)
    assert len(np.unique(flat.round(4), axis=0)) == 12 * 8
    assert len(np.unique(normals.round(4), axis=0)) > 12 * 8 * 2
    assert np.einsum("px,px->p", places, normals).min() > 0.97


def test_normals_are_those_of_the_world():
    bpy.ops.mesh.primitive_uv_sphere_add(segments=96, ring_count=64)
    ellipsoid = bpy.context.object
    ellipsoid.scale, ellipsoid.rotation_euler = (3.0, 1.0, 0.5), (0.5, 0.2, 1.0)
    ellipsoid.data.shade_smooth()
    bpy.context.view_layer.update()
    result = scatter(ellipsoid, radius=0.2)
    inverse = np.linalg.inv(seen.matrix(ellipsoid)[:3, :3])
    # The gradient of the function that is 1 on the ellipsoid.
    expected = seen.in_world(result) @ inverse.T @ inverse
    expected /= np.linalg.norm(expected, axis=1, keepdims=True)
    assert np.einsum("px,px->p", expected, seen.attribute(result, "normal")).min() > 0.995


@pytest.mark.parametrize("weighted", [False, True])
@pytest.mark.parametrize("order", ["ANY", "PROGRESSIVE"])
def test_counts_are_exact(cube, weighted, order):
    if weighted:
        cube.vertex_groups.new(name="Weights").add([0, 1, 2, 3], 0.5, "REPLACE")
    for count in (1, 7, 500):
        result = scatter(cube, amount="COUNT", count=count, order=order, density="Weights" if weighted else "")
        assert len(result.data.vertices) == count


def grid_with_weights(weigh):
    bpy.ops.mesh.primitive_grid_add(x_subdivisions=40, y_subdivisions=40, size=10.0)
    grid = bpy.context.object
    group = grid.vertex_groups.new(name="Weights")
    for vertex in grid.data.vertices:
        weight = weigh(vertex.co.x)
        if weight is not None:
            group.add([vertex.index], weight, "REPLACE")
    return grid


def test_density_follows_the_weights():
    grid = grid_with_weights(lambda x: 1.0 if x > 0.1 else 0.25)
    result = scatter(grid, radius=0.12, density="Weights")
    x = seen.in_world(result)[:, 0]
    assert 3.6 < (x > 1.0).sum() / (x < -1.0).sum() < 4.4
    right = seen.in_world(result)[x > 1.0]
    assert seen.smallest_distances(right).min() >= result.azulejo.radius * (1.0 - 1e-6)
    assert (seen.in_world(scatter(grid, radius=0.12))[:, 0] < -1.0).sum() > 3.6 * (x < -1.0).sum()


def test_no_points_stand_where_there_is_no_weight():
    grid = grid_with_weights(lambda x: 1.0 if x > 0.1 else None)
    x = seen.in_world(scatter(grid, amount="COUNT", count=400, density="Weights"))[:, 0]
    # The weights of the column of vertices below 0.1 are 0, and so are those of all triangles left of it.
    edge = max(vertex.co.x for vertex in grid.data.vertices if vertex.co.x <= 0.1)
    assert x.min() >= edge - 1e-5 and x.max() > 4.5


def test_density_may_be_an_attribute_of_the_vertices(cube):
    values = cube.data.attributes.new("moisture", "FLOAT", "POINT")
    values.data.foreach_set("value", [1.0] * 4 + [0.2] * 4)
    cube.vertex_groups.new(name="Weights").add([0, 1, 2, 3], 1.0, "REPLACE")
    cube.vertex_groups["Weights"].add([4, 5, 6, 7], 0.2, "REPLACE")
    attributed = seen.in_world(scatter(cube, radius=0.3, density="moisture"))
    assert (attributed == seen.in_world(scatter(cube, radius=0.3, density="Weights"))).all()


@pytest.mark.parametrize("density", ["", "Weights"])
@pytest.mark.parametrize("order", ["ANY", "PROGRESSIVE"])
@pytest.mark.parametrize("between", ["APART", "TOGETHER"])
def test_classes_keep_their_radii(cube, collection, density, order, between):
    cube.vertex_groups.new(name="Weights").add(range(8), 1.0, "REPLACE")
    for name in ("Trees", "Bushes", "Stones"):
        collection(name, 1)
    factors = (4.0, 2.0, 1.0)
    rows = [{"name": name, "factor": factor} for name, factor in zip(("Trees", "Bushes", "Stones"), factors)]
    result = scatter(cube, radius=0.15, classes=rows, density=density, order=order, between=between)
    points, classes, radius = seen.in_world(result), seen.attribute(result, "class"), result.azulejo.radius
    assert (np.diff(classes) >= 0).all()
    counts = np.bincount(classes, minlength=3)
    assert (counts > 20).all() and counts[2] > 1.5 * counts[0]
    # Local radii of a density are doubles from floats.
    slack = 1.0 - 1e-6 if density else 1.0
    for one in range(3):
        assert seen.smallest_distances(points[classes == one]).min() >= factors[one] * radius * slack
        for other in range(one):
            mean = (factors[one] + factors[other]) / 2.0
            gap = seen.gap(points[classes == one], points[classes == other])
            assert (gap >= mean * radius * slack) == (between == "APART")
    assert seen.smallest_distances(points).min() >= radius * slack * (1.0 if between == "APART" else 0.8)


@pytest.mark.parametrize(
    "options",
    [
        {"radius": 0.2},
        {"radius": 0.2, "order": "ANY"},
        {"amount": "COUNT", "count": 300},
        {"radius": 0.2, "density": "Weights"},
        {"radius": 0.2, "classes": [{"name": "", "factor": 2.0}, {"name": "", "factor": 1.0}]},
    ],
)
def test_points_keep_clear_of_another_result(cube, options):
    cube.vertex_groups.new(name="Weights").add(range(8), 1.0, "REPLACE")
    trees = seen.in_world(scatter(cube, radius=2.0))
    result = scatter(cube, avoided="Cube Scatter", clearance=0.7, **options)
    points = seen.in_world(result)
    assert seen.gap(points, trees) >= 0.7 * (1.0 - 1e-6)
    if options == {"radius": 0.2}:
        for place in seen.probes(cube, 2000):
            assert seen.gap([place], points) <= 0.20002 or seen.gap([place], trees) <= 0.70002
    if "count" in options:
        assert len(points) == 300


def test_every_first_part_is_as_far_apart_as_its_rank(cube):
    result = scatter(cube, radius=0.25, order="PROGRESSIVE")
    points, ranks = seen.in_world(result), seen.attribute(result, "rank")
    assert ranks.min() >= result.azulejo.radius and ranks[2] > 4.0 * ranks[-1] and (np.diff(ranks) <= 0.0).all()
    assert (np.minimum.accumulate(seen.smallest_distances(points)) >= ranks)[1:].all()
    shares = seen.attribute(result, "share")
    assert (shares == (np.arange(len(points)) / len(points)).astype(np.float32)).all()


def test_seeds_make_sets_and_the_same_seed_the_same(cube):
    first = scatter(cube, radius=0.4, seed=3)
    again, other = scatter(cube, radius=0.4, seed=3), scatter(cube, radius=0.4, seed=4)
    for name in ("position", "rotation", "scale", "pick"):
        values = seen.attribute(first, name)
        assert (values == seen.attribute(again, name)).all()
        assert values.shape != seen.attribute(other, name).shape or (values != seen.attribute(other, name)).any()


def test_attributes_are_of_the_points(cube):
    result = scatter(cube, radius=0.4)
    count = len(result.data.vertices)
    assert (seen.attribute(result, "id") == np.arange(count)).all()
    for name in ("class", "rank", "share", "scale", "pick", "normal", "rotation"):
        assert len(seen.attribute(result, name)) == count
        assert result.data.attributes[name].domain == "POINT"


def test_modifiers_of_the_surface_count(cube):
    cube.modifiers.new("Array", "ARRAY").relative_offset_displace = (2.0, 0.0, 0.0)
    twice = seen.in_world(scatter(cube, radius=0.4))
    cube.modifiers.clear()
    once = seen.in_world(scatter(cube, radius=0.4))
    assert len(twice) > 1.8 * len(once)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"radius": 0.0}, "radius: 0"),
        ({"density": "Nowhere"}, "density: .* has no vertex group .* called Nowhere"),
        ({"density": "Empty"}, "density"),
        ({"radius": 1e-6}, "radius: 9.99.* asks for about .* samples; the limit is"),
        ({"radius": 1e6}, "radius: 1000000.0 is more than the diagonal of the mesh"),
        ({"avoided": "Nothing"}, "avoided: there is no mesh object called Nothing"),
        ({"scale_min": 2.0}, "scale_min: 2 is above scale_max, 1"),
        ({"classes": [{"name": "Nowhere", "factor": 1.0}]}, "classes: there is no collection called Nowhere"),
        ({"classes": [{"name": "", "factor": 0.0}]}, "radius: "),
        ({"class_count": 2, "amount": "COUNT"}, "count: 2 classes are sampled by a radius"),
    ],
)
def test_bad_input_is_refused_by_name_and_leaves_nothing(cube, options, message):
    cube.vertex_groups.new(name="Empty")
    before = {name: len(getattr(bpy.data, name)) for name in ("objects", "meshes", "node_groups", "collections")}
    with pytest.raises(RuntimeError, match=f"Error: {message}"):
        scatter(cube, **options)
    assert before == {name: len(getattr(bpy.data, name)) for name in before}


def test_a_mesh_without_faces_is_refused():
    mesh = bpy.data.meshes.new("Lines")
    mesh.from_pydata([(0, 0, 0), (1, 0, 0)], [(0, 1)], [])
    lines = bpy.data.objects.new("Lines", mesh)
    bpy.context.collection.objects.link(lines)
    with pytest.raises(RuntimeError, match="Error: indices: "):
        scatter(lines)
