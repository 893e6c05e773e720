"""Meshes of other packages."""

from types import SimpleNamespace

import numpy as np
import pytest

import azulejo

VERTICES = np.array([[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [2.0, 1.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 3.0]])
TRIANGLES = np.array([[0, 1, 2], [0, 2, 3], [0, 3, 4]], np.int64)
MESH = azulejo.Mesh(VERTICES, TRIANGLES)


class Tensor:
    """An array that is reached by DLPack, or by numpy(), alone."""

    def __init__(self, array):
        self.array = array

    def __dlpack__(self, **options):
        return self.array.__dlpack__(**options)

    def __dlpack_device__(self):
        return self.array.__dlpack_device__()

    def numpy(self):
        return self.array


OBJECTS = [
    (VERTICES, TRIANGLES),
    (VERTICES.tolist(), TRIANGLES.tolist()),
    SimpleNamespace(vertices=VERTICES, faces=TRIANGLES),
    SimpleNamespace(vertices=VERTICES, triangles=TRIANGLES),
    SimpleNamespace(points=VERTICES, faces=np.insert(TRIANGLES, 0, 3, axis=1).ravel()),
    SimpleNamespace(vertex=SimpleNamespace(positions=Tensor(VERTICES)), triangle=SimpleNamespace(indices=Tensor(TRIANGLES))),
    (Tensor(VERTICES), Tensor(TRIANGLES)),
]


@pytest.mark.parametrize("other", OBJECTS)
def test_a_mesh_of_another_package_is_taken(other):
    expected = azulejo.psp_sample(MESH, 0.2)
    assert (azulejo.psp_sample(other, 0.2).positions == expected.positions).all()
    assert azulejo.mesh_coverage(other, expected, 0.2 + 1e-6).gaps == 0
    growing = azulejo.Psp(other, 0.2)
    growing.fill()
    assert len(azulejo.dcr_surface_relax(other, expected.triangles, expected.barycentrics)) == len(expected)


def test_polygons_become_fans():
    quads = azulejo.Mesh(VERTICES, [[0, 1, 2, 3]])
    assert quads.indices.tolist() == [[0, 1, 2], [0, 2, 3]]
    mixed = SimpleNamespace(points=VERTICES, faces=[4, 0, 1, 2, 3, 3, 0, 3, 4])
    assert (azulejo.psp_sample(mixed, 0.2).positions == azulejo.psp_sample(MESH, 0.2).positions).all()


def test_what_is_no_mesh_is_refused():
    for other in (None, 3, "mesh.ply", SimpleNamespace(vertices=VERTICES)):
        with pytest.raises(TypeError, match="^mesh: a .* is no azulejo.Mesh, has no vertices and faces"):
            azulejo.psp_sample(other, 0.2)
    with pytest.raises(ValueError, match="^indices: a face of 9 corners, but 2 numbers follow"):
        azulejo.psp_sample(SimpleNamespace(points=VERTICES, faces=[9, 0, 1]), 0.2)
    with pytest.raises(ValueError, match="^indices: "):
        azulejo.Mesh(VERTICES, [[0, 1]])
