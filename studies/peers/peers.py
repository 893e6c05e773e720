"""Runs one peer from PyPI: peers.py NAME COUNT RADIUS OUT [MESH]

Writes the samples to OUT, raw doubles, and prints seconds, seconds of processor time and megabytes as timing.rs does.
"""

import resource
import sys
import time

import numpy


def poisson_disk(count, radius, mesh):
    from scipy.stats import qmc

    sampler = qmc.PoissonDisk(2, radius=radius, rng=1)
    return sampler.fill_space


def halton_lloyd(count, radius, mesh):
    from scipy.stats import qmc

    return lambda: qmc.Halton(2, rng=1, optimization="lloyd").random(count)


def lloyd_plane(count, radius, mesh):
    import point_cloud_utils

    return lambda: point_cloud_utils.lloyd_2d(count, num_lloyd=100)


def blue_sampler(count, radius, mesh):
    import blue_sampler

    return lambda: blue_sampler.sample_points(N=count, D=2, method="nufft", verbose=0)


def open3d_elimination(count, radius, mesh):
    import open3d

    surface = open3d.io.read_triangle_mesh(mesh)
    return lambda: numpy.asarray(surface.sample_points_poisson_disk(count).points)


def meshlab(count, radius, mesh):
    import pymeshlab

    meshes = pymeshlab.MeshSet(verbose=False)
    meshes.load_new_mesh(mesh)

    def sample():
        meshes.set_current_mesh(0)
        meshes.generate_sampling_poisson_disk(radius=pymeshlab.PureValue(radius))
        return meshes.current_mesh().vertex_matrix()

    return sample


def cloud_poisson_disk(count, radius, mesh):
    import point_cloud_utils

    vertices, faces = point_cloud_utils.load_mesh_vf(mesh)

    def sample():
        triangles, shares = point_cloud_utils.sample_mesh_poisson_disk(
            vertices, faces, -1, radius=radius, use_geodesic_distance=False, random_seed=1
        )
        return point_cloud_utils.interpolate_barycentric_coords(faces, triangles, shares, vertices)

    return sample


def cloud_lloyd(count, radius, mesh):
    import point_cloud_utils

    vertices, faces = point_cloud_utils.load_mesh_vf(mesh)
    return lambda: point_cloud_utils.sample_mesh_lloyd(vertices, faces, count)


def igl_blue_noise(count, radius, mesh):
    import igl
    import trimesh

    surface = trimesh.load(mesh)
    vertices, faces = numpy.asarray(surface.vertices), numpy.asarray(surface.faces)
    return lambda: igl.blue_noise(vertices, faces, radius)[2]


def trimesh_even(count, radius, mesh):
    import trimesh

    surface = trimesh.load(mesh)
    return lambda: trimesh.sample.sample_surface_even(surface, count, radius=radius, seed=1)[0]


def blender(count, radius, mesh):
    import bpy

    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.wm.ply_import(filepath=mesh)
    surface = bpy.context.object
    tree = bpy.data.node_groups.new("samples", "GeometryNodeTree")
    tree.interface.new_socket("Geometry", in_out="INPUT", socket_type="NodeSocketGeometry")
    tree.interface.new_socket("Geometry", in_out="OUTPUT", socket_type="NodeSocketGeometry")
    first, last = tree.nodes.new("NodeGroupInput"), tree.nodes.new("NodeGroupOutput")
    points = tree.nodes.new("GeometryNodeDistributePointsOnFaces")
    points.distribute_method = "POISSON"
    points.inputs["Distance Min"].default_value = radius
    # It draws so many points per area and drops those too near. Ten times as many as can stay.
    points.inputs["Density Max"].default_value = 10 * 0.69656 / radius**2
    points.inputs["Seed"].default_value = 1
    vertices = tree.nodes.new("GeometryNodePointsToVertices")
    tree.links.new(first.outputs[0], points.inputs["Mesh"])
    tree.links.new(points.outputs["Points"], vertices.inputs["Points"])
    tree.links.new(vertices.outputs[0], last.inputs[0])

    def sample():
        surface.modifiers.new("samples", "NODES").node_group = tree
        made = surface.evaluated_get(bpy.context.evaluated_depsgraph_get()).to_mesh()
        places = numpy.empty(3 * len(made.vertices), dtype=numpy.float32)
        made.vertices.foreach_get("co", places)
        return places

    return sample


def cloud_of(path):
    return numpy.fromfile(path).reshape(-1, 3)


def fpsample_kdline(count, radius, path):
    import fpsample

    points = cloud_of(path).astype(numpy.float32)
    return lambda: points[fpsample.bucket_fps_kdline_sampling(points, count, h=7, start_idx=0)]


def open3d_cloud(path):
    import open3d

    return open3d.geometry.PointCloud(open3d.utility.Vector3dVector(cloud_of(path)))


def open3d_farthest(count, radius, path):
    cloud = open3d_cloud(path)
    return lambda: numpy.asarray(cloud.farthest_point_down_sample(count).points)


def open3d_elimination_of_cloud(count, radius, path):
    import open3d

    cloud = open3d_cloud(path)
    # Of the mesh it uses the area alone: that of which the radius was computed.
    area = radius**2 * count / 0.69656
    corners = open3d.utility.Vector3dVector(numpy.array([[0, 0, 0], [2 * area, 0, 0], [0, 1, 0]]))
    mesh = open3d.geometry.TriangleMesh(corners, open3d.utility.Vector3iVector(numpy.array([[0, 1, 2]])))
    return lambda: numpy.asarray(mesh.sample_points_poisson_disk(count, pcl=cloud).points)


def cloud_thinned(count, radius, path):
    import point_cloud_utils

    points = cloud_of(path)
    return lambda: points[point_cloud_utils.downsample_point_cloud_poisson_disk(points, radius, random_seed=1)]


def poisson_disk_cuboid(count, radius, mesh):
    from scipy.stats import qmc

    return qmc.PoissonDisk(3, radius=radius, rng=1).fill_space


def random_cuboid(count):
    """Ten times as many random points of the unit cube."""
    return numpy.random.default_rng(1).random((10 * count, 3))


def cuboid_thinned(count, radius, mesh):
    import point_cloud_utils

    points = random_cuboid(count)
    return lambda: points[point_cloud_utils.downsample_point_cloud_poisson_disk(points, radius, random_seed=1)]


def cuboid_voxels(count, radius, mesh):
    import open3d

    cloud = open3d.geometry.PointCloud(open3d.utility.Vector3dVector(random_cuboid(count)))
    return lambda: numpy.asarray(cloud.voxel_down_sample(radius).points)


def trimesh_inside(count, radius, mesh):
    import trimesh

    solid = trimesh.load(mesh)
    numpy.random.seed(1)
    return lambda: trimesh.sample.volume_mesh(solid, count)


def memory(field):
    with open("/proc/self/status") as status:
        return next(int(line.split()[1]) / 1024 for line in status if line.startswith(field))


def main():
    name, count, radius, out, *mesh = sys.argv[1:]
    sample = globals()[name](int(count), float(radius), mesh[0] if mesh else None)
    held = memory("VmRSS")
    usage = resource.getrusage(resource.RUSAGE_SELF)
    start = time.perf_counter()
    points = sample()
    seconds = time.perf_counter() - start
    after = resource.getrusage(resource.RUSAGE_SELF)
    busy = after.ru_utime + after.ru_stime - usage.ru_utime - usage.ru_stime
    print(seconds, busy, memory("VmHWM") - held)
    numpy.ascontiguousarray(points, dtype="<f8").tofile(out)


main()
