"""Blue-noise masks of azulejo, published ones, and those of other generators: masks.py --page docs/masks.md --place FOLDER [--quick]

Measures the patterns of their thresholds and the time to make them, and writes the page and its picture. Needs numpy, pillow
and azulejo, and in the folder what masks.sh puts there.
"""

import argparse
import datetime
import resource
import struct
import subprocess
import time
from collections.abc import Callable
from importlib.metadata import version
from pathlib import Path
from typing import NamedTuple

import azulejo
import numpy
from numpy.typing import NDArray
from PIL import Image

# The first line of the page.
SUBJECT = (
    "Blue-noise masks of azulejo beside published ones and those of other generators: the power of their thresholds at low "
    "frequencies, the error of a dithered grey, and the time to make them."
)
LEVELS = 256
SHARES = (8, 32, 64, 128, 192, 224)
GREYS = range(16, LEVELS, 16)
# Standard deviation of the eye's blur, in pixels.
BLUR = 2.0
SIZE = 128
GOALS = {(256, 256, 1): 1.0, (1024, 1024, 1): 30.0}

Mask = NDArray[numpy.int64]


class Method(NamedTuple):
    name: str
    # Masks of so many pixels a side, as levels from 0 to 255.
    masks: list[Mask]
    # Milliseconds of the processor by the side of the mask; none of published ones.
    times: dict[int, float]


def levels(ranks: NDArray[numpy.uint32]) -> Mask:
    return ranks.astype(numpy.int64) * LEVELS // ranks.size


def of_azulejo(sigma: float, sizes: list[int], seeds: int) -> Method:
    masks = [levels(azulejo.mask_create(SIZE, SIZE, seed=seed, sigma=sigma)) for seed in range(seeds)]
    times = {}
    for size in sizes:
        start = time.process_time()
        azulejo.mask_create(size, size, sigma=sigma, threads=1)
        times[size] = (time.process_time() - start) * 1e3
    return Method(f"**azulejo**, sigma {sigma:g}", masks, times)


def of_crate(place: Path, sizes: list[int], seeds: int) -> Method:
    def make(size: int, seed: int) -> Mask:
        out = place / "mask.png"
        subprocess.run(
            [place / "cargo/bin/blue-noise", "generate", "--size", str(size), "--seed", str(seed), "--output", out],
            check=True,
            capture_output=True,
        )
        return numpy.asarray(Image.open(out).convert("L")).astype(numpy.int64)

    times = {}
    for size in sizes:
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        make(size, 0)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        times[size] = (after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime) * 1e3
    return Method("crate blue-noise 0.2.2, sigma 1.9", [make(SIZE, seed) for seed in range(seeds)], times)


def of_node(place: Path, what: str) -> tuple[bytes, str]:
    out = place / "mask.bytes"
    command = ["node", Path(__file__).with_name("masks.mjs"), (place / "npm").resolve(), what, out]
    said = subprocess.run(command, check=True, capture_output=True, text=True)
    return out.read_bytes(), said.stdout


def of_pathtracer(place: Path, sizes: list[int], seeds: int) -> Method:
    def make(size: int) -> tuple[Mask, float]:
        data, said = of_node(place, str(size))
        return levels(numpy.frombuffer(data, numpy.uint32).reshape(size, size)), float(said)

    times = {size: make(size)[1] for size in sizes}
    return Method("three-gpu-pathtracer 0.0.26, sigma 1.5", [make(SIZE)[0] for _ in range(seeds)], times)


def of_n8ao(place: Path) -> Method:
    channels = numpy.frombuffer(of_node(place, "texture")[0], numpy.uint8).reshape(128, 128, 4)
    return Method("texture of n8ao 2.1.0, 128 × 128", [channels[:, :, k].astype(numpy.int64) for k in range(4)], {})


def of_bevy(place: Path, count: int) -> Method:
    """Some slices of the spatiotemporal blue noise in bevy_pbr, of their first channel: a KTX 2 file with one level, not packed."""
    data = (place / "bevy_pbr-0.20.1/src/bluenoise/stbn.ktx2").read_bytes()
    width, height, depth, layers = struct.unpack_from("<4I", data, 20)
    offset, length = struct.unpack_from("<2Q", data, 80)
    slices = numpy.frombuffer(data[offset : offset + length], numpy.uint8).reshape(max(depth, layers), height, width, -1)[:count, :, :, 0]
    name = f"spatiotemporal blue noise of bevy_pbr 0.20.1, {width} × {height}"
    return Method(name, [one.astype(numpy.int64) for one in slices], {})


def frequencies(size: int) -> NDArray[numpy.float64]:
    along = numpy.fft.fftfreq(size)
    return numpy.hypot(along[:, None], along[None, :])


def power(values: NDArray[numpy.float64]) -> NDArray[numpy.float64]:
    """The periodogram, where that of independent pixels of the same variance is 1."""
    centred = values - values.mean()
    return numpy.abs(numpy.fft.fft2(centred)) ** 2 / (centred**2).sum()


def low_power(mask: Mask, share: int) -> float:
    """The mean power of a threshold at frequencies up to half of the principal one."""
    pattern = (mask < share).astype(float)
    density = share / LEVELS
    principal = min(min(density, 1 - density) ** 0.5, 0.5)
    at = frequencies(len(mask))
    return float(power(pattern)[(at > 0) & (at <= principal / 2)].mean())


def dither_error(mask: Mask) -> float:
    """The root mean square error of flat greys after a blur, over that of independent thresholds."""
    response = numpy.exp(-2 * (numpy.pi * BLUR * frequencies(len(mask))) ** 2)
    own = independent = 0.0
    for grey in GREYS:
        pattern = (mask < grey).astype(float) - grey / LEVELS
        seen = numpy.fft.ifft2(numpy.fft.fft2(pattern) * response).real
        own += float((seen**2).mean())
        independent += grey / LEVELS * (1 - grey / LEVELS) * float((response**2).mean())
    return (own / independent) ** 0.5


def row(method: Method, figures: list[float], sizes: list[int]) -> str:
    times = [f"{method.times[size]:,.0f}" if size in method.times else "" for size in sizes]
    return f"| {method.name} | {' | '.join(f'{figure:.3f}' for figure in figures)} | {' | '.join(times)} |"


def sheet(methods: list[Method], path: Path) -> None:
    """The spectra of the masks, from 0 to 2, side by side; the frequency 0 is in the middle."""
    gap, side = 6, SIZE
    image = numpy.full((side, len(methods) * (side + gap) - gap), 255.0)
    for number, method in enumerate(methods):
        mean = numpy.mean([power(mask.astype(float)) for mask in method.masks], axis=0)
        spectrum = numpy.fft.fftshift(mean).repeat(side // len(mean), 0).repeat(side // len(mean), 1)
        image[:, number * (side + gap) : number * (side + gap) + side] = numpy.clip(spectrum / 2, 0, 1) * 255
    path.parent.mkdir(exist_ok=True)
    Image.fromarray((image / 16).round().clip(0, 15).astype(numpy.uint8) * 17).quantize(16).save(path, optimize=True)


def processor() -> str:
    lines = Path("/proc/cpuinfo").read_text().splitlines()
    return next((line.split(": ")[1] for line in lines if line.startswith("model name")), "an unknown processor")


def goals() -> str:
    said = []
    for (width, height, depth), goal in GOALS.items():
        start = time.perf_counter()
        azulejo.mask_create(width, height, depth=depth, threads=2)
        seconds = time.perf_counter() - start
        verdict = "met" if seconds <= goal else "**not met**"
        said.append(f"{width:,} × {height:,} in {seconds:.2f} s (within {goal:g}: {verdict})")
    return "; ".join(said)


def text(page: Path, place: Path, quick: bool) -> str:
    sizes, seeds = ([64], 1) if quick else ([64, 128, 256], 4)
    makers: list[Callable[[], Method]] = [
        lambda: of_azulejo(1.5, sizes, seeds),
        lambda: of_azulejo(1.9, sizes, seeds),
        lambda: of_crate(place, sizes, seeds),
        lambda: of_pathtracer(place, sizes, seeds),
        lambda: of_n8ao(place),
        lambda: of_bevy(place, 8),
    ]
    methods = [make() for make in makers]
    measures = [lambda mask, share=share: low_power(mask, share) for share in SHARES] + [dither_error]
    figures = [[float(numpy.mean([measure(mask) for mask in method.masks])) for measure in measures] for method in methods]
    columns = [f"{share / LEVELS:.3g}" for share in SHARES] + ["dither error"]
    best = [methods[int(numpy.argmin(column))].name for column in numpy.transpose(figures)]
    others = [f"{name} ({column})" for name, column in zip(best, columns) if "azulejo" not in name]
    picture = page.parent / "masks" / "spectra.png"
    sheet(methods, picture)
    lines = [
        "# Blue-noise masks, measured",
        "",
        SUBJECT,
        "",
        f"Written by `studies/peers/masks.sh{' --quick' if quick else ''}` on {datetime.datetime.now(datetime.timezone.utc).date()} on "
        f"{processor()}, with azulejo-sampling {version('azulejo-sampling')}. Best where azulejo is not: {'; '.join(others) or 'none'}. "
        f"Goals, on two threads: {goals()}.",
        "",
        f"![Spectra of the masks](masks/{picture.name})",
        "",
        "Spectra of the masks in the order of the table, means over their masks; white is twice the power of independent pixels.",
        "",
        f"All masks as {LEVELS} levels, means of {seeds} masks of {SIZE} × {SIZE}, of the 4 channels of n8ao's and of 8 slices of "
        "bevy_pbr's. *Thresholds*: mean power of the pixels below a level, by the share that these are, at frequencies up to half of the "
        "principal one (the square root of that share or of the rest, at most half a cycle per pixel), where that of independent pixels is "
        f"1. *Dither error*: root mean square of flat greys after a Gaussian blur of {BLUR:g} pixels, over that of independent thresholds. "
        "Less is better. *ms* are of the processor, for a mask of so many pixels a side; published masks are not made here. Those of "
        "bevy_pbr are blue noise in time, too, which azulejo's are not and which costs them in each slice.",
        "",
        f"| | {' | '.join(columns)} | {' | '.join(f'ms, {size}²' for size in sizes)} |",
        f"|---|{'---|' * (len(columns) + len(sizes))}",
        *(row(method, of_one, sizes) for method, of_one in zip(methods, figures)),
    ]
    return "\n".join(lines) + "\n"


def main() -> None:
    parser = argparse.ArgumentParser()
    parser.add_argument("--page", type=Path, required=True, help="the page to write")
    parser.add_argument("--place", type=Path, required=True, help="the folder of what others have made")
    parser.add_argument("--quick", action="store_true", help="one small mask of each: to see the page, not to believe it")
    arguments = parser.parse_args()
    arguments.page.write_text(text(arguments.page, arguments.place, arguments.quick))


main()
