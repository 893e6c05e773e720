"""How calls behave: arrays, threads, progress, interrupts, forks, and what they refuse."""

import os
import signal
import subprocess
import sys
import threading
import time

import numpy as np
import pytest

import azulejo
from meshes import torus

LONG = dict(radius=0.0004)


def test_threads_change_nothing():
    one, four = (azulejo.kdrt_sample(0.003, seed=1, threads=threads) for threads in (1, 4))
    assert one.positions.tobytes() == four.positions.tobytes()


def test_arrays_of_any_layout_and_type_are_taken():
    xy = azulejo.kdrt_sample(0.05).positions
    expected = azulejo.plane_covering_radius(xy)
    wide = np.zeros((len(xy), 4), np.float32)
    wide[:, ::2] = xy
    unaligned = np.frombuffer(b"\0" + xy.tobytes(), np.uint8)[1:].view(np.float32).reshape(xy.shape)
    for same in (np.asfortranarray(xy), wide[:, ::2], xy.astype(float), xy.astype(">f4"), xy.tolist(), unaligned):
        assert azulejo.plane_covering_radius(same) == expected
    positions, indices = torus()
    for whole in (np.int64, np.int32, ">u4", np.uint16):
        assert (azulejo.Mesh(positions, indices.astype(whole)).indices == indices).all()
    assert len(azulejo.thin([], radius=1.0)) == 0


def test_results_outlive_what_made_them():
    positions = azulejo.kdrt_sample(0.01).positions
    copy = positions.copy()
    for seed in range(5):
        azulejo.kdrt_sample(0.01, seed=seed)
    assert (positions == copy).all() and positions.flags.writeable


def test_points_are_arrays():
    points = azulejo.kdrt_sample(0.1)
    assert np.asarray(points) is points.positions
    assert np.asarray(points, float).dtype == float
    assert "azulejo.Points" in repr(points)


def test_progress_grows_from_0_to_1():
    seen = []
    azulejo.kdrt_sample(0.002, progress=seen.append)
    assert seen[0] == 0 and seen[-1] == 1 and seen == sorted(seen)


@pytest.mark.parametrize("threads", [1, 2])
def test_progress_cancels(threads):
    with pytest.raises(azulejo.Cancelled):
        azulejo.kdrt_sample(**LONG, threads=threads, progress=lambda done: done < 0.1)
    with pytest.raises(ZeroDivisionError):
        azulejo.kdrt_sample(**LONG, threads=threads, progress=lambda done: 1 / 0)


def test_relaxation_that_is_cancelled_has_a_result():
    xy = azulejo.kdrt_sample(0.01).positions
    assert azulejo.dcr_relax(xy, progress=lambda done: False).report.stopped == "cancelled"
    classes = np.arange(len(xy)) % 2
    assert azulejo.dcr_relax_classes(xy, classes, progress=lambda done: False).report.stopped == "cancelled"
    with pytest.raises(ZeroDivisionError):
        azulejo.dcr_relax(xy, progress=lambda done: 1 / 0)


def test_a_stream_that_is_stopped():
    parts = []

    def stop(part):
        parts.append(part)
        return len(parts) < 2

    with pytest.raises(azulejo.Cancelled):
        azulejo.kdrt_stream(stop, **LONG)
    assert len(parts) == 2
    with pytest.raises(ZeroDivisionError):
        azulejo.kdrt_stream(lambda part: 1 / 0, **LONG)
    with pytest.raises(azulejo.Cancelled):
        azulejo.kdrt_stream(parts.append, **LONG, progress=lambda done: done < 0.1)


def test_a_growing_set_is_changed_by_one_call_at_a_time():
    growing = azulejo.Psp(MESH, 0.02)
    for call in (growing.points, growing.fill, lambda: growing.advance(1)):
        with pytest.raises(RuntimeError, match="in use"):
            growing.fill(progress=lambda done: call())
    with pytest.raises(azulejo.Cancelled):
        growing.fill(progress=lambda done: False)
    growing.fill()
    assert azulejo.mesh_coverage(MESH, growing.points().positions, 0.02 + 1e-6).gaps == 0


@pytest.mark.parametrize("threads", [1, 2])
def test_ctrl_c_interrupts_a_call(threads):
    # A parent in the background may have the signal ignored, which children inherit.
    program = f"""
import signal
import azulejo
signal.signal(signal.SIGINT, signal.default_int_handler)
print("ready", flush=True)
try:
    while True:
        azulejo.kdrt_sample(0.0003, threads={threads})
except KeyboardInterrupt:
    print("interrupted")
"""
    child = subprocess.Popen([sys.executable, "-c", program], stdout=subprocess.PIPE, text=True)
    try:
        assert child.stdout.readline() == "ready\n"
        time.sleep(0.3)
        child.send_signal(signal.SIGINT)
        assert child.communicate(timeout=60)[0] == "interrupted\n"
    finally:
        child.kill()


def test_numpy_comes_with_the_module():
    # Imported by the first call, it would panic where Ctrl-C interrupts the import, or where it is not installed.
    program = """
import sys
import azulejo
print("numpy" in sys.modules)
"""
    assert subprocess.run([sys.executable, "-c", program], capture_output=True, text=True).stdout == "True\n"
    program = """
import sys
sys.modules["numpy"] = None
try:
    import azulejo
except ImportError:
    print("refused")
"""
    assert subprocess.run([sys.executable, "-c", program], capture_output=True, text=True).stdout == "refused\n"


def test_other_threads_run_on():
    done = threading.Event()
    counted = 0

    def count():
        nonlocal counted
        while not done.is_set():
            counted += 1
            time.sleep(0.001)

    thread = threading.Thread(target=count)
    thread.start()
    before = counted
    azulejo.kdrt_sample(**LONG, threads=1)
    during = counted - before
    done.set()
    thread.join()
    assert during > 10


def test_several_threads_call_at_once():
    sets = {}

    def sample(i):
        sets[i] = azulejo.kdrt_sample(0.005, seed=i % 2).positions.tobytes()

    threads = [threading.Thread(target=sample, args=(i,)) for i in range(6)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(sets) == 6 and len(set(sets.values())) == 2


def test_a_forked_process_has_threads_of_its_own():
    expected = azulejo.kdrt_sample(0.01, threads=3).positions.tobytes()
    child = os.fork()
    if child == 0:
        os._exit(0 if azulejo.kdrt_sample(0.01, threads=3).positions.tobytes() == expected else 1)
    assert os.waitpid(child, 0)[1] == 0
    assert azulejo.kdrt_sample(0.01, threads=3).positions.tobytes() == expected


MESH = azulejo.Mesh(*torus())
XY = np.full((3, 2), 0.5, np.float32)


@pytest.mark.parametrize(
    "call, error, named",
    [
        (lambda: azulejo.kdrt_sample(-0.1), ValueError, "radius"),
        (lambda: azulejo.kdrt_sample(float("nan")), ValueError, "radius"),
        (lambda: azulejo.kdrt_sample(), ValueError, "radius"),
        (lambda: azulejo.kdrt_sample("a"), TypeError, "radius"),
        (lambda: azulejo.kdrt_sample(1e-9), MemoryError, "radius"),
        (lambda: azulejo.kdrt_sample(0.1, count=3), ValueError, "count"),
        (lambda: azulejo.kdrt_sample(count=-1), ValueError, "count"),
        (lambda: azulejo.kdrt_sample(count=5, given_positions=XY), ValueError, "given_positions"),
        (lambda: azulejo.kdrt_sample(0.1, seed=-1), ValueError, "seed"),
        (lambda: azulejo.kdrt_sample(0.1, seed=2**64), ValueError, "seed"),
        (lambda: azulejo.kdrt_sample(0.1, threads=100000), ValueError, "^threads"),
        (lambda: azulejo.kdrt_sample(0.1, boundary="torus"), ValueError, "boundary"),
        (lambda: azulejo.kdrt_sample(0.1, order="random"), ValueError, "order"),
        (lambda: azulejo.kdrt_sample(0.1, quotient=1.2), ValueError, "quotient"),
        (lambda: azulejo.kdrt_sample(0.1, leaf_size=1.0), ValueError, "leaf_size"),
        (lambda: azulejo.kdrt_sample(0.1, domain_max=(0.0, 1.0)), ValueError, "domain_max"),
        (lambda: azulejo.kdrt_sample(0.1, domain_max=(1.0, 1.0, 1.0)), ValueError, "domain_max"),
        (lambda: azulejo.kdrt_sample(0.1, domain_max=3.0), TypeError, "domain_max"),
        (lambda: azulejo.kdrt_sample(0.1, given_positions=np.zeros((2, 3))), ValueError, "given_positions"),
        (lambda: azulejo.kdrt_sample(0.1, given_positions=[[1, 2], [3]]), ValueError, "given_positions"),
        (lambda: azulejo.kdrt_sample(0.1, given_positions=[["a", "b"]]), TypeError, "given_positions"),
        (lambda: azulejo.kdrt_sample(0.1, given_positions=XY * np.nan), ValueError, "given_positions"),
        (lambda: azulejo.kdrt_sample(0.1, given_positions=XY + 1j), TypeError, "given_positions"),
        (lambda: azulejo.kdrt_sample(0.1, given_positions=XY, given_clearances=[1]), ValueError, "given_clearances"),
        (lambda: azulejo.kdrt_sample(0.1, given_positions=XY, given_clearances=[1, -1, 1]), ValueError, "clearances"),
        (lambda: azulejo.kdrt_sample_classes(np.eye(3)[:2]), ValueError, "radii"),
        (lambda: azulejo.kdrt_sample_classes([[1, 2], [3, 1]]), ValueError, "radii"),
        (lambda: azulejo.classes_radii([]), ValueError, "^own: 0 classes"),
        (lambda: azulejo.Mesh(np.zeros((3, 2)), [[0, 1, 2]]), ValueError, "positions"),
        (lambda: azulejo.Mesh(np.eye(3), [[0, 1, 3]]), ValueError, "indices"),
        (lambda: azulejo.Mesh(np.eye(3), [[0, 1, -1]]), ValueError, "indices"),
        (lambda: azulejo.Mesh(np.eye(3), [[0.0, 1.0, 2.0]]), TypeError, "indices"),
        (lambda: azulejo.Mesh(np.full((3, 3), np.inf), [[0, 1, 2]]), ValueError, "positions"),
        (lambda: azulejo.Mesh(np.eye(3), [[0, 1, 2]], mask=[True, False]), ValueError, "mask"),
        (lambda: azulejo.Mesh(np.eye(3), [[0, 1, 2]], mask=[1]), TypeError, "mask"),
        (lambda: azulejo.Mesh(np.eye(3), [[0, 1, 2]], normal_indices=[[0, 1, 2]]), ValueError, "normal_indices"),
        (lambda: azulejo.psp_sample(None, 0.1), TypeError, "mesh"),
        (lambda: azulejo.psp_sample(MESH, 0.1, priority="x"), ValueError, "priority"),
        (lambda: azulejo.psp_sample(MESH, 0.1, projectors="x"), ValueError, "projectors"),
        (lambda: azulejo.psp_sample(MESH, 0.1, cosine=2), ValueError, "cosine"),
        (lambda: azulejo.psp_adaptive_sample(MESH, [0.1]), ValueError, "^vertex_radii: 1 "),
        (lambda: azulejo.psp_adaptive_with_density(MESH, [0.1], count=9), ValueError, "^density: 1 "),
        (lambda: azulejo.volume_adaptive_sample([0.1, 0.2]), ValueError, r"^grid_values: its shape is \[2\]"),
        (lambda: azulejo.volume_adaptive_sample([[[0.1, -1]]]), ValueError, r"^grid_values: \[1\] is -1"),
        (lambda: azulejo.volume_adaptive_sample([[[0.1]]], tolerance=0.1), ValueError, "^tolerance"),
        (lambda: azulejo.volume_adaptive_sample([[[0.1]]], mesh=MESH, boundary="bounded"), ValueError, "^boundary"),
        (lambda: azulejo.psp_sample(MESH), ValueError, "^radius: 0, and so is count: give one"),
        (lambda: azulejo.psp_sample(MESH, 1000), ValueError, "^radius: 1000.0 is more than .* count=1000$"),
        (lambda: azulejo.kdrt_sample(1000), ValueError, "^radius: .* count=1000$"),
        (lambda: azulejo.kdrt_sample(float("inf")), ValueError, "^radius"),
        (lambda: azulejo.psp_sample(MESH, "x"), TypeError, "^radius: 'x' is not a real number"),
        (lambda: azulejo.psp_sample(MESH, count=1e3), TypeError, r"^count: 1000.0 is not a whole number \(an int\)"),
        (lambda: azulejo.kdrt_sample(count=2**200), ValueError, r"^count: 160.*\.\.\. is out of range"),
        (lambda: azulejo.kdrt_sample(0.1, progress=3), TypeError, "^progress: 3 is not callable"),
        (lambda: azulejo.psp_sample(MESH, 0.5, maximal="x"), TypeError, "^maximal: 'x' is not True or False"),
        (lambda: azulejo.psp_adaptive_with_density(MESH, np.ones(MESH.vertex_count), count=1e15), ValueError, "^count: "),
        (lambda: azulejo.Mesh(None, [[0, 1, 2]]), TypeError, "^positions: None is no array"),
        (lambda: azulejo.Spectrum.mean([]), ValueError, "^spectra"),
        (lambda: azulejo.Differences.mean([]), ValueError, "^differences"),
        (lambda: azulejo.dcr_scatter(np.ones((0, 4)), 10), ValueError, r"^density: its shape is \[0, 4\]"),
        (lambda: azulejo.mesh_uncovered_fraction(MESH, [[9, 9, 9]], 0.1, probes=0), ValueError, "^probes: 0"),
        (lambda: MESH.points([0], [[2, 2]]), ValueError, r"^barycentrics: \[0\] is \(2, 2\), outside the triangle"),
        (lambda: azulejo.psp_adaptive_with_density(MESH, np.ones(MESH.vertex_count)), ValueError, "radius"),
        (lambda: azulejo.psp_adaptive_with_density(MESH, np.ones((2, 2)), count=9), ValueError, "density"),
        (lambda: azulejo.dcr_relax([[2.0, 0.0]]), ValueError, "positions"),
        (lambda: azulejo.dcr_relax(XY, step=0.1), ValueError, "step"),
        (lambda: azulejo.dcr_relax(XY, method="thesis", step=7.0), ValueError, "step"),
        (lambda: azulejo.dcr_relax(XY, tolerance=-1), ValueError, "tolerance"),
        (lambda: azulejo.dcr_relax_density(XY, np.zeros(4)), ValueError, "density"),
        (lambda: azulejo.dcr_surface_relax(MESH, [99999999], [[0, 0]]), ValueError, "triangles"),
        (lambda: azulejo.dcr_relax_classes(XY, [0, 1]), ValueError, "classes"),
        (lambda: azulejo.dcr_relax_classes(XY, [0, 1, 16]), ValueError, "classes"),
        (lambda: azulejo.dcr_relax_classes(XY, [0.0, 1.0, 1.0]), TypeError, "classes"),
        (lambda: azulejo.dcr_remesh(MESH, [0], [[0.2, 0.2]]), ValueError, "triangles"),
        (lambda: azulejo.dcr_remesh(MESH, [0, 1], [[0.2, 0.2]]), ValueError, "barycentrics"),
        (lambda: azulejo.kdrt_stream(None, 0.1), TypeError, "^visit: None is not callable"),
        (lambda: azulejo.kdrt_stream(print, 0.0), ValueError, "radius"),
        (lambda: azulejo.Psp(MESH, 0.0), ValueError, "radius"),
        (lambda: azulejo.Psp(MESH, 0.1, seed=-1), ValueError, "seed"),
        (lambda: azulejo.Psp(MESH, 0.1).advance(-1), ValueError, "iterations"),
        (lambda: azulejo.Psp(MESH, 0.1, cosine=0.5).advance(1), ValueError, "cosine"),
        (lambda: azulejo.thin(np.zeros((3, 4)), radius=1), ValueError, "positions"),
        (lambda: azulejo.thin(XY), ValueError, "radius"),
        (lambda: azulejo.plane_coverage(XY, 0.0), ValueError, "radius"),
        (lambda: azulejo.space_coverage(np.zeros((2, 3)), 0.0), ValueError, "radius"),
        (lambda: azulejo.space_measure(np.zeros((2, 3)), -1.0), ValueError, "radius"),
        (lambda: azulejo.space_measure(np.ones((2, 3))), ValueError, "positions"),
        (lambda: azulejo.space_spectrum(np.zeros((2, 3)), 0.0), ValueError, "frequency_reach"),
        (lambda: azulejo.space_spectrum(np.zeros((2, 3)), 1.0, 0), ValueError, "frequency_stride"),
        (lambda: azulejo.space_spectrum(np.zeros((2, 3)), 1.0, width=0.0), ValueError, "width"),
        (lambda: azulejo.space_axis_power(np.zeros((2, 3)), 3, 5), ValueError, "axis"),
        (lambda: azulejo.space_axis_power(np.zeros((2, 3)), 0, 0), ValueError, "count"),
        (lambda: azulejo.space_radial_distribution(np.zeros((2, 3)), 9.0, 5), ValueError, "reach"),
        (lambda: azulejo.plane_nearest_histogram(XY, 1.0, 0), ValueError, "bins"),
        (lambda: azulejo.Spectrum(XY, 1), ValueError, "size"),
    ],
)
def test_what_is_refused_is_named(call, error, named):
    with pytest.raises(error, match=named):
        call()


def test_a_file_that_is_not_there_is_named_once():
    with pytest.raises(FileNotFoundError) as error:
        azulejo.Mesh.load("nope.ply")
    assert str(error.value) == "[Errno 2] No such file or directory: 'nope.ply'"


def test_none_is_no_radius_and_no_count():
    points = azulejo.psp_sample(MESH, None, count=50)
    assert len(points) == 50 and (points.positions == azulejo.psp_sample(MESH, count=50).positions).all()
    assert len(azulejo.psp_sample(MESH, 0.5, count=None)) > 1


def test_defaults_are_those_of_the_docs():
    expected = azulejo.kdrt_sample(0.05).positions
    assert (azulejo.kdrt_sample(0.05, domain_min=(0, 0), domain_max=(1, 1)).positions == expected).all()
    expected = azulejo.psp_sample(MESH, 0.2).positions
    assert (azulejo.psp_sample(MESH, 0.2, cosine=-1).positions == expected).all()
