"""Holds the patterns of patterns.py to what they promise, and the pictures of scenes.py to those of Mitsuba's own integrator;
says nothing if all is well."""

from collections.abc import Iterator
from itertools import product

import mitsuba
import numpy
import patterns
import scenes
from numpy.typing import NDArray

PIXELS = 6
SIZE = (48, 32)
# Sets are moved at random: a few suffice.
patterns.POOL = 4


def is_one_in_each(samples: patterns.Samples, sides: tuple[int, ...]) -> bool:
    """True if each box of a division of the cube has exactly one sample, in every pixel."""
    cells = numpy.ravel_multi_index(tuple((samples * sides).astype(int).transpose(2, 0, 1)), sides)
    return bool((numpy.sort(cells, axis=1) == numpy.arange(numpy.prod(sides))).all())


def elementary(count: int, dimensions: int) -> Iterator[tuple[int, ...]]:
    """The divisions into as many boxes whose sides are powers of 2."""
    powers = [1 << power for power in range(count.bit_length())]
    return (sides for sides in product(powers, repeat=dimensions) if numpy.prod(sides) == count)


def check_patterns() -> None:
    generator = numpy.random.default_rng(1)
    for (method, count), dimensions in product(product(patterns.METHODS, (4, 16, 64)), (1, 2, 3)):
        samples = method.pattern(generator, PIXELS, count, dimensions)
        assert samples.shape == (PIXELS, count, dimensions) and samples.min() >= 0 and samples.max() < 1, method
        # No coordinate is anywhere more often than elsewhere, up to 5 standard errors of independent ones.
        means = numpy.stack([method.pattern(generator, 200, count, dimensions).mean((0, 1)) for _ in range(3)]).mean(0)
        assert (abs(means - 0.5) < 5 / numpy.sqrt(12 * 600)).all(), (method, means)
        assert not numpy.array_equal(samples[0], samples[1]), method
    for count in (4, 16, 64):
        side = round(count**0.5)
        assert is_one_in_each(patterns.stratified(generator, PIXELS, count, 1), (count,))
        assert is_one_in_each(patterns.stratified(generator, PIXELS, count, 2), (side, side))
        in_space = patterns.stratified(generator, PIXELS, count, 3)
        assert is_one_in_each(in_space[:, :, :2], (side, side)) and is_one_in_each(in_space[:, :, 2:], (count,))
        # Sobol's first two dimensions are a (0, 2)-sequence in base 2.
        flat = patterns.sobol(generator, PIXELS, count, 2)
        assert all(is_one_in_each(flat, sides) for sides in elementary(count, 2))
        for axis in range(3):
            assert is_one_in_each(patterns.sobol(generator, PIXELS, count, 3)[:, :, axis : axis + 1], (count,))
        assert is_one_in_each(patterns.halton(generator, PIXELS, count, 2)[:, :, :1], (count,))
    # Of Halton's in bases 2 and 3 the first 36 are one in each of 4 × 9 boxes.
    assert is_one_in_each(patterns.halton(generator, PIXELS, 36, 2), (4, 9))


def rays(world: scenes.World, copies: int) -> tuple[mitsuba.Ray3f, int]:
    """Through the centres of the pixels and random places of a lens."""
    generator = numpy.random.default_rng(2)
    x, y = (numpy.repeat(part.ravel() + 0.5, copies) for part in numpy.meshgrid(*map(numpy.arange, SIZE)))
    place, lens = (x / SIZE[0], y / SIZE[1]), generator.random((2, len(x)))
    return world.ray(*(mitsuba.Point2f(*(part.astype(numpy.float32) for part in pair)) for pair in (place, lens))), len(x)


def by_mitsuba(scene: mitsuba.Scene, ray: mitsuba.Ray3f, count: int) -> NDArray[numpy.float64]:
    """The luminances of rays by Mitsuba's integrator of direct light, with a sampler of its own."""
    sampler = mitsuba.load_dict({"type": "independent"})
    sampler.seed(3, count)
    integrator = mitsuba.load_dict({"type": "direct", "emitter_samples": 1, "bsdf_samples": 0})
    radiance, _, _ = integrator.sample(scene, sampler, mitsuba.RayDifferential3f(ray))
    return numpy.array(mitsuba.luminance(radiance), dtype=float)


def check_at_rest() -> None:
    world = scenes.balls_in_depth(SIZE)
    ray, count = rays(world, 4)
    own, expected = numpy.array(world.radiance(ray)), by_mitsuba(world.still, ray, count)
    assert expected.std() > 0.1 and (abs(own - expected) > 1e-4).mean() < 1e-3


def check_moving() -> None:
    world = scenes.passing_by(SIZE)
    ray, count = rays(world, 1)
    shadows = 0
    for time in (0.0, 0.3, 1.0):
        together = scenes.stage(SIZE) | scenes.train(scenes.TRAVEL * (time - 0.5))
        expected = by_mitsuba(mitsuba.load_dict({"type": "scene", **together}), ray, count)
        own = numpy.array(world.radiance(ray, time=mitsuba.Float(time)))
        assert (abs(own - expected) > 1e-4).mean() < 3e-3, time
        shadows += (own == 0).sum()
    assert shadows > 100


def check_lamp() -> None:
    world, copies = scenes.lamp_above(SIZE), 512
    ray, count = rays(world, copies)
    light = numpy.random.default_rng(4).random((2, count)).astype(numpy.float32)
    own = numpy.array(world.radiance(ray, mitsuba.Point2f(*light)), dtype=float).reshape(-1, copies)
    expected = by_mitsuba(world.still, ray, count).reshape(-1, copies)
    error = numpy.hypot(*(one.std(1) / copies**0.5 for one in (own, expected)))
    difference = own.mean(1) - expected.mean(1)
    is_sampled = error > 1e-6
    assert is_sampled.mean() > 0.5 and abs(difference[~is_sampled]).max(initial=0) < 1e-4
    # By chance the squares of the differences are those of the errors.
    assert 0.8 < ((difference[is_sampled] / error[is_sampled]) ** 2).mean() < 1.25


check_patterns()
check_at_rest()
check_moving()
check_lamp()
