"""The group of geometry nodes that puts objects of a collection on the points of one class."""

import bpy

NAME = "Azulejo Instances"


def group():
    """The group, made if the file has none."""
    return bpy.data.node_groups.get(NAME) or _made()


def identifiers(tree):
    """The keys of a modifier's inputs, by their names."""
    return {item.name: item.identifier for item in tree.interface.items_tree if item.in_out == "INPUT"}


def _made():
    tree = bpy.data.node_groups.new(NAME, "GeometryNodeTree")
    tree.is_modifier = True
    inputs = {
        name: tree.interface.new_socket(name, in_out="INPUT", socket_type=f"NodeSocket{kind}")
        for name, kind in [("Geometry", "Geometry"), ("Collection", "Collection"), ("Class", "Int"), ("In Viewport", "Float")]
    }
    tree.interface.new_socket("Geometry", in_out="OUTPUT", socket_type="NodeSocketGeometry")
    share = inputs["In Viewport"]
    share.default_value, share.min_value, share.max_value, share.subtype = 1.0, 0.0, 1.0, "FACTOR"

    column = 0

    def node(kind, **properties):
        nonlocal column
        made = tree.nodes.new(kind)
        made.location = (200 * column, 0)
        column += 1
        for name, value in properties.items():
            setattr(made, name, value)
        return made

    def attribute(name, kind):
        made = node("GeometryNodeInputNamedAttribute", data_type=kind)
        made.inputs["Name"].default_value = name
        return made.outputs["Attribute"]

    link = tree.links.new
    given = node("NodeGroupInput").outputs

    # Of the class, and below the share: in renders all.
    same = node("FunctionNodeCompare", data_type="INT", operation="EQUAL")
    link(attribute("class", "INT"), _input(same, "A_INT"))
    link(given["Class"], _input(same, "B_INT"))
    shown = node("GeometryNodeSwitch", input_type="FLOAT")
    link(node("GeometryNodeIsViewport").outputs["Is Viewport"], shown.inputs["Switch"])
    shown.inputs["False"].default_value = 1.0
    link(given["In Viewport"], shown.inputs["True"])
    below = node("FunctionNodeCompare", data_type="FLOAT", operation="LESS_THAN")
    link(attribute("share", "FLOAT"), _input(below, "A"))
    link(shown.outputs["Output"], _input(below, "B"))
    both = node("FunctionNodeBooleanMath", operation="AND")
    link(same.outputs["Result"], both.inputs[0])
    link(below.outputs["Result"], both.inputs[1])

    # What modifiers before this one have put on other classes passes by: nothing is put on instances.
    parts = node("GeometryNodeSeparateComponents")
    link(given["Geometry"], parts.inputs["Geometry"])
    collection = node("GeometryNodeCollectionInfo")
    link(given["Collection"], collection.inputs["Collection"])
    collection.inputs["Separate Children"].default_value = True
    collection.inputs["Reset Children"].default_value = True
    put = node("GeometryNodeInstanceOnPoints")
    link(parts.outputs["Mesh"], put.inputs["Points"])
    link(both.outputs["Boolean"], put.inputs["Selection"])
    link(collection.outputs["Instances"], put.inputs["Instance"])
    put.inputs["Pick Instance"].default_value = True
    link(attribute("pick", "INT"), put.inputs["Instance Index"])
    link(attribute("rotation", "QUATERNION"), put.inputs["Rotation"])
    link(attribute("scale", "FLOAT"), put.inputs["Scale"])

    joined = node("GeometryNodeJoinGeometry")
    for geometry in (parts.outputs["Mesh"], parts.outputs["Instances"], put.outputs["Instances"]):
        link(geometry, joined.inputs["Geometry"])
    link(joined.outputs["Geometry"], node("NodeGroupOutput").inputs["Geometry"])
    return tree


def _input(node, identifier):
    return next(socket for socket in node.inputs if socket.identifier == identifier)
