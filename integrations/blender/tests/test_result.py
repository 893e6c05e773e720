"""The object that a scatter makes: instances, updates, undo, and what is left when the extension is disabled."""

from types import SimpleNamespace

import bpy
import conftest
import numpy as np
import pytest
import seen
from test_scatter import scatter


def of_class(result, each):
    return seen.in_world(result)[seen.attribute(result, "class") == each]


def same_places(matrices, places, radius):
    """As many, and each within a thousandth of the radius of its own place."""
    assert len(matrices) == len(places)
    found = np.array([np.sqrt(((places - matrix[:3, 3]) ** 2).sum(axis=1)).argmin() for matrix in matrices])
    assert len(set(found)) == len(places)
    assert max(np.linalg.norm(places[i] - m[:3, 3]) for i, m in zip(found, matrices)) < 1e-3 * radius
    return found


@pytest.fixture
def forest(cube, collection):
    collection("Trees", 2)
    collection("Stones", 3)
    return scatter(
        cube,
        radius=0.3,
        classes=[{"name": "Trees", "factor": 2.0}, {"name": "Stones", "factor": 1.0}],
        scale_min=0.5,
        scale_max=1.5,
    )


def test_each_class_gets_the_objects_of_its_collection(forest):
    put = seen.instances(forest)
    for each, name, objects in ((0, "Trees", 2), (1, "Stones", 3)):
        own = [(other, matrix) for other, matrix in put if other.startswith(name)]
        assert len({other for other, _ in own}) == objects
        same_places([matrix for _, matrix in own], of_class(forest, each), 0.3)
    assert len(put) == len(forest.data.vertices)


def test_nothing_is_put_on_the_vertices_of_the_objects(forest):
    for each in bpy.data.collections["Trees"].objects:
        each.data.attributes.new("class", "INT", "POINT").data.foreach_set("value", [1] * len(each.data.vertices))
    assert len(seen.instances(forest)) == len(forest.data.vertices)


def test_objects_stand_on_the_normals_and_are_scaled(forest):
    points, normals = seen.in_world(forest), seen.attribute(forest, "normal")
    scales = seen.attribute(forest, "scale")
    matrices = [matrix for _, matrix in seen.instances(forest)]
    found = same_places(matrices, points, 0.3)
    for index, matrix in zip(found, matrices):
        columns = np.linalg.norm(matrix[:3, :3], axis=0)
        assert np.allclose(columns, scales[index], rtol=1e-4)
        assert np.allclose(matrix[:3, 2] / columns[2], normals[index], atol=1e-4)
    assert 0.5 <= scales.min() < 0.6 and 1.4 < scales.max() <= 1.5
    # Turned about the normals in all directions: the turns of the objects on one face of the cube.
    face = [matrix for index, matrix in zip(found, matrices) if np.allclose(normals[index], normals[0], atol=1e-3)]
    turned = np.array([matrix[:3, 0] / np.linalg.norm(matrix[:3, 0]) for matrix in face])
    assert len(turned) > 20 and np.linalg.norm(turned.mean(axis=0)) < 0.4


def test_objects_can_stand_upright_and_unturned(cube, collection):
    collection("Trees", 1)
    result = scatter(cube, radius=0.5, classes=[{"name": "Trees", "factor": 1.0}], align=0.0, turn=0.0)
    matrices = [matrix for _, matrix in seen.instances(result)]
    assert len(matrices) == len(result.data.vertices)
    assert all(np.allclose(matrix[:3, :3], np.eye(3), atol=1e-5) for matrix in matrices)


class Counting(bpy.types.RenderEngine):
    bl_idname = "AZULEJO_COUNTING"
    bl_label = "Counting"
    counted = None

    def render(self, depsgraph):
        type(self).counted = sum(each.is_instance for each in depsgraph.object_instances)


@pytest.mark.parametrize("order", ["ANY", "PROGRESSIVE"])
def test_the_viewport_has_a_share_and_renders_have_all(cube, collection, order, tmp_path):
    collection("Trees", 1)
    collection("Stones", 1)
    rows = [{"name": "Trees", "factor": 2.0}, {"name": "Stones", "factor": 1.0}]
    result = scatter(cube, radius=0.3, classes=rows, viewport=0.25, order=order)
    for each, name in ((0, "Trees"), (1, "Stones")):
        places = of_class(result, each)
        shown = [matrix for other, matrix in seen.instances(result) if other.startswith(name)]
        assert len(shown) == -(-len(places) // 4)
        if order == "PROGRESSIVE":
            same_places(shown, places[: len(shown)], 0.3)
    scene = bpy.context.scene
    bpy.utils.register_class(Counting)
    try:
        camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
        scene.collection.objects.link(camera)
        scene.camera, scene.render.engine = camera, Counting.bl_idname
        scene.render.filepath = str(tmp_path / "nothing")
        bpy.ops.render.render()
    finally:
        scene.render.engine = "CYCLES"
        bpy.utils.unregister_class(Counting)
    assert Counting.counted == len(result.data.vertices)


def test_an_update_samples_the_edited_mesh_and_keeps_the_rest(forest, cube):
    material = bpy.data.materials.new("Own")
    forest.data.materials.append(material)
    forest.modifiers.new("Own", "NODES")
    before, mesh = len(forest.data.vertices), forest.data
    bpy.data.collections["Trees"].name = "Firs"
    for vertex in cube.data.vertices:
        vertex.co.x *= 2.0
    cube.location.z += 5.0
    bpy.context.view_layer.update()
    bpy.context.view_layer.objects.active = forest
    assert bpy.ops.azulejo.update() == {"FINISHED"}
    assert forest.data == mesh and mesh.materials[0] == material and "Own" in forest.modifiers
    points, radius = seen.in_world(forest), forest.azulejo.radius
    assert len(points) > 1.5 * before
    assert seen.smallest_distances(points).min() >= radius
    # A place without stones has a stone within their radius, or a tree within the mean of both.
    trees, stones = of_class(forest, 0), of_class(forest, 1)
    for place in seen.probes(cube, 2000):
        assert seen.gap([place], stones) <= 1.0001 * radius or seen.gap([place], trees) <= 1.5001 * radius
    assert len(seen.instances(forest)) == len(points)


def test_an_update_without_a_change_changes_nothing(forest):
    before = {name: seen.attribute(forest, name) for name in forest.data.attributes.keys() if name[0] != "."}
    assert bpy.ops.azulejo.update() == {"FINISHED"}
    assert before.keys() >= {"position", "rank", "class", "rotation"}
    for name, values in before.items():
        assert (seen.attribute(forest, name) == values).all()


def test_parameters_of_the_result_are_what_an_update_takes(forest, collection):
    settings = forest.azulejo
    settings.amount, settings.count = "COUNT", 123
    with pytest.raises(RuntimeError, match="count: 2 classes"):
        bpy.ops.azulejo.update()
    assert len(forest.data.vertices) != 123
    bpy.ops.azulejo.class_remove()
    assert bpy.ops.azulejo.update() == {"FINISHED"}
    assert len(forest.data.vertices) == len(seen.instances(forest)) == 123
    assert [modifier.name for modifier in forest.modifiers] == ["Azulejo Class 1"]
    bpy.ops.azulejo.class_add()
    settings.classes[1].collection = collection("Grass", 1)
    settings.amount = "RADIUS"
    assert bpy.ops.azulejo.update() == {"FINISHED"}
    assert {name[:5] for name, _ in seen.instances(forest)} == {"Stone", "Grass"}


def test_an_update_on_the_surface_updates_all_its_results(cube):
    results = [scatter(cube, amount="COUNT", count=count) for count in (10, 20)]
    results[0].azulejo.count, results[1].azulejo.count = 11, 22
    bpy.context.view_layer.objects.active = cube
    assert bpy.ops.azulejo.update() == {"FINISHED"}
    assert [len(result.data.vertices) for result in results] == [11, 22]


def test_results_are_updated_after_those_that_they_keep_clear_of(cube):
    # That which is kept clear of is made last.
    first, second = scatter(cube, radius=0.3), scatter(cube, radius=2.0)
    first.azulejo.avoided, first.azulejo.clearance = second, 0.6
    cube.scale = (2.0, 2.0, 2.0)
    bpy.context.view_layer.objects.active = cube
    assert bpy.ops.azulejo.update() == {"FINISHED"}
    assert seen.gap(seen.in_world(first), seen.in_world(second)) >= 0.6 * (1.0 - 1e-6)
    assert seen.farthest(seen.probes(cube, 500), seen.in_world(second)) <= 2.0002
    # Each of the other: the last that is made keeps clear.
    second.azulejo.avoided, second.azulejo.clearance = first, 0.5
    assert bpy.ops.azulejo.update() == {"FINISHED"}
    assert seen.gap(seen.in_world(first), seen.in_world(second)) >= 0.5 * (1.0 - 1e-6)
    second.azulejo.avoided = second
    with pytest.raises(RuntimeError, match="avoided: Cube Scatter.001 cannot keep clear of itself"):
        bpy.ops.azulejo.update()


def test_an_update_in_edit_mode_sees_the_edited_mesh(cube):
    result = scatter(cube, radius=0.3)
    before = len(result.data.vertices)
    bpy.context.view_layer.objects.active = cube
    cube.select_set(True)
    bpy.ops.object.mode_set(mode="EDIT")
    with pytest.raises(RuntimeError, match="result: Cube Scatter is in edit mode"):
        bpy.ops.azulejo.update()
    bpy.ops.object.mode_set(mode="OBJECT")
    result.select_set(False)
    bpy.ops.object.mode_set(mode="EDIT")
    try:
        bpy.ops.mesh.select_all(action="SELECT")
        bpy.ops.transform.resize(value=(2.0, 2.0, 2.0))
        assert bpy.ops.azulejo.update() == {"FINISHED"}
    finally:
        bpy.ops.object.mode_set(mode="OBJECT")
    assert len(result.data.vertices) > 3 * before


def test_a_result_may_be_a_child_of_its_surface(cube):
    result = scatter(cube, radius=0.3)
    alone = seen.in_world(result)
    result.parent = cube
    assert bpy.ops.azulejo.update() == {"FINISHED"}
    bpy.context.view_layer.update()
    assert np.abs(seen.in_world(result) - alone).max() < 1e-4
    assert seen.smallest_distances(seen.in_world(result)).min() >= 0.3 * (1.0 - 1e-5)
    cube.location.z += 5.0
    bpy.context.view_layer.update()
    assert np.abs(seen.in_world(result) - alone - [0.0, 0.0, 5.0]).max() < 1e-4


def test_a_failed_update_leaves_the_result_and_says_why(forest, cube):
    before = seen.in_world(forest)
    bpy.data.objects.remove(cube)
    bpy.context.view_layer.objects.active = forest
    with pytest.raises(RuntimeError, match="source: the object that Cube Scatter was scattered on is gone"):
        bpy.ops.azulejo.update()
    assert (seen.in_world(forest) == before).all()


@pytest.mark.parametrize("role", ["source", "avoided"])
@pytest.mark.parametrize("way", ["disabled", "unlinked", "excluded", "collection disabled"])
def test_what_blender_does_not_evaluate_is_refused(cube, role, way):
    other = scatter(cube, radius=2.0)
    result = scatter(cube, radius=0.4, avoided=other.name)
    gone, apart = {"source": cube, "avoided": other}[role], bpy.data.collections.new("Apart")
    bpy.context.scene.collection.children.link(apart)
    for home in list(gone.users_collection):
        home.objects.unlink(gone)
    if way != "unlinked":
        apart.objects.link(gone)
    gone.hide_viewport = way == "disabled"
    apart.hide_viewport = way == "collection disabled"
    bpy.context.view_layer.layer_collection.children["Apart"].exclude = way == "excluded"
    gone.location.x += 3.0
    bpy.context.view_layer.objects.active = result
    with pytest.raises(RuntimeError, match=f"{role}: {gone.name} is disabled in the viewport, or not in the view layer"):
        bpy.ops.azulejo.update()
    if way == "disabled":
        # What is hidden by the eye alone is there.
        gone.hide_viewport = False
        gone.hide_set(True)
        assert bpy.ops.azulejo.update() == {"FINISHED"}
        assert abs(seen.in_world(result)[:, 0].mean() - (103.0 if role == "source" else 100.0)) < 0.5


def test_a_result_is_not_put_on_itself(forest):
    bpy.data.collections["Trees"].objects.link(forest)
    with pytest.raises(RuntimeError, match="classes: the collection Trees holds Cube Scatter itself"):
        bpy.ops.azulejo.update()


def test_a_result_is_linked_outside_the_collections_of_its_classes(cube, collection):
    rocks = collection("Rocks", 1)
    bpy.context.scene.collection.children.link(rocks)
    rocks.objects.link(cube)
    for other in list(cube.users_collection):
        if other != rocks:
            other.objects.unlink(cube)
    result = scatter(cube, radius=0.5, classes=[{"name": "Rocks", "factor": 1.0}])
    assert rocks not in result.users_collection and result.users_collection


def test_undo_takes_the_result_away_and_redo_brings_it_back(cube):
    # Undo makes objects anew: they are asked for by name.
    bpy.ops.ed.undo_push(message="before")
    before = set(bpy.data.objects.keys()), set(bpy.data.meshes.keys())
    scatter(cube, amount="COUNT", count=50)
    bpy.ops.ed.undo_push(message="scattered")
    bpy.context.object.azulejo.count = 60
    bpy.ops.azulejo.update()
    bpy.ops.ed.undo_push(message="updated")
    assert len(bpy.data.objects["Cube Scatter"].data.vertices) == 60
    bpy.ops.ed.undo()
    result = bpy.data.objects["Cube Scatter"]
    assert len(result.data.vertices) == result.azulejo.count == 50
    bpy.ops.ed.undo()
    assert (set(bpy.data.objects.keys()), set(bpy.data.meshes.keys())) == before
    bpy.ops.ed.redo()
    assert len(bpy.data.objects["Cube Scatter"].data.vertices) == 50


def test_results_are_saved_and_loaded(forest, tmp_path):
    count = len(forest.data.vertices)
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "forest.blend"))
    bpy.data.objects.remove(forest)
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "forest.blend"))
    loaded = bpy.data.objects["Cube Scatter"]
    assert [each.collection.name for each in loaded.azulejo.classes] == ["Trees", "Stones"]
    assert len(loaded.data.vertices) == len(seen.instances(loaded)) == count
    bpy.context.view_layer.objects.active = loaded
    loaded.azulejo.radius *= 0.5
    assert bpy.ops.azulejo.update() == {"FINISHED"}
    assert len(loaded.data.vertices) > 3 * count


class Layout:
    """Takes what a panel draws, and fails where it names a property or operator that is not there."""

    use_property_split = False

    def __init__(self, drawn):
        self.drawn = drawn

    def row(self, **options):
        return self

    column = row

    def prop(self, data, name, **options):
        assert name in data.bl_rna.properties
        self.drawn.append(name)

    def prop_search(self, data, name, found_in, found, **options):
        assert hasattr(found_in, found)
        self.prop(data, name)

    def operator(self, name, **options):
        bpy.ops.azulejo.scatter.get_rna_type() and getattr(bpy.ops.azulejo, name.split(".")[1]).get_rna_type()
        self.drawn.append(name)

    def template_list(self, kind, _, data, name, active_data, active, **options):
        assert hasattr(bpy.types, kind) and name in data.bl_rna.properties and active in active_data.bl_rna.properties
        self.drawn.append(name)


def test_panels_name_what_there_is(forest, cube):
    panel = bpy.types.AZULEJO_PT_scatter
    for active, expected in ((cube, ["azulejo.scatter", "azulejo.update"]), (forest, ["source", "amount", "radius"])):
        bpy.context.view_layer.objects.active = active
        drawn = []
        panel.draw(SimpleNamespace(layout=Layout(drawn)), bpy.context)
        assert drawn[: len(expected)] == expected
    assert drawn[-1] == "azulejo.update" and {"density", "order", "viewport", "seed", "avoided", "classes"} <= set(drawn)


@pytest.mark.parametrize("amount", ["RADIUS", "COUNT"])
def test_the_operator_draws_all_its_properties(forest, amount):
    operator = bpy.types.AZULEJO_OT_scatter
    rows = SimpleNamespace(bl_rna=bpy.types.PropertyGroup.bl_rna_get_subclass_py("AzulejoNamedClass").bl_rna)
    drawn = []
    active = SimpleNamespace(
        layout=Layout(drawn), bl_rna=bpy.ops.azulejo.scatter.get_rna_type(), amount=amount, class_count=1, classes=[rows]
    )
    operator.draw(active, bpy.context)
    properties = {name for name in active.bl_rna.properties.keys() if name != "rna_type"}
    assert set(drawn) == properties - {"classes", "count" if amount == "RADIUS" else "radius"} | {"name", "factor"}


def test_azulejo_comes_from_the_wheel_of_the_extension():
    import azulejo

    assert str(conftest.HOME) in azulejo.__file__


def test_disabling_leaves_nothing_and_enabling_brings_it_back(forest):
    before = {name for name in dir(bpy.types) if "azulejo" in name.lower()}
    drawn = len(bpy.types.VIEW3D_MT_object._dyn_ui_initialize())
    assert len(before) == 6
    assert bpy.ops.preferences.addon_disable(module=conftest.MODULE) == {"FINISHED"}
    try:
        assert not [name for name in dir(bpy.types) if "azulejo" in name.lower()]
        assert not hasattr(bpy.types.Object, "azulejo") and not dir(bpy.ops.azulejo)
        assert len(bpy.types.VIEW3D_MT_object._dyn_ui_initialize()) == drawn - 1
        # Without the extension instances stay: they are geometry nodes.
        assert len(seen.instances(forest)) == len(forest.data.vertices)
    finally:
        assert bpy.ops.preferences.addon_enable(module=conftest.MODULE) == {"FINISHED"}
    assert {name for name in dir(bpy.types) if "azulejo" in name.lower()} == before
    assert forest.azulejo.is_result and bpy.ops.azulejo.update() == {"FINISHED"}
