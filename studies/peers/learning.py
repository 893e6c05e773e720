"""A thousand small meshes, each as a cloud of exactly 1,024 samples of which the first ones are a coarser cloud:
learning.py --page docs/learning.md [--quick]

Times azulejo and what point clouds for learning are made with, one call for each mesh on one thread, and writes the page. Needs
trimesh, rtree, open3d, fpsample, scipy, numpy and azulejo.
"""

import argparse
import datetime
import os
import time
from collections.abc import Callable
from importlib.metadata import version
from pathlib import Path
from typing import Any, NamedTuple

# Before the packages are loaded, which start their threads then.
os.environ["OMP_NUM_THREADS"] = "1"

import azulejo  # noqa: E402
import fpsample  # noqa: E402
import numpy  # noqa: E402
import open3d  # noqa: E402
import trimesh  # noqa: E402
from numpy.random import Generator  # noqa: E402
from numpy.typing import NDArray  # noqa: E402
from scipy.spatial import cKDTree  # noqa: E402

# The first line of the page.
SUBJECT = (
    "Clouds of exactly 1,024 samples of a thousand small meshes, coarse to fine, by azulejo and by other packages: time and spacing."
)
COUNT, FIRST = 1024, 128
TRIANGLES = (200, 5000)
GOAL = 0.002

Surface = tuple[NDArray[numpy.float64], NDArray[numpy.int64]]


def grid(place: Callable[[Any, Any], Any], rows: int, columns: int) -> Surface:
    """A sheet of 2 × rows × columns triangles, by its places of two numbers from 0 to 1."""
    u, v = numpy.meshgrid(numpy.linspace(0, 1, rows + 1), numpy.linspace(0, 1, columns + 1), indexing="ij")
    vertices = numpy.stack(numpy.broadcast_arrays(*place(u, v)), axis=-1).reshape(-1, 3)
    first = (numpy.arange(rows)[:, None] * (columns + 1) + numpy.arange(columns)).ravel()
    a, b, c, d = first, first + columns + 1, first + columns + 2, first + 1
    return vertices, numpy.concatenate([numpy.stack([a, b, c], -1), numpy.stack([a, c, d], -1)])


def joined(sheets: list[Surface]) -> Surface:
    starts = numpy.cumsum([0] + [len(vertices) for vertices, _ in sheets])
    faces = [faces + start for (_, faces), start in zip(sheets, starts)]
    return numpy.concatenate([vertices for vertices, _ in sheets]), numpy.concatenate(faces)


def waves(generator: Generator, height: float) -> Callable[[Any], Any]:
    """A periodic function of an angle, near 1."""
    heights, phases = height * generator.uniform(-1, 1, 4), generator.uniform(0, 2 * numpy.pi, 4)
    return lambda angle: 1 + sum(heights[i] * numpy.sin((i + 2) * angle + phases[i]) for i in range(4))


def sphere(generator: Generator, triangles: float) -> Surface:
    around, along = waves(generator, 0.08), waves(generator, 0.08)
    rows = max(round((triangles / 4) ** 0.5), 3)

    def place(u: Any, v: Any) -> Any:
        polar, turn = numpy.pi * u, 2 * numpy.pi * v
        radius = 1 + (around(turn) * along(2 * polar) - 1) * numpy.sin(polar)
        return radius * numpy.sin(polar) * numpy.cos(turn), radius * numpy.sin(polar) * numpy.sin(turn), radius * numpy.cos(polar)

    return grid(place, rows, 2 * rows)


def torus(generator: Generator, triangles: float) -> Surface:
    thickness, bends = generator.uniform(0.15, 0.5), waves(generator, 0.05)
    sides = max(round((triangles / 6) ** 0.5), 3)

    def place(u: Any, v: Any) -> Any:
        turn, side = 2 * numpy.pi * u, 2 * numpy.pi * v
        reach = bends(turn) + thickness * numpy.cos(side)
        return reach * numpy.cos(turn), reach * numpy.sin(turn), thickness * numpy.sin(side)

    return grid(place, 3 * sides, sides)


def box(generator: Generator, triangles: float) -> Surface:
    lengths = generator.uniform(0.2, 1, 3)
    step = (triangles / 12) ** 0.5
    sheets = []
    for axis in range(3):
        for side in (0, 1):

            def place(u: Any, v: Any) -> Any:
                axes = numpy.roll([side + 0 * u, u, v], axis, axis=0)
                return [length * part for length, part in zip(lengths, axes)]

            sheets.append(grid(place, max(round(step), 1), max(round(step), 1)))
    return joined(sheets)


def extrusion(generator: Generator, triangles: float) -> Surface:
    outline, height = waves(generator, 0.12), generator.uniform(0.1, 2)
    around = max(round((triangles / 2) ** 0.5), 6)

    def edge(share: Any, v: Any) -> Any:
        turn = 2 * numpy.pi * v
        return share * outline(turn) * numpy.cos(turn), share * outline(turn) * numpy.sin(turn)

    side = grid(lambda u, v: (*edge(1, v), height * u), max(round(around / 2), 1), around)
    caps = [grid(lambda u, v, z=z: (*edge(u, v), z + 0 * u), max(round(around / 4), 1), around) for z in (0.0, height)]
    return joined([side, *caps])


KINDS = [sphere, torus, box, extrusion]


def surface(number: int) -> Surface:
    generator = numpy.random.default_rng(number)
    low, high = TRIANGLES
    return KINDS[number % len(KINDS)](generator, low * (high / low) ** generator.random())


def of_azulejo(order: str) -> Callable[[Surface, int], Callable[[], Any]]:
    def ready(mesh: Surface, seed: int) -> Callable[[], Any]:
        return lambda: azulejo.psp_sample(mesh, count=COUNT, order=order, seed=seed, threads=1).positions

    return ready


def of_trimesh(mesh: Surface, seed: int) -> Callable[[], Any]:
    made = trimesh.Trimesh(*mesh, process=False)
    return lambda: trimesh.sample.sample_surface_even(made, COUNT, seed=seed)[0]


def of_open3d(mesh: Surface, seed: int) -> Callable[[], Any]:
    vertices, faces = mesh
    made = open3d.geometry.TriangleMesh(open3d.utility.Vector3dVector(vertices), open3d.utility.Vector3iVector(faces))
    open3d.utility.random.seed(seed)
    return lambda: numpy.asarray(made.sample_points_poisson_disk(COUNT).points)


def farthest(mesh: Surface, seed: int) -> Callable[[], Any]:
    """Of eight times as many random samples those that are the farthest from all before them."""
    made = trimesh.Trimesh(*mesh, process=False)

    def sample() -> Any:
        cloud = trimesh.sample.sample_surface(made, 8 * COUNT, seed=seed)[0].astype(numpy.float32)
        return cloud[fpsample.bucket_fps_kdline_sampling(cloud, COUNT, h=5, start_idx=0)]

    return sample


PROGRESSIVE = "**azulejo**, progressive"
METHODS = {
    PROGRESSIVE: of_azulejo("progressive"),
    "**azulejo**, any order": of_azulejo("any"),
    "trimesh sample_surface_even": of_trimesh,
    "Open3D sample_points_poisson_disk": of_open3d,
    "trimesh sample_surface, fpsample": farthest,
}


class Cloud(NamedTuple):
    seconds: float
    count: int
    # The smallest distances of all samples, and of the first ones, over that of as many in hexagons on a plane of the same area.
    spacings: tuple[float, float]


def spacing(points: NDArray[numpy.float64], area: float) -> float:
    distances, _ = cKDTree(points).query(points, k=2)
    return float(distances[:, 1].min() / (2 * area / (3**0.5 * len(points))) ** 0.5)


def area_of(mesh: Surface) -> float:
    a, b, c = numpy.moveaxis(mesh[0][mesh[1]], 1, 0)
    return float(numpy.linalg.norm(numpy.cross(b - a, c - a), axis=1).sum() / 2)


def measure(method: Callable[[Surface, int], Callable[[], Any]], meshes: list[Surface]) -> list[Cloud]:
    # The first call loads what others find loaded.
    method(meshes[0], 0)()
    found = []
    for seed, mesh in enumerate(meshes):
        sample, area = method(mesh, seed), area_of(mesh)
        # Of the processor: others use the machine, too, and the calls have one thread.
        start = time.process_time()
        points = sample()
        seconds = time.process_time() - start
        points = numpy.asarray(points, dtype=float)
        found.append(Cloud(seconds, len(points), (spacing(points, area), spacing(points[:FIRST], area))))
    return found


def row(name: str, clouds: list[Cloud]) -> str:
    median, most = numpy.quantile([cloud.seconds for cloud in clouds], (0.5, 0.95)) * 1e3
    exact = sum(cloud.count == COUNT for cloud in clouds)
    own, first = numpy.mean([cloud.spacings for cloud in clouds], axis=0)
    return f"| {name} | {median:.2f} | {most:.2f} | {exact:,} | {own:.3f} | {first:.3f} |"


def processor() -> str:
    lines = Path("/proc/cpuinfo").read_text().splitlines()
    return next((line.split(": ")[1] for line in lines if line.startswith("model name")), "an unknown processor")


def text(quick: bool, meshes: list[Surface]) -> str:
    all = {name: measure(method, meshes) for name, method in METHODS.items()}
    seconds = {name: numpy.array([cloud.seconds for cloud in clouds]) for name, clouds in all.items()}
    own = seconds[PROGRESSIVE]
    faster = [name for name, of_one in seconds.items() if numpy.median(of_one) < numpy.median(own) and "azulejo" not in name]
    verdict = "met" if numpy.quantile(own, 0.95) <= GOAL else "**not met**"
    faces = [len(faces) for _, faces in meshes]
    packages = ", ".join(f"{name} {version(name)}" for name in ("azulejo-sampling", "trimesh", "open3d", "fpsample"))
    date = datetime.datetime.now(datetime.timezone.utc).date()
    lines = [
        "# Clouds of small meshes, measured",
        "",
        SUBJECT,
        "",
        f"Written by `studies/peers/learning.sh{' --quick' if quick else ''}` on {date}, on one thread of {processor()}, with "
        f"{packages}. Faster than azulejo's progressive clouds, by the median: {'; '.join(faster) or 'none'}. Goal: within "
        f"{GOAL * 1e3:g} ms for 95 % of the meshes, {verdict}: {100 * numpy.mean(own <= GOAL):.1f} % of them took no longer. "
        f"{len(meshes):,} meshes of {min(faces):,} to {max(faces):,} triangles, each as a cloud of {COUNT:,} samples.",
        "",
        "Spheres and tori with waves, boxes and extruded outlines, one call for each. *ms* are of the processor, since others use the "
        "machine, too: the median of the meshes, and what 95 % of them stayed within; azulejo takes arrays and makes its mesh of them "
        "in that time, the others have theirs before. *Exact* are "
        f"the meshes that got exactly {COUNT:,} samples. *ρ* is the smallest distance over that of as many samples in hexagons on a plane "
        f"of the same area, a mean over meshes; then the same of the first {FIRST}, which in progressive order and of fpsample's farthest "
        "points are a coarser cloud of their own, and elsewhere by accident what they are.",
        "",
        f"| | ms, median | ms, 95 % | exact | ρ | ρ of the first {FIRST} |",
        "|---|---|---|---|---|---|",
        *(row(name, clouds) for name, clouds in all.items()),
    ]
    return "\n".join(lines) + "\n"


def main() -> None:
    parser = argparse.ArgumentParser()
    parser.add_argument("--page", type=Path, required=True, help="the page to write")
    parser.add_argument("--quick", action="store_true", help="few meshes: to see the page, not to believe it")
    arguments = parser.parse_args()
    meshes = [surface(number) for number in range(20 if arguments.quick else 1000)]
    arguments.page.write_text(text(arguments.quick, meshes))


main()
