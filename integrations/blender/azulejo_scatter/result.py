"""The object that a scatter makes: vertices with attributes, and a modifier for each class that has a collection."""

import bpy
import numpy as np
from mathutils import Matrix

from . import nodes, samples, surface

_PREFIX = "Azulejo Class "


def make(context, source, settings):
    """A new result on the source. `settings` fills in its settings; nothing is left of it if that or the sampling fails."""
    mesh = bpy.data.meshes.new(f"{source.name} Scatter")
    result = bpy.data.objects.new(mesh.name, mesh)
    try:
        settings(result.azulejo)
        result.azulejo.is_result = True
        result.azulejo.source = source
        home = _home(context, source, result.azulejo.classes)
        fill(context, result)
        home.objects.link(result)
    except BaseException:
        bpy.data.meshes.remove(mesh)
        raise
    return result


def fill(context, result):
    """Samples the source of a result anew; the result stays as it was if that fails."""
    settings = result.azulejo
    if settings.source is None:
        raise ValueError(f"source: the object that {result.name} was scattered on is gone")
    if result.mode == "EDIT":
        raise ValueError(f"result: {result.name} is in edit mode")
    if settings.avoided == result:
        raise ValueError(f"avoided: {result.name} cannot keep clear of itself")
    for each in settings.classes:
        if each.collection and result.name in each.collection.all_objects:
            raise ValueError(f"classes: the collection {each.collection.name} holds {result.name} itself")
    manager = context.window_manager
    manager.progress_begin(0.0, 1.0)
    try:
        depsgraph = context.evaluated_depsgraph_get()
        seen = surface.read(settings.source, settings.density, settings.avoided, depsgraph)
        factors = [each.factor for each in settings.classes] or [1.0]
        scattered = samples.sample(seen, settings, factors, manager.progress_update)
    finally:
        manager.progress_end()
    _write(result, scattered)
    _instance(result)
    return len(scattered.positions)


def _home(context, source, classes):
    """A collection for the result that no class puts on it."""
    taken = set()
    for each in classes:
        if each.collection:
            taken |= {each.collection, *each.collection.children_recursive}
    # No class can have the collection of the scene itself.
    places = (*source.users_collection, context.collection, context.scene.collection)
    return next(place for place in places if place not in taken)


def _write(result, scattered):
    mesh = result.data
    mesh.clear_geometry()
    mesh.vertices.add(len(scattered.positions))
    mesh.vertices.foreach_set("co", scattered.positions.ravel())
    ids = np.arange(len(scattered.positions), dtype=np.int32)
    for name, kind, field, values in [
        ("id", "INT", "value", ids),
        ("class", "INT", "value", scattered.classes),
        ("rank", "FLOAT", "value", scattered.ranks),
        ("share", "FLOAT", "value", scattered.shares),
        ("normal", "FLOAT_VECTOR", "vector", scattered.normals),
        ("rotation", "QUATERNION", "value", scattered.rotations),
        ("scale", "FLOAT", "value", scattered.scales),
        ("pick", "INT", "value", scattered.picks),
    ]:
        mesh.attributes.new(name, kind, "POINT").data.foreach_set(field, np.ascontiguousarray(values).ravel())
    mesh.update()
    # Radii hold in the world because the object is neither turned nor scaled, not even by a parent.
    if result.parent:
        result.matrix_parent_inverse = result.parent.matrix_world.inverted_safe()
    result.matrix_basis = Matrix.Translation(scattered.origin)


def _instance(result):
    settings = result.azulejo
    wanted = {f"{_PREFIX}{index + 1}": index for index, each in enumerate(settings.classes) if each.collection}
    for modifier in list(result.modifiers):
        if modifier.name.startswith(_PREFIX) and modifier.name not in wanted:
            result.modifiers.remove(modifier)
    for name, index in wanted.items():
        modifier = result.modifiers.get(name) or result.modifiers.new(name, "NODES")
        modifier.node_group = nodes.group()
        keys = nodes.identifiers(modifier.node_group)
        modifier[keys["Collection"]] = settings.classes[index].collection
        modifier[keys["Class"]] = index
        modifier[keys["In Viewport"]] = settings.viewport
    result.update_tag()
