"""A mesh of Mitsuba 3, sampled by azulejo; a sphere on each sample, and a small picture of them."""

import azulejo
import mitsuba
import numpy as np

mitsuba.set_variant("scalar_rgb")

# A torus by its vertices and faces, as a mesh of Mitsuba.
rings, sides = 48, 24
around, across = np.meshgrid(np.arange(rings), np.arange(sides), indexing="ij")
u, v = 2.0 * np.pi * around / rings, 2.0 * np.pi * across / sides
vertices = np.stack([(1.0 + 0.4 * np.cos(v)) * np.cos(u), (1.0 + 0.4 * np.cos(v)) * np.sin(u), 0.4 * np.sin(v)], axis=2)
next_ring, next_side = (around + 1) % rings, (across + 1) % sides
quads = np.stack([a * sides + b for a, b in ((around, across), (next_ring, across), (next_ring, next_side), (around, next_side))], axis=2)
faces = quads.reshape(-1, 4)[:, [0, 1, 2, 0, 2, 3]].reshape(-1, 3)
torus = mitsuba.Mesh("torus", rings * sides, len(faces))
parameters = mitsuba.traverse(torus)
parameters["vertex_positions"] = vertices.ravel().astype(np.float32)
parameters["faces"] = faces.ravel().astype(np.uint32)
parameters.update()

# What azulejo takes is what any mesh of Mitsuba has.
parameters = mitsuba.traverse(torus)
positions = np.array(parameters["vertex_positions"]).reshape(-1, 3)
indices = np.array(parameters["faces"]).reshape(-1, 3)
points = azulejo.psp_sample((positions, indices), count=400)

size = 0.4 * points.report.radius
scene = {
    "type": "scene",
    "integrator": {"type": "direct"},
    "light": {"type": "constant"},
    "sensor": {
        "type": "perspective",
        "to_world": mitsuba.ScalarTransform4f().look_at(origin=[0, -2.4, 2.4], target=[0, 0, 0], up=[0, 0, 1]),
        "film": {"type": "hdrfilm", "width": 96, "height": 64},
        "sampler": {"type": "independent", "sample_count": 4},
    },
    "torus": torus,
}
for index, place in enumerate(points.positions.astype(float)):
    scene[f"sphere{index}"] = {"type": "sphere", "center": place.tolist(), "radius": size}
scene = mitsuba.load_dict(scene)

# From above each sample along its normal: its own sphere is the first thing that a ray meets.
for place, normal in zip(points.positions.astype(float), points.normals.astype(float)):
    hit = scene.ray_intersect(mitsuba.Ray3f((place + 2.0 * size * normal).tolist(), (-normal).tolist()))
    assert hit.is_valid() and abs(hit.t - size) < 1e-4
picture = np.array(mitsuba.render(scene))
assert picture.shape[:2] == (64, 96) and 0.1 < (picture.mean(axis=2) < 0.99).mean() < 0.9
print(f"Mitsuba: {len(points)} spheres on the torus, {points.report.radius:.4f} apart")
