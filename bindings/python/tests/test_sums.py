"""The bytes are those of the Rust calls: tests/sums.txt of the repository."""

import hashlib
import re
from pathlib import Path

import numpy as np
import pytest

import azulejo
from meshes import torus

SUMS = Path(__file__).parents[3] / "tests" / "sums.txt"
FAR = dict(domain_min=(1000.0, -3.0), domain_max=(1004.0, -1.0))


def ordered_window(threads):
    window = ((1000.0, -2.5), (1000.4, -1.5))
    points = azulejo.kdrt_sample_window(*window, 0.02, order="progressive", coarsest=0.1, threads=threads, **FAR)
    return np.concatenate([points.positions.ravel(), points.ranks])


def equal_classes(threads):
    radii = azulejo.classes_radii([0.01] * 4, 0.7)
    points = azulejo.kdrt_sample_classes(radii, seed=26, boundary="bounded", threads=threads)
    return np.concatenate([points.positions.ravel(), points.classes.astype("<u4").view("<f4")])


def with_normals():
    """The closed torus of tests/sums/surface.rs."""
    positions, indices = torus(96, 64)
    hole, tube = np.meshgrid(2 * np.pi * np.arange(96) / 96, 2 * np.pi * np.arange(64) / 64, indexing="ij")
    normals = np.stack([np.cos(tube) * np.cos(hole), np.cos(tube) * np.sin(hole), np.sin(tube)], axis=-1)
    return azulejo.Mesh(positions, indices, normals=normals.reshape(-1, 3).astype(np.float32))


def all_of(points):
    """What tests/sums/list.rs takes of samples on a mesh, as float32."""
    fields = [points.positions, points.normals, points.interpolated_normals, points.triangles, points.barycentrics]
    fields += [points.ranks, points.classes, points.radii]
    return np.concatenate([field.ravel().view("<f4") for field in fields if field is not None])


MASKS = [7 if i % 9 < 5 else i % 8 for i in range(2 * 96 * 64)]


def classes_on_a_mesh(threads):
    radii = azulejo.classes_radii([0.05, 0.1, 0.05])
    return all_of(azulejo.psp_sample_classes(with_normals(), radii, masks=MASKS, seed=46, threads=threads))


def classes_with_density(threads):
    mesh, radii = with_normals(), azulejo.classes_radii([1.0, 2.0, 1.0])
    x, _, z = mesh.positions.T
    density = np.maximum(x + np.float32(0.5) * z, 0)
    points = azulejo.psp_classes_with_density(mesh, radii, density, count=2000, masks=MASKS, seed=48, threads=threads)
    return all_of(points)


CALLS = {
    "maximal periodic": lambda threads: azulejo.maximal_sample(0.01, seed=1, threads=threads).positions,
    "kdrt 20r": lambda threads: azulejo.kdrt_sample(0.002, seed=3, threads=threads).positions,
    "kdrt far": lambda threads: azulejo.kdrt_sample(0.01, seed=7, threads=threads, **FAR).positions,
    "ordered window": ordered_window,
    "classes equal": equal_classes,
    "classes": classes_on_a_mesh,
    "classes, density": classes_with_density,
}


@pytest.mark.parametrize("threads", [1, 3])
@pytest.mark.parametrize("name", CALLS)
def test_the_sum_of_a_call(name, threads):
    line = re.search(rf"^(\w+)  {name} \(", SUMS.read_text(), re.MULTILINE)
    assert hashlib.sha256(CALLS[name](threads).astype("<f4").tobytes()).hexdigest() == line[1]
