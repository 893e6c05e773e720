"""Depth of field, soft shadows and motion blur in Mitsuba 3, by azulejo's sets and by what renderers sample with:
render.py --page docs/rendering.md [--quick]

Writes the page and its picture, in a folder beside it. Needs mitsuba, scipy, pillow, numpy and azulejo, and an LLVM.
"""

import argparse
import datetime
import math
import os
import sys
from collections.abc import Iterable
from importlib.metadata import version
from pathlib import Path
from typing import NamedTuple

import numpy
import patterns
import scenes
from numpy.typing import NDArray
from patterns import METHODS, MOVED, OWN, RANDOM, USUAL, Method
from PIL import Image
from scipy import stats

# The first line of the page.
SUBJECT = (
    "Depth of field, soft shadows and motion blur in Mitsuba 3, sampled by sets of azulejo and by random, stratified, Sobol and "
    "Halton points: errors at equal counts."
)
LEVEL = 0.01
# The number of samples whose pictures are shown, by which methods, and how large a part of each: pixels and their size.
SHOWN = 16
IN_PICTURE = [RANDOM, *USUAL, *OWN]
CROP, SCALE, MARGIN = (48, 40), 4, 6
# Where the part begins, in shares of what it leaves of the picture.
PLACES = {
    "depth of field": (0.4, 0.5),
    "soft shadows": (0.5, 0.5),
    "motion blur": (0.6, 0.6),
    "motion blur in the pixel": (0.6, 0.6),
}
GREYS = 64


class Effort(NamedTuple):
    size: tuple[int, int]
    seeds: int
    counts: tuple[int, ...]
    reference: int


FULL = Effort((96, 64), 20, (4, 16, 64), 16384)
QUICK = Effort((48, 40), 2, (4, 16), 1024)


class Mean(NamedTuple):
    mean: float
    error: float
    count: int

    @staticmethod
    def of(values: list[float]) -> "Mean":
        return Mean(float(numpy.mean(values)), float(stats.sem(values)), len(values))

    def above(self, other: "Mean") -> tuple[float, float]:
        """The excess over another in standard errors, and the degrees of freedom (Welch 1947)."""
        own, others = self.error**2, other.error**2
        freedom = (own + others) ** 2 / (own**2 / (self.count - 1) + others**2 / (other.count - 1))
        return (self.mean - other.mean) / math.sqrt(own + others), freedom


class Claim(NamedTuple):
    what: str
    low: Mean
    high: Mean

    def chance(self, sign: int) -> float:
        t, freedom = self.high.above(self.low)
        return float(stats.t.sf(sign * t, freedom))


class Measured(NamedTuple):
    """An effect's picture, and the errors by method and number of samples, relative to the picture's mean."""

    effect: scenes.Effect
    reference: NDArray[numpy.float64]
    # The reference's own error, relative to the same.
    uncertainty: float
    errors: dict[tuple[str, int], Mean]
    shown: list[NDArray[numpy.float64]]


def root_mean_square(values: NDArray[numpy.float64]) -> float:
    return float(numpy.sqrt(numpy.mean(values**2)))


def measure(place: int, effect: scenes.Effect, effort: Effort) -> Measured:
    picture = scenes.Picture(effect, effort.size)

    def render(pattern: patterns.Pattern, count: int, *seed: int) -> NDArray[numpy.float64]:
        generator = numpy.random.default_rng([place, count, *seed])
        return picture.render(count, lambda pixels: pattern(generator, pixels, count, effect.dimensions))

    # The second one tells the error of the first.
    reference, second = (render(patterns.stratified, effort.reference, number) for number in range(2))
    scale = float(reference.mean())
    uncertainty = root_mean_square(reference - second) / math.sqrt(2) / scale
    errors, shown = {}, []
    for index, method in enumerate(METHODS):
        for count in effort.counts:
            found = [render(method.pattern, count, index, seed) for seed in range(effort.seeds)]
            errors[method.name, count] = Mean.of([root_mean_square(one - reference) / scale for one in found])
            if count == SHOWN and method in IN_PICTURE:
                shown.append(found[0])
        print(f"{effect.name}: {method.name}", file=sys.stderr)
    return Measured(effect, reference, uncertainty, errors, shown)


def rounded(value: float, digits: int) -> str:
    mantissa, *power = f"{value:.{digits}g}".split("e")
    return mantissa + "".join(f"e{int(number)}" for number in power)


def table(effort: Effort, one: Measured) -> list[str]:
    lines = [f"| {one.effect.name} | " + " | ".join(map(str, effort.counts)) + " |", "|---|" + "---|" * len(effort.counts)]
    for method in METHODS:
        cells = [one.errors[method.name, count] for count in effort.counts]
        lines.append(f"| {method.name} | " + " | ".join(f"{rounded(c.mean, 4)} ± {rounded(c.error, 1)}" for c in cells) + " |")
    return [*lines, ""]


def cases(effort: Effort, all: list[Measured], usual: Method) -> list[Claim]:
    """That a usual pattern has a smaller error than the better of azulejo's sets, for each effect and number of samples."""
    found = []
    for one in all:
        for count in effort.counts:
            better = min(OWN, key=lambda method: one.errors[method.name, count].mean)
            names = f"{usual.name} below {better.name}"
            what = f"{one.effect.name}, {count} samples: {names}"
            found.append(Claim(what, one.errors[usual.name, count], one.errors[better.name, count]))
    return found


def corrected(chances: list[float]) -> list[float]:
    """By the number of tests (Holm 1979)."""
    found, largest = [0.0] * len(chances), 0.0
    for rank, i in enumerate(sorted(range(len(chances)), key=chances.__getitem__)):
        largest = max(largest, min((len(chances) - rank) * chances[i], 1.0))
        found[i] = largest
    return found


def judged(claims: list[Claim]) -> list[tuple[float, str]]:
    own, opposite = (corrected([claim.chance(sign) for claim in claims]) for sign in (1, -1))
    verdicts = []
    for chance, other in zip(own, opposite):
        verdicts.append((chance, "met" if chance <= LEVEL else "**not met**" if other <= LEVEL else "not decided"))
    return verdicts


def claims_table(claims: list[Claim], verdicts: list[tuple[float, str]]) -> list[str]:
    lines = [
        "## Claims",
        "",
        "That one mean is *below* another: ± is the standard error, *n* the number of seeds, *t* the difference over its standard "
        "error (Welch), *p* the chance of as large a one where there is none, corrected for all "
        f"{len(claims)} claims of the table (Holm). A claim is met where p is at most {LEVEL}, not met where that of the opposite "
        "is, corrected in the same way, and otherwise not decided.",
        "",
        "| claim | below | n | above | n | t | p | |",
        "|---|---|---|---|---|---|---|---|",
    ]
    for claim, (p, verdict) in zip(claims, verdicts):
        cells = [f"{rounded(mean.mean, 5)} ± {rounded(mean.error, 2)} | {mean.count}" for mean in (claim.low, claim.high)]
        t, _ = claim.high.above(claim.low)
        chance = "< 1e-6" if p < 1e-6 else rounded(p, 2) if p < 0.01 else rounded(p, 3)
        lines.append(f"| {claim.what} | {' | '.join(cells)} | {t:+.1f} | {chance} | {verdict} |")
    return [*lines, ""]


def tone(luminance: NDArray[numpy.float64], white: float) -> NDArray[numpy.uint8]:
    """Steps of grey, by the gamma of screens."""
    return numpy.rint((luminance / white).clip(0, 1) ** (1 / 2.2) * (GREYS - 1)).astype(numpy.uint8)


def cropped(one: Measured, picture: NDArray[numpy.float64], size: tuple[int, int]) -> NDArray[numpy.uint8]:
    """The part of a picture that is shown, magnified."""
    left, top = (round(share * (whole - own)) for share, whole, own in zip(PLACES[one.effect.name], size, CROP))
    steps = tone(picture.reshape(size[1], size[0]), float(numpy.quantile(one.reference, 0.995)))
    shown = steps[top : top + CROP[1], left : left + CROP[0]]
    return shown.repeat(SCALE, axis=0).repeat(SCALE, axis=1)


def draw(path: Path, size: tuple[int, int], all: list[Measured]) -> None:
    """A row for each effect: the reference, and the methods by turns."""
    rows = [[cropped(one, picture, size) for picture in (one.reference, *one.shown)] for one in all]
    height, width = rows[0][0].shape
    sheet = numpy.full((len(rows) * (height + MARGIN) - MARGIN, len(rows[0]) * (width + MARGIN) - MARGIN), GREYS - 1, numpy.uint8)
    for i, row in enumerate(rows):
        for k, shown in enumerate(row):
            top, left = i * (height + MARGIN), k * (width + MARGIN)
            sheet[top : top + height, left : left + width] = shown
    image = Image.fromarray(sheet, "P")
    image.putpalette([round(255 * step / (GREYS - 1)) for step in range(GREYS) for _ in range(3)])
    path.parent.mkdir(parents=True, exist_ok=True)
    image.save(path, optimize=True)


def processor() -> str:
    lines = Path("/proc/cpuinfo").read_text().splitlines()
    return next((line.split(": ")[1] for line in lines if line.startswith("model name")), "an unknown processor")


def score(claims: Iterable[tuple[Claim, tuple[float, str]]]) -> str:
    verdicts = [verdict for _, (_, verdict) in claims]
    return f"{verdicts.count('met')} of {len(verdicts)} cases, and a larger one in {verdicts.count('**not met**')}"


def layers(effort: Effort) -> str:
    """How many times relaxed sets of the cube have."""
    few = [count for count in effort.counts if count < patterns.LARGEST]
    times = [numpy.sort(patterns.relaxed(count, 3, 1).positions[:, 2]) for count in few]
    found = [int((numpy.diff(of_set) > 0.05).sum()) + 1 for of_set in times]
    counts, of_sets = (" and ".join(map(str, numbers)) for numbers in (few, found))
    found_of_one = f"{counts} of them, of one seed, have but {of_sets} times, 0.05 or more apart"
    return f"Few relaxed samples of the cube make a lattice along its axes: {found_of_one}."


def text(effort: Effort, quick: bool, all: list[Measured]) -> str:
    claims = [cases(effort, all, usual) for usual in [RANDOM, *USUAL, *MOVED]]
    verdicts = judged([claim for part in claims for claim in part])
    scores, first = [], 0
    for part in claims:
        scores.append(score(zip(part, verdicts[first:])))
        first += len(part)
    of_random, of_stratified, of_sobol, of_halton, *of_moved = scores
    date = datetime.datetime.now(datetime.timezone.utc).date()
    lines = [
        "# Rendering, measured",
        "",
        SUBJECT,
        "",
        f"Written by `studies/peers/render.sh{' --quick' if quick else ''}` on {date}, on {os.cpu_count()} threads of {processor()}, "
        f"with Mitsuba {version('mitsuba')}, scipy {version('scipy')} and azulejo {version('azulejo-sampling')}. Owen-scrambled Sobol "
        "samples render depth of field, soft shadows and motion blur with a smaller error than the better of the maximal and relaxed "
        f"sets of azulejo in {of_sobol}; stratified ones in {of_stratified}; Halton's in {of_halton}; random ones in {of_random}. "
        "[What the sets are for](integrating.md#samples-of-pixels); [pixels.md](pixels.md) has the same for functions whose means are "
        "known.",
        "",
        f"Pictures of {effort.size[0]} by {effort.size[1]} pixels with light straight from one lamp, by Mitsuba's cameras, shapes, "
        "materials and lamps, which `studies/peers/scenes.py` calls with the samples of a pixel. Only what is listed is sampled; else a "
        "pixel is seen through its centre, at the middle of the shutter's time.",
        "",
        *(f"* *{one.effect.name[0].upper()}{one.effect.name[1:]}*: {one.effect.about}." for one in all),
        "",
        "*Random* samples are independent. *Stratified* ones lie anywhere in as many intervals or squares; place and time have strata "
        "of their own, paired at random. *Sobol*'s and *Halton*'s sequences are scrambled anew in each pixel (Owen 1995). *Moved* says "
        f"that each pixel has one of {patterns.POOL} sets of its picture, moved along the torus at random; azulejo's have no other way, "
        "and the others are given the same besides. *Maximal* and *relaxed* sets have exactly as many samples, of the square or the "
        "cube; azulejo has none of one dimension, where they are the first coordinates of those of the square. "
        f"*First of {patterns.LARGEST}* are those of one maximal set. {layers(effort)} How errors are distributed over the picture, which "
        "the eye sees, is not measured.",
        "",
        "## Errors",
        "",
        f"Root mean squares over a picture, relative to its mean; means of {effort.seeds} seeds ± their standard errors, by samples of a "
        f"pixel. The reference has {effort.reference:,} stratified samples of each pixel; its own error, from a second one, is "
        + ", ".join(f"{rounded(one.uncertainty, 2)} ({one.effect.name})" for one in all)
        + ".",
        "",
    ]
    for one in all:
        lines += table(effort, one)
    lines += [
        "In claims as below, of the usual samples when they are moved like the sets: stratified ones have a smaller error in "
        f"{of_moved[0]}; Sobol's in {of_moved[1]}; Halton's in {of_moved[2]}.",
        "",
        f"![Parts of the pictures, {SHOWN} samples of a pixel](rendering/effects.png)",
        "",
        f"Parts of the pictures, from above {', '.join(one.effect.name for one in all)}; from the left the reference, then {SHOWN} "
        "samples of a pixel: "
        f"{', '.join(method.name.split(',')[0] for method in IN_PICTURE)}.",
        "",
        *claims_table([claim for part in claims for claim in part], verdicts),
    ]
    return "\n".join(lines).rstrip() + "\n"


def main() -> None:
    parser = argparse.ArgumentParser()
    parser.add_argument("--page", type=Path, required=True, help="the page to write")
    parser.add_argument("--quick", action="store_true", help="few pixels and seeds: to see the page, not to believe it")
    arguments = parser.parse_args()
    effort = QUICK if arguments.quick else FULL
    all = [measure(place, effect, effort) for place, effect in enumerate(scenes.EFFECTS)]
    draw(arguments.page.with_suffix("") / "effects.png", effort.size, all)
    arguments.page.write_text(text(effort, arguments.quick, all))


main()
