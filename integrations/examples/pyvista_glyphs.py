"""A mesh of PyVista, sampled by azulejo; the samples as a cloud with an interpolated field, and with glyphs along normals."""

import azulejo
import numpy as np
import pyvista

surface = pyvista.Sphere(theta_resolution=60, phi_resolution=60)
surface["height"] = surface.points[:, 2]

points = azulejo.psp_sample(surface, 0.05, order="progressive")

cloud = pyvista.PolyData(points.positions)
cloud["normals"], cloud["ranks"] = points.normals, points.ranks
sampled = cloud.sample(surface, tolerance=1e-5, snap_to_closest_point=True)
inside = np.abs(cloud.compute_implicit_distance(surface)["implicit_distance"]).max()
assert inside < 1e-6 and np.abs(sampled["height"] - points.positions[:, 2]).max() < 1e-3

# The first points of a progressive set are a coarse one.
coarse = pyvista.PolyData(points.positions[:50])
coarse["normals"] = points.normals[:50]
cone = pyvista.Cone(radius=0.02, height=0.08, resolution=8)
glyphs = coarse.glyph(orient="normals", scale=False, geom=cone)
assert glyphs.n_points == 50 * cone.n_points
print(f"PyVista: {cloud.n_points} samples on the surface within {inside:.1e}, 50 cones {points.ranks[49]:.4f} apart")
