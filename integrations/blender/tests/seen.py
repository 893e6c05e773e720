"""What is seen of a result: its attributes, places in the world, distances, and instances."""

import bpy
import numpy as np


def attribute(result, name):
    data = result.data.attributes[name].data
    field = {"FLOAT_VECTOR": ("vector", 3), "QUATERNION": ("value", 4)}.get(
        result.data.attributes[name].data_type, ("value", 1)
    )
    values = np.empty(len(data) * field[1], np.int32 if result.data.attributes[name].data_type == "INT" else np.float32)
    data.foreach_get(field[0], values)
    return values.reshape(-1, field[1]) if field[1] > 1 else values


def matrix(seen):
    return np.array(seen.matrix_world, np.float64)


def in_world(seen):
    """The vertices of any mesh object, in doubles."""
    values = np.empty(len(seen.data.vertices) * 3, np.float32)
    seen.data.vertices.foreach_get("co", values)
    return values.reshape(-1, 3).astype(np.float64) @ matrix(seen)[:3, :3].T + matrix(seen)[:3, 3]


def smallest_distances(points):
    """Of each point to those before it, in doubles; infinite for the first."""
    smallest = np.full(len(points), np.inf)
    for index in range(1, len(points)):
        smallest[index] = np.sqrt(((points[:index] - points[index]) ** 2).sum(axis=1).min())
    return smallest


def gap(points, others):
    """The smallest distance of a point of one set to one of the other."""
    return min(np.sqrt(((others - point) ** 2).sum(axis=1).min()) for point in points)


def probes(seen, count, seed=0):
    """Random places on the triangles of an object, in the world."""
    seen.data.calc_loop_triangles()
    corners = in_world(seen)[np.array([triangle.vertices[:] for triangle in seen.data.loop_triangles])]
    areas = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
    random = np.random.default_rng(seed)
    chosen = corners[random.choice(len(areas), count, p=areas / areas.sum())]
    weights = random.dirichlet((1.0, 1.0, 1.0), count)
    return np.einsum("pc,pcx->px", weights, chosen)


def farthest(places, points):
    return max(np.sqrt(((points - place) ** 2).sum(axis=1).min()) for place in places)


def instances(result, depsgraph=None):
    """Of the result: (name of the object, its matrix) each."""
    depsgraph = depsgraph or bpy.context.evaluated_depsgraph_get()
    return [
        (each.instance_object.name, np.array(each.matrix_world, np.float64))
        for each in depsgraph.object_instances
        if each.is_instance and each.parent.original == result
    ]
