"""The surface of an object as it is seen: with its modifiers, in the world, in doubles."""

from dataclasses import dataclass
from typing import Optional

import numpy as np


@dataclass
class Surface:
    """Vertices and normals are turned and scaled as in the world, relative to the origin."""

    origin: np.ndarray
    vertices: np.ndarray
    triangles: np.ndarray
    normals: np.ndarray
    normal_indices: np.ndarray
    density: Optional[np.ndarray]
    avoided: Optional[np.ndarray]


def read(source, density, avoided, depsgraph):
    """The surface of an object, with the named density unless the name is empty, and the vertices of another object."""
    if source.mode == "EDIT":
        source.update_from_editmode()
        depsgraph.update()
    evaluated = _evaluated("source", source, depsgraph)
    mesh = evaluated.to_mesh(preserve_all_data_layers=True, depsgraph=depsgraph)
    try:
        mesh.calc_loop_triangles()
        matrix = np.array(evaluated.matrix_world, np.float64)
        linear = matrix[:3, :3]
        side = -1.0 if np.linalg.det(linear) < 0.0 else 1.0
        triangles = _entries(mesh.loop_triangles, "vertices", 3, np.int32)
        corners = _entries(mesh.loop_triangles, "loops", 3, np.int32)
        if side < 0.0:
            triangles, corners = triangles[:, ::-1], corners[:, ::-1]
        return Surface(
            origin=matrix[:3, 3],
            vertices=_entries(mesh.vertices, "co", 3, np.float32).astype(np.float64) @ linear.T,
            triangles=np.ascontiguousarray(triangles),
            normals=_unit(_entries(mesh.corner_normals, "vector", 3, np.float32) @ (side * _cofactors(linear)).T),
            normal_indices=np.ascontiguousarray(corners),
            density=_density(evaluated, mesh, density) if density else None,
            avoided=_vertices(_evaluated("avoided", avoided, depsgraph), matrix[:3, 3]) if avoided else None,
        )
    finally:
        evaluated.to_mesh_clear()


def _evaluated(name, wanted, depsgraph):
    # What a pointer alone leads to is in the graph as well, but stays as it was.
    if wanted.hide_viewport or not _has(depsgraph.view_layer.layer_collection, wanted):
        raise ValueError(f"{name}: {wanted.name} is disabled in the viewport, or not in the view layer")
    return wanted.evaluated_get(depsgraph)


def _has(layer, wanted):
    if layer.collection.hide_viewport:
        return False
    own = not layer.exclude and layer.collection.objects.get(wanted.name) == wanted
    return own or any(_has(child, wanted) for child in layer.children)


def _vertices(avoided, origin):
    """Those that the object itself has: instances and other modifiers do not count."""
    matrix = np.array(avoided.matrix_world, np.float64)
    return _entries(avoided.original.data.vertices, "co", 3, np.float32) @ matrix[:3, :3].T + (matrix[:3, 3] - origin)


def _entries(elements, name, width, kind):
    values = np.empty(len(elements) * width, kind)
    elements.foreach_get(name, values)
    return values.reshape(-1, width)


def _cofactors(linear):
    """The matrix that turns normals as `linear` turns the surface; the transposed inverse but for its scale, and defined
    where that is not."""
    rows = linear
    return np.array([np.cross(rows[1], rows[2]), np.cross(rows[2], rows[0]), np.cross(rows[0], rows[1])])


def _unit(vectors):
    lengths = np.linalg.norm(vectors, axis=1, keepdims=True)
    return vectors / np.where(lengths > 0.0, lengths, 1.0)


def _density(evaluated, mesh, name):
    group = evaluated.vertex_groups.get(name)
    if group is not None:
        weights = np.zeros(len(mesh.vertices), np.float32)
        for vertex in mesh.vertices:
            for element in vertex.groups:
                if element.group == group.index:
                    weights[vertex.index] = element.weight
        return weights
    attribute = mesh.attributes.get(name)
    if attribute is None or attribute.domain != "POINT" or attribute.data_type != "FLOAT":
        raise ValueError(f"density: {evaluated.name} has no vertex group or number of its vertices called {name}")
    return _entries(attribute.data, "value", 1, np.float32)[:, 0]
