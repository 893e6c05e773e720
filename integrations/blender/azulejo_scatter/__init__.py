"""Blue-noise scattering on meshes, by azulejo: points with attributes and instances on them, sampled anew on demand."""

import bpy

from . import operators, panel, parameters

_CLASSES = (*parameters.CLASSES, *operators.CLASSES, *panel.CLASSES)


def register():
    for each in _CLASSES:
        bpy.utils.register_class(each)
    bpy.types.Object.azulejo = bpy.props.PointerProperty(type=parameters.Settings)
    bpy.types.VIEW3D_MT_object.append(panel.menu)


def unregister():
    bpy.types.VIEW3D_MT_object.remove(panel.menu)
    del bpy.types.Object.azulejo
    for each in reversed(_CLASSES):
        bpy.utils.unregister_class(each)
