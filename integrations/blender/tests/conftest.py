"""Blender without a window, with the extension installed from its archive, and an empty file for each test."""

import os
from pathlib import Path

import pytest

ARCHIVE = Path(os.environ["AZULEJO_EXTENSION"])
HOME = Path(os.environ["BLENDER_USER_RESOURCES"])

import bpy  # noqa: E402: it reads the environment

REPOSITORY = "user_default"
MODULE = f"bl_ext.{REPOSITORY}.azulejo_scatter"


@pytest.fixture(scope="session", autouse=True)
def installed():
    done = bpy.ops.extensions.package_install_files(
        filepath=str(ARCHIVE), repo=REPOSITORY, enable_on_install=True, overwrite=True
    )
    assert done == {"FINISHED"} and MODULE in bpy.context.preferences.addons


@pytest.fixture(autouse=True)
def empty(installed):
    bpy.data.batch_remove([*bpy.data.objects, *bpy.data.meshes, *bpy.data.collections, *bpy.data.node_groups])
    bpy.context.view_layer.update()


@pytest.fixture
def cube():
    """A cube from -1 to 1 that is turned, moved and scaled unequally."""
    bpy.ops.mesh.primitive_cube_add()
    made = bpy.context.object
    made.scale, made.rotation_euler, made.location = (3.0, 1.0, 0.5), (0.3, -0.7, 1.1), (100.0, -20.0, 7.0)
    bpy.context.view_layer.update()
    return made


@pytest.fixture
def collection():
    """Makes collections of small meshes at the origin: collection("Trees", 2)."""

    def make(name, objects):
        made = bpy.data.collections.new(name)
        for index in range(objects):
            mesh = bpy.data.meshes.new(f"{name}{index}")
            mesh.from_pydata([(0, 0, 0), (0.1, 0, 0), (0, 0, 0.3)], [], [(0, 1, 2)])
            made.objects.link(bpy.data.objects.new(mesh.name, mesh))
        return made

    return make
