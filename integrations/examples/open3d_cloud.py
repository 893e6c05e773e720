"""A mesh of Open3D, sampled by azulejo; the samples as a point cloud of Open3D with normals; and a cloud, thinned."""

import azulejo
import numpy as np
import open3d

mesh = open3d.geometry.TriangleMesh.create_torus(1.0, 0.4)
mesh.compute_vertex_normals()

points = azulejo.psp_sample(mesh, 0.1)

cloud = open3d.geometry.PointCloud(open3d.utility.Vector3dVector(points.positions.astype(np.float64)))
cloud.normals = open3d.utility.Vector3dVector(points.normals.astype(np.float64))
nearest = np.asarray(cloud.compute_nearest_neighbor_distance())
assert nearest.min() >= 0.1 and nearest.max() < 0.2

# The tensors of the newer interface are taken as well.
tensor = open3d.t.geometry.TriangleMesh.from_legacy(mesh)
assert (azulejo.psp_sample(tensor, 0.1).positions == points.positions).all()

dense = mesh.sample_points_uniformly(20000)
selection = azulejo.thin(np.asarray(dense.points), count=500)
thinned = dense.select_by_index(selection.indices)
spacing = np.asarray(thinned.compute_nearest_neighbor_distance()).min()
assert len(thinned.points) == 500 and spacing > 0.05
print(f"Open3D: {len(cloud.points)} samples, {nearest.min():.4f} apart; of 20000 points 500, {spacing:.4f} apart")
