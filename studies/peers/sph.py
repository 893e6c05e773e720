"""Fluid at rest in a closed box, filled by a grid and by azulejo's sets, in SPlisHSPlasH: sph.py [--quick] [--side N]

Prints a part of docs/volume.md: how far the particles move although nothing moves them but their arrangement. Needs
pysplishsplash, numpy and azulejo.
"""

import argparse
import ctypes
import json
import os
import subprocess
import sys
import tempfile
from importlib.metadata import version

import numpy

# The gravity. Walls are so many spacings from the outermost particles: at 1.25 a grid is at rest.
CASES = [("no gravity", 0.0), ("gravity of 9.81 m/s²", -9.81)]
DISTANCE = 1.25
SETS = ["grid", "jittered grid", "random", "maximal", "relaxed"]
# Seconds, their steps and steps of the relaxation.
TIME, STEP = 0.5, 0.0005
# Steps from one look at the particles to the next.
LOOK = 10
RELAXATION = 100
# kg/m³; Pa.
DENSITY, STIFFNESS = 1000.0, 50000.0


def grid(side):
    places = numpy.arange(side) / side + 0.5 / side
    return numpy.stack(numpy.meshgrid(places, places, places, indexing="ij"), -1).reshape(-1, 3)


def positions(name, side, seed):
    """side³ particles in the unit cube, none nearer to its faces than half a spacing, but for random and jittered ones."""
    spacing, random = 1 / side, numpy.random.default_rng(seed)
    if name == "grid":
        return grid(side)
    if name == "jittered grid":
        return grid(side) + random.uniform(-spacing / 4, spacing / 4, (side**3, 3))
    if name == "random":
        return random.uniform(spacing / 2, 1 - spacing / 2, (side**3, 3))
    import azulejo

    low, high = [spacing / 2] * 3, [1 - spacing / 2] * 3
    cuboid = dict(domain_min=low, domain_max=high, boundary="bounded", seed=seed)
    points = azulejo.volume_sample(count=side**3, **cuboid)
    if name == "relaxed":
        points = azulejo.volume_relax(points.positions, max_iterations=RELAXATION, **cuboid)
    return numpy.asarray(points.positions, dtype=float)


def box(low, high):
    corners = [(x, y, z) for x in (low, high) for y in (low, high) for z in (low, high)]
    faces = [(0, 1, 3), (0, 3, 2), (4, 6, 7), (4, 7, 5), (0, 4, 5), (0, 5, 1), (2, 3, 7), (2, 7, 6), (0, 2, 6), (0, 6, 4)]
    faces += [(1, 5, 7), (1, 7, 3)]
    lines = ["v %.9g %.9g %.9g" % corner for corner in corners]
    return "\n".join(lines + ["f %d %d %d" % tuple(corner + 1 for corner in face) for face in faces]) + "\n"


def scene(folder, side, gravity):
    spacing = 1 / side
    beyond = (DISTANCE - 0.5) * spacing
    with open(os.path.join(folder, "box.obj"), "w") as file:
        file.write(box(-beyond, 1 + beyond))
    configuration = dict(
        particleRadius=spacing / 2,
        simulationMethod=0,  # WCSPH
        boundaryHandlingMethod=0,  # particles on the walls (Akinci 2012)
        gravitation=[0, gravity, 0],
        cflMethod=0,
        timeStepSize=1e-9,  # the first step is that of the block of fluid which the particles replace
        stopAt=TIME,
        enableZSort=False,
    )
    wall = dict(geometryFile="box.obj", isDynamic=False, isWall=True, samplingMode=0)
    wall.update(translation=[0, 0, 0], scale=[1, 1, 1])
    block = dict(denseMode=0, start=[-spacing / 2] * 3, end=[1 + spacing / 2] * 3)
    block.update(translation=[0, 0, 0], scale=[1, 1, 1])
    water = dict(id="Fluid", density0=DENSITY, viscosityMethod=1, viscosity=0.01)
    path = os.path.join(folder, "scene.json")
    with open(path, "w") as file:
        json.dump(dict(Configuration=configuration, Materials=[water], RigidBodies=[wall], FluidBlocks=[block]), file)
    return path


def simulate(name, side, seed, gravity, out):
    """Runs a simulation, and writes its figures as numbers in JSON."""
    # The library of the package has a copy of this one, and the system's libraries that it loads as well need theirs.
    ctypes.CDLL("libGLdispatch.so.0", ctypes.RTLD_GLOBAL)
    import pysplishsplash as sph

    start, steps = positions(name, side, seed), 0
    speeds, errors = [], []
    with tempfile.TemporaryDirectory() as folder:
        base = sph.Exec.SimulatorBase()
        base.init(useGui=False, sceneFile=scene(folder, side, gravity), outputDir=folder, useCache=False)
        base.initSimulation()
        fluid = lambda: sph.Simulation.getCurrent().getFluidModel(0)

        def all_of(get):
            return numpy.array([get(i) for i in range(len(start))], dtype=float)

        def after_step():
            nonlocal steps
            model, steps = fluid(), steps + 1
            if steps == 1:
                assert model.numActiveParticles() == len(start)
                for i, place in enumerate(start):
                    model.setPosition(i, place)
                    model.setVelocity(i, numpy.zeros(3))
                    # The particles fill the unit cube.
                    model.setMass(i, DENSITY / len(start))
                method = sph.Simulation.getCurrent().getTimeStep()
                # The scene's value is not taken.
                method.setValueFloat(method.STIFFNESS, STIFFNESS)
                sph.TimeManager.getCurrent().setTimeStepSize(STEP)
            if steps == 2 or steps % LOOK == 0:
                look(model)

        def look(model):
            speeds.append(float(numpy.sqrt((all_of(model.getVelocity) ** 2).sum(1).mean())))
            errors.append(float(numpy.sqrt(((all_of(model.getDensity) / DENSITY - 1) ** 2).mean())))
            moved.append(float(numpy.sqrt(((all_of(model.getPosition) - start) ** 2).sum(1).mean())))

        moved = []
        base.setTimeStepCB(after_step)
        base.runSimulation()
    with open(out, "w") as file:
        json.dump(dict(first=errors[0], last=errors[-1], peak=max(speeds), end=speeds[-1], moved=moved[-1] * side), file)


def figures(side, seeds, gravity, name):
    """The means over some seeds; a grid has but one."""
    all = []
    for seed in range(1, (1 if name == "grid" else seeds) + 1):
        with tempfile.NamedTemporaryFile(suffix=".json") as out:
            arguments = ["--one", name, str(seed), str(gravity), out.name, "--side", str(side)]
            # One thread adds in one order.
            environment = dict(os.environ, OMP_NUM_THREADS="1")
            run = [sys.executable, os.path.abspath(__file__), *arguments]
            done = subprocess.run(run, env=environment, capture_output=True, text=True)
            if done.returncode:
                raise SystemExit(done.stderr or "SPlisHSPlasH ended with %d" % done.returncode)
            all.append(json.load(out))
    return {key: sum(one[key] for one in all) / len(all) for key in all[0]}


def page(side, seeds):
    print("## Fluid at rest\n")
    print(
        "A closed cube of fluid, 1 m wide, in SPlisHSPlasH %s (WCSPH, stiffness %g Pa, viscosity 0.01, steps of %g s), "
        "filled by %d particles at rest, with walls %g spacings of the grid from the outermost ones. Maximal and relaxed sets "
        "have exactly as many samples as the grid and none nearer to the faces than half a spacing; *relaxed* is the maximal set "
        "after at most %d steps. Sets of each kind, of which means are given: %d; one grid. *Error* is the root mean square of the excess of density, "
        "relative to that at rest, below which this solver does not let it fall; *speed* the root mean square of all particles, "
        "the highest and the last, after %g s, in m/s; *moved* their distance from their start then, in spacings.\n"
        % (version("pysplishsplash"), STIFFNESS, STEP, side**3, DISTANCE, RELAXATION, seeds, TIME)
    )
    print("| | set | error, first | error, last | speed, highest | speed, last | moved |")
    print("|---|---|---|---|---|---|---|")
    claims = []
    for case, gravity in CASES:
        rows = {name: figures(side, seeds, gravity, name) for name in SETS}
        for name, row in rows.items():
            figures_of_row = tuple(row[key] for key in ("first", "last", "peak", "end", "moved"))
            print("| %s | %s | " % (case, name) + "%.3f | %.3f | %.4f | %.4f | %.3f |" % figures_of_row)
        claims += [claim(case, rows, other) for other in ("maximal", "grid")]
    print("\nThat relaxed sets rest where others do not: the highest speed of the others is at least twice theirs.\n")
    print("\n".join(claims))


def claim(case, rows, other):
    relaxed, peak = rows["relaxed"]["peak"], rows[other]["peak"]
    verdict = "met" if peak >= 2 * relaxed else "**not met**"
    return "* %s, %s: %.4f m/s, relaxed %.4f m/s, %s" % (case, other, peak, relaxed, verdict)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--quick", action="store_true", help="few particles: to see the page, not to believe it")
    parser.add_argument("--side", type=int, help="particles in a row; by default 12")
    parser.add_argument("--one", nargs=4, metavar=("SET", "SEED", "GRAVITY", "OUT"), help="runs one simulation")
    parser.add_argument("--sets", type=int, default=3, help="sets of each kind; by default 3")
    arguments = parser.parse_args()
    side = arguments.side or (6 if arguments.quick else 12)
    if arguments.one:
        name, seed, gravity, out = arguments.one
        simulate(name, side, int(seed), float(gravity), out)
    else:
        page(side, 1 if arguments.quick else arguments.sets)


main()
