"""Scatter, update, and the list of classes of a result."""

import bpy
from bpy.props import CollectionProperty, IntProperty, StringProperty

from . import parameters, result
from .parameters import MOST_CLASSES, AzulejoNamedClass, Parameters

# What azulejo raises for arguments, and for what memory cannot hold; the texts name the argument.
_REFUSED = (ValueError, TypeError, MemoryError)


class AZULEJO_OT_scatter(Parameters, bpy.types.Operator):
    """Scatter points on the active mesh object, and objects on the points"""

    bl_idname = "azulejo.scatter"
    bl_label = "Scatter (Azulejo)"
    bl_options = {"REGISTER", "UNDO"}

    avoided: StringProperty(
        name="Keep Clear of", description="Points keep away from the vertices of this object, which may be another result"
    )
    class_count: IntProperty(
        name="Classes", description="Of points, each with a collection of its own", min=0, max=MOST_CLASSES
    )
    classes: CollectionProperty(type=AzulejoNamedClass)

    @classmethod
    def poll(cls, context):
        return context.object is not None and context.object.type == "MESH"

    def execute(self, context):
        # Rows that are given count, and so do those that the panel asks for.
        if not self.properties.is_property_set("class_count"):
            self.class_count = len(self.classes)
        while len(self.classes) < self.class_count:
            self.classes.add()
        try:
            made = result.make(context, context.object, self.fill_in)
        except _REFUSED as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        self.report({"INFO"}, f"{len(made.data.vertices)} points")
        for other in context.selected_objects:
            other.select_set(False)
        if made.name in context.view_layer.objects:
            made.select_set(True)
            context.view_layer.objects.active = made
        return {"FINISHED"}

    def fill_in(self, settings):
        parameters.copy(self, settings)
        if self.avoided:
            settings.avoided = bpy.data.objects.get(self.avoided)
            if settings.avoided is None or settings.avoided.type != "MESH":
                raise ValueError(f"avoided: there is no mesh object called {self.avoided}")
        for named in list(self.classes)[: self.class_count]:
            added = settings.classes.add()
            added.factor = named.factor
            if named.name:
                added.collection = bpy.data.collections.get(named.name)
                if added.collection is None:
                    raise ValueError(f"classes: there is no collection called {named.name}")

    def draw(self, context):
        layout = self.layout
        layout.use_property_split = True
        draw_parameters(layout, self, context.object.azulejo.source if context.object else None)
        layout.prop_search(self, "avoided", bpy.data, "objects")
        layout.prop(self, "clearance")
        layout.prop(self, "class_count")
        for index, named in enumerate(list(self.classes)[: self.class_count]):
            row = layout.row()
            row.prop_search(named, "name", bpy.data, "collections", text=f"Class {index + 1}")
            row.prop(named, "factor", text="")


class AZULEJO_OT_update(bpy.types.Operator):
    """Sample anew, from the parameters of the active result, or of all results on the active object"""

    bl_idname = "azulejo.update"
    bl_label = "Update Scatter"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        return context.object is not None and bool(results(context))

    def execute(self, context):
        counts = []
        try:
            for each in results(context):
                counts.append(result.fill(context, each))
        except _REFUSED as error:
            self.report({"ERROR"}, str(error))
            # Those that were updated before can be undone.
            return {"FINISHED"} if counts else {"CANCELLED"}
        self.report({"INFO"}, f"{sum(counts)} points")
        return {"FINISHED"}


class AZULEJO_OT_class_add(bpy.types.Operator):
    """Add a class of points"""

    bl_idname = "azulejo.class_add"
    bl_label = "Add Class"
    bl_options = {"INTERNAL", "UNDO"}

    @classmethod
    def poll(cls, context):
        return is_result(context.object) and len(context.object.azulejo.classes) < MOST_CLASSES

    def execute(self, context):
        settings = context.object.azulejo
        settings.classes.add()
        settings.active_class = len(settings.classes) - 1
        return {"FINISHED"}


class AZULEJO_OT_class_remove(bpy.types.Operator):
    """Remove the chosen class of points"""

    bl_idname = "azulejo.class_remove"
    bl_label = "Remove Class"
    bl_options = {"INTERNAL", "UNDO"}

    @classmethod
    def poll(cls, context):
        return is_result(context.object) and len(context.object.azulejo.classes) > 0

    def execute(self, context):
        settings = context.object.azulejo
        settings.classes.remove(settings.active_class)
        settings.active_class = max(0, min(settings.active_class, len(settings.classes) - 1))
        return {"FINISHED"}


def is_result(candidate):
    return candidate is not None and candidate.azulejo.is_result


def results(context):
    """The active object if it is a result, or the results on it, each after that which it keeps clear of."""
    if is_result(context.object):
        return [context.object]
    found = [each for each in context.scene.objects if is_result(each) and each.azulejo.source == context.object]
    return sorted(found, key=_depth)


def _depth(result):
    """How many results, each kept clear of by the one before, come before this one; each counts once."""
    before = []
    while is_result(result) and result not in before:
        before.append(result)
        result = result.azulejo.avoided
    return len(before)


def draw_parameters(layout, settings, source):
    layout.prop(settings, "amount", expand=True)
    layout.prop(settings, "radius" if settings.amount == "RADIUS" else "count")
    if source is None:
        layout.prop(settings, "density")
    else:
        layout.prop_search(settings, "density", source, "vertex_groups")
    layout.prop(settings, "between")
    layout.prop(settings, "order")
    layout.prop(settings, "viewport")
    layout.prop(settings, "seed")
    layout.prop(settings, "align")
    layout.prop(settings, "turn")
    row = layout.row(align=True)
    row.prop(settings, "scale_min")
    row.prop(settings, "scale_max")


CLASSES = (AZULEJO_OT_scatter, AZULEJO_OT_update, AZULEJO_OT_class_add, AZULEJO_OT_class_remove)
