"""Draws hills.png: a terrain with two scatters, trees and bushes on the meadows, stones in two sizes on the slopes.

BLENDER_USER_RESOURCES=DIRECTORY AZULEJO_EXTENSION=ARCHIVE python picture.py TARGET, with the package bpy.
"""

import math
import os
import sys

import bpy
import numpy as np
from mathutils import Vector, noise

SIZE, STEPS = 60.0, 180


def main(target):
    bpy.ops.extensions.package_install_files(
        filepath=os.environ["AZULEJO_EXTENSION"], repo="user_default", enable_on_install=True, overwrite=True
    )
    bpy.data.batch_remove([*bpy.data.objects, *bpy.data.collections])
    terrain = hills()
    for name, objects in {
        "Trees": [tree(0.62, (0.05, 0.16, 0.07)), tree(0.8, (0.09, 0.2, 0.05))],
        "Bushes": [ball("Bush", 0.42, 0.25, (0.22, 0.3, 0.06)), ball("Flowers", 0.36, 0.3, (0.5, 0.16, 0.13))],
        "Rocks": [ball("Rock", 0.75, 0.55, (0.32, 0.3, 0.28))],
        "Stones": [ball("Stone", 0.28, 0.5, (0.42, 0.4, 0.37))],
    }.items():
        collection = bpy.data.collections.new(name)
        for each in objects:
            collection.objects.link(each)
    for density, avoided, radius, align, classes in [
        ("Meadow", "", 0.75, 0.0, {"Trees": 2.2, "Bushes": 1.0}),
        ("Slope", "Hills Scatter", 0.8, 1.0, {"Rocks": 2.5, "Stones": 1.0}),
    ]:
        bpy.context.view_layer.objects.active = terrain
        bpy.ops.azulejo.scatter(
            radius=radius,
            density=density,
            avoided=avoided,
            clearance=1.2,
            align=align,
            scale_min=0.8,
            scale_max=1.25,
            classes=[{"name": name, "factor": factor} for name, factor in classes.items()],
        )
        print(density, len(bpy.context.object.data.vertices), "points")
    render(target)


def height(x, y):
    return 6.5 * noise.fractal(Vector((x / 20.0, y / 20.0, 4.7)), 1.1, 2.1, 3) + 0.003 * y * abs(y)


def hills():
    bpy.ops.mesh.primitive_grid_add(x_subdivisions=STEPS, y_subdivisions=STEPS, size=SIZE)
    terrain = bpy.context.object
    terrain.name = "Hills"
    mesh = terrain.data
    for vertex in mesh.vertices:
        vertex.co.z = height(*vertex.co.xy)
    mesh.shade_smooth()
    mesh.update()
    steep = np.array([1.0 - vertex.normal.z for vertex in mesh.vertices])
    meadow, slope = terrain.vertex_groups.new(name="Meadow"), terrain.vertex_groups.new(name="Slope")
    for index, value in enumerate(np.clip((steep - 0.13) / 0.05, 0.0, 1.0)):
        meadow.add([index], float(1.0 - value), "REPLACE")
        slope.add([index], float(value), "REPLACE")
    terrain.data.materials.append(ground())
    return terrain


def ground():
    """Grass on the meadow, earth on the slope."""
    made = material((0.0, 0.0, 0.0))
    nodes, link = made.node_tree.nodes, made.node_tree.links.new
    weight, mixed = nodes.new("ShaderNodeAttribute"), nodes.new("ShaderNodeMixRGB")
    weight.attribute_name = "Slope"
    mixed.inputs["Color1"].default_value = (0.2, 0.26, 0.08, 1.0)
    mixed.inputs["Color2"].default_value = (0.26, 0.21, 0.15, 1.0)
    link(weight.outputs["Fac"], mixed.inputs["Fac"])
    link(mixed.outputs["Color"], nodes["Principled BSDF"].inputs["Base Color"])
    return made


def material(colour):
    made = bpy.data.materials.new("Plain")
    made.use_nodes = True
    shader = made.node_tree.nodes["Principled BSDF"]
    shader.inputs["Base Color"].default_value = (*colour, 1.0)
    shader.inputs["Roughness"].default_value = 0.9
    return made


def taken(name, colour):
    """The active object, out of the scene."""
    made = bpy.context.object
    made.name = name
    made.data.materials.append(material(colour))
    bpy.context.collection.objects.unlink(made)
    return made


def tree(width, colour):
    bpy.ops.mesh.primitive_cone_add(vertices=14, radius1=width, depth=2.4, location=(0.0, 0.0, 0.0))
    bpy.context.object.data.transform(((1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 1.4), (0, 0, 0, 1)))
    return taken("Tree", colour)


def ball(name, radius, flatness, colour):
    bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=3, radius=radius, location=(0.0, 0.0, 0.0))
    for vertex in bpy.context.object.data.vertices:
        vertex.co *= 1.0 + 0.35 * noise.noise(vertex.co * 2.3 / radius)
        vertex.co.z *= 1.0 - flatness / 2.0
    return taken(name, colour)


def render(target):
    scene = bpy.context.scene
    camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
    scene.collection.objects.link(camera)
    camera.location = (0.0, -36.0, 19.0)
    camera.rotation_euler = (Vector((0.0, -2.0, 0.0)) - camera.location).to_track_quat("-Z", "Y").to_euler()
    camera.data.lens, scene.camera = 36.0, camera
    sun = bpy.data.objects.new("Sun", bpy.data.lights.new("Sun", "SUN"))
    scene.collection.objects.link(sun)
    sun.data.energy, sun.data.angle = 4.0, math.radians(3.0)
    sun.rotation_euler = (math.radians(52.0), 0.0, math.radians(-48.0))
    scene.world = bpy.data.worlds.new("Sky")
    scene.world.use_nodes = True
    scene.world.node_tree.nodes["Background"].inputs["Color"].default_value = (0.6, 0.75, 0.95, 1.0)
    scene.render.engine = "CYCLES"
    scene.cycles.samples, scene.cycles.use_denoising = 32, True
    scene.view_settings.view_transform = "Standard"
    scene.render.resolution_x, scene.render.resolution_y = 640, 400
    scene.render.filepath = target
    bpy.ops.render.render(write_still=True)


main(os.path.abspath(sys.argv[1]))
