"""The tab in the sidebar of the 3D viewport, and an entry of the menu Object."""

import bpy

from . import operators


class AZULEJO_UL_classes(bpy.types.UIList):
    def draw_item(self, context, layout, data, item, icon, active_data, active_property, index):
        row = layout.row(align=True)
        row.prop(item, "collection", text="")
        row.prop(item, "factor", text="")


class AZULEJO_PT_scatter(bpy.types.Panel):
    bl_label = "Azulejo Scatter"
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "Azulejo"

    def draw(self, context):
        layout = self.layout
        if not operators.is_result(context.object):
            layout.operator(operators.AZULEJO_OT_scatter.bl_idname)
            layout.operator(operators.AZULEJO_OT_update.bl_idname)
            return
        layout.use_property_split = True
        settings = context.object.azulejo
        layout.prop(settings, "source")
        operators.draw_parameters(layout, settings, settings.source)
        layout.prop(settings, "avoided")
        layout.prop(settings, "clearance")
        row = layout.row()
        row.template_list("AZULEJO_UL_classes", "", settings, "classes", settings, "active_class", rows=3)
        column = row.column(align=True)
        column.operator(operators.AZULEJO_OT_class_add.bl_idname, text="", icon="ADD")
        column.operator(operators.AZULEJO_OT_class_remove.bl_idname, text="", icon="REMOVE")
        layout.operator(operators.AZULEJO_OT_update.bl_idname)


def menu(self, context):
    self.layout.operator(operators.AZULEJO_OT_scatter.bl_idname)


CLASSES = (AZULEJO_UL_classes, AZULEJO_PT_scatter)
