"""A mesh of trimesh, sampled by azulejo; the samples as a point cloud of trimesh, with the mesh's colours."""

import azulejo
import numpy as np
import trimesh

mesh = trimesh.creation.torus(1.0, 0.4)
mesh.visual.vertex_colors = np.clip(128 + 90 * mesh.vertices, 0, 255).astype(np.uint8)

points = azulejo.psp_sample(mesh, count=1000)

corners = mesh.faces[points.triangles]
weights = trimesh.triangles.points_to_barycentric(mesh.vertices[corners], points.positions)
colors = np.einsum("pc,pcx->px", weights, mesh.visual.vertex_colors[corners].astype(float))
cloud = trimesh.PointCloud(points.positions, colors=colors.round().astype(np.uint8))

distances, _ = cloud.kdtree.query(cloud.vertices, k=2)
assert len(cloud.vertices) == 1000 and distances[:, 1].min() >= points.report.radius
expected = np.clip(128 + 90 * points.positions, 0, 255)
assert np.abs(cloud.colors[:, :3] - expected).max() < 2.0
uneven, _ = trimesh.sample.sample_surface_even(mesh, 1000, seed=1)
print(f"trimesh: 1000 samples, {points.report.radius:.4f} apart; trimesh's own call gave {len(uneven)}")
