"""What a scatter is made from: properties of the operator, and of the object that it makes.

An operator cannot point to objects, so it names collections; the result points to them, and renaming does no harm.
"""

import bpy
from bpy.props import (
    BoolProperty,
    CollectionProperty,
    EnumProperty,
    FloatProperty,
    IntProperty,
    PointerProperty,
    StringProperty,
)

# Of azulejo.
MOST_CLASSES = 16


class Parameters:
    """The properties that the operator and its result share."""

    amount: EnumProperty(
        name="By",
        items=[
            ("RADIUS", "Radius", "As many points as fit: no two nearer than the radius, no place farther from all of them"),
            ("COUNT", "Count", "Exactly this many points, as far apart as can be"),
        ],
    )
    radius: FloatProperty(
        name="Radius",
        description="The smallest distance of two points, straight through space, in units of the world",
        default=0.2,
        min=0.0,
        unit="LENGTH",
        precision=4,
    )
    count: IntProperty(name="Count", description="The number of points", default=500, min=1)
    density: StringProperty(
        name="Density",
        description="A vertex group, or an attribute of the vertices: 1 where points are a radius apart, 0 where there are none",
    )
    between: EnumProperty(
        name="Classes",
        items=[
            ("APART", "Apart", "Points of two classes are the mean of their radii apart: disks of the classes do not overlap"),
            ("TOGETHER", "Together", "All classes together are blue noise as well, with points of two classes nearer"),
        ],
    )
    clearance: FloatProperty(
        name="Clearance",
        description="How far points are at least from the vertices of the object that they keep clear of",
        default=0.2,
        min=0.0,
        unit="LENGTH",
        precision=4,
    )
    order: EnumProperty(
        name="Order",
        items=[
            ("PROGRESSIVE", "Coarse to Fine", "Any first part of the points is well spread, and each has a rank"),
            ("ANY", "Any", "Faster; the viewport shows random points where it does not show all"),
        ],
    )
    viewport: FloatProperty(
        name="In Viewport",
        description="The share of the points that get instances in the viewport; renders have all",
        default=1.0,
        min=0.0,
        max=1.0,
        subtype="FACTOR",
    )
    seed: IntProperty(name="Seed", description="Another seed makes another set", min=0)
    align: FloatProperty(
        name="Align to Normal",
        description="0: upright, 1: along the normal",
        default=1.0,
        min=0.0,
        max=1.0,
        subtype="FACTOR",
    )
    turn: FloatProperty(
        name="Random Turn",
        description="About the own axis: 0: none, 1: all directions",
        default=1.0,
        min=0.0,
        max=1.0,
        subtype="FACTOR",
    )
    scale_min: FloatProperty(name="Scale from", default=1.0, min=0.0)
    scale_max: FloatProperty(name="to", default=1.0, min=0.0)


NAMES = tuple(Parameters.__annotations__)


def factor():
    return FloatProperty(
        name="Factor", description="The radius of the class, in radii of the whole", default=1.0, min=0.0, precision=3
    )


class AzulejoNamedClass(bpy.types.PropertyGroup):
    """A class of points of the operator; `name` is that of its collection."""

    factor: factor()


class AzulejoClass(bpy.types.PropertyGroup):
    """A class of points of a result."""

    collection: PointerProperty(
        name="Collection",
        description="Each point gets one of its objects, by chance; without a collection there are points alone",
        type=bpy.types.Collection,
    )
    factor: factor()


class Settings(Parameters, bpy.types.PropertyGroup):
    """What a result was made from."""

    is_result: BoolProperty()
    source: PointerProperty(name="Surface", type=bpy.types.Object, poll=lambda _, other: other.type == "MESH")
    avoided: PointerProperty(
        name="Keep Clear of",
        description="Points keep away from the vertices of this object, which may be another result",
        type=bpy.types.Object,
        poll=lambda _, other: other.type == "MESH",
    )
    classes: CollectionProperty(type=AzulejoClass)
    active_class: IntProperty()


def copy(source, target):
    """Copies the shared properties."""
    for name in NAMES:
        setattr(target, name, getattr(source, name))


CLASSES = (AzulejoNamedClass, AzulejoClass, Settings)
