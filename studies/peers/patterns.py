"""Samples of pixels in one to three dimensions: those that renderers take, and sets of azulejo.

A pattern is called with a generator of random numbers and the numbers of pixels, samples of a pixel and dimensions, and
returns an array of pixels × samples × dimensions in [0, 1). In the third dimension is the time, in the others what is sampled
in two: the pixel, the lens or the light.
"""

from collections.abc import Callable
from typing import NamedTuple

import azulejo
import numpy
from numpy.random import Generator
from numpy.typing import NDArray
from scipy.stats import qmc

Samples = NDArray[numpy.float64]
Pattern = Callable[[Generator, int, int, int], Samples]

# Sets of a pool, of which each pixel takes one.
POOL = 64
# Samples of a set in progressive order, of which a pixel takes the first ones.
LARGEST = 64
PRIMES = [2, 3, 5]


def random(generator: Generator, pixels: int, count: int, dimensions: int) -> Samples:
    return generator.random((pixels, count, dimensions))


def in_strata(generator: Generator, pixels: int, count: int, dimensions: int) -> Samples:
    """A sample anywhere in each of as many intervals, or squares, of equal size."""
    side = round(count ** (1 / dimensions))
    assert side**dimensions == count
    cells = numpy.stack(numpy.unravel_index(numpy.arange(count), [side] * dimensions), axis=-1)
    return (cells + generator.random((pixels, count, dimensions))) / side


def stratified(generator: Generator, pixels: int, count: int, dimensions: int) -> Samples:
    """In three dimensions squares and intervals, paired at random (Cook 1986)."""
    if dimensions < 3:
        return in_strata(generator, pixels, count, dimensions)
    times = generator.permuted(in_strata(generator, pixels, count, 1), axis=1)
    return numpy.concatenate([in_strata(generator, pixels, count, 2), times], axis=2)


def scrambled(generator: Generator, pixels: int, cells: NDArray[numpy.int64], base: int, digits: int) -> NDArray[numpy.float64]:
    """A number in each of some cells, of which there are base^digits in all, scrambled anew for each pixel (Owen 1995).

    Each digit of a cell is permuted at random, by another permutation for each sequence of digits before it. No two numbers
    share a cell, so that all digits further on are independent of each other.
    """
    found = numpy.zeros((pixels, len(cells)), dtype=numpy.int64)
    for digit in range(digits):
        before = cells // base ** (digits - digit)
        own = cells // base ** (digits - digit - 1) % base
        permutations = generator.random((pixels, base**digit, base)).argsort(axis=2)
        found = base * found + permutations[:, before, own]
    return (found + generator.random(found.shape)) / base**digits


def sobol(generator: Generator, pixels: int, count: int, dimensions: int) -> Samples:
    """The first points of Sobol's sequence, by Joe and Kuo's direction numbers; a power of 2."""
    digits = count.bit_length() - 1
    assert count == 1 << digits
    cells = numpy.rint(qmc.Sobol(dimensions, scramble=False).random(count) * count).astype(numpy.int64)
    axes = [scrambled(generator, pixels, cells[:, axis], 2, digits) for axis in range(dimensions)]
    return numpy.stack(axes, axis=-1)


def halton(generator: Generator, pixels: int, count: int, dimensions: int) -> Samples:
    """The first points of Halton's sequence."""
    points = qmc.Halton(dimensions, scramble=False).random(count)
    axes = []
    for axis, base in enumerate(PRIMES[:dimensions]):
        digits = next(digits for digits in range(1, 64) if base**digits >= count)
        cells = numpy.rint(points[:, axis] * base**digits).astype(numpy.int64)
        axes.append(scrambled(generator, pixels, cells, base, digits))
    return numpy.stack(axes, axis=-1)


def of_sets(one: Callable[[int, int, int], azulejo.Points]) -> Pattern:
    """Sets of the unit torus; of those of the square the first coordinate where one dimension is wanted."""

    def sample(generator: Generator, pixels: int, count: int, dimensions: int) -> Samples:
        seeds = generator.integers(1 << 32, size=pixels).tolist()
        sets = [numpy.asarray(one(count, max(dimensions, 2), seed).positions, dtype=float) for seed in seeds]
        found = numpy.stack(sets)[:, :, :dimensions]
        assert found.shape == (pixels, count, dimensions)
        return found

    return sample


def maximal(count: int, dimensions: int, seed: int) -> azulejo.Points:
    sample = azulejo.volume_sample if dimensions == 3 else azulejo.kdrt_sample
    return sample(count=count, seed=seed, threads=1)


def progressive(count: int, dimensions: int, seed: int) -> azulejo.Points:
    sample = azulejo.volume_sample if dimensions == 3 else azulejo.kdrt_sample
    return sample(count=LARGEST, order="progressive", seed=seed, threads=1)[:count]


def relaxed(count: int, dimensions: int, seed: int) -> azulejo.Points:
    """Random points, relaxed."""
    relax = azulejo.volume_relax if dimensions == 3 else azulejo.dcr_relax
    torus = dict(domain_min=[0] * dimensions, domain_max=[1] * dimensions, boundary="periodic")
    start = numpy.random.default_rng(seed).random((count, dimensions), dtype=numpy.float32)
    return relax(start, seed=seed, threads=1, **torus)


def moved(pattern: Pattern) -> Pattern:
    """In each pixel one set of a pool, moved along the torus at random (Cranley and Patterson 1976)."""

    def sample(generator: Generator, pixels: int, count: int, dimensions: int) -> Samples:
        pool = pattern(generator, POOL, count, dimensions)
        chosen = pool[generator.integers(POOL, size=pixels)]
        return (chosen + generator.random((pixels, 1, dimensions))) % 1.0

    return sample


class Method(NamedTuple):
    name: str
    pattern: Pattern


RANDOM = Method("random", random)
USUAL = [Method("stratified", stratified), Method("Sobol, Owen-scrambled", sobol), Method("Halton, Owen-scrambled", halton)]
MOVED = [Method(f"{method.name}; moved", moved(method.pattern)) for method in USUAL]
OWN = [Method("maximal, of KDRT; moved", moved(of_sets(maximal))), Method("relaxed, of DCR; moved", moved(of_sets(relaxed)))]
PROGRESSIVE = Method(f"first of {LARGEST} in progressive order; moved", moved(of_sets(progressive)))
METHODS = [RANDOM, *USUAL, *MOVED, *OWN, PROGRESSIVE]
