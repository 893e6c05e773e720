"""Four effects of a camera and a light, rendered by Mitsuba 3 with samples that are given.

Mitsuba's camera makes the rays, its shapes are hit and hide the light, its light and materials give the radiance; all are
called from here, since its own samplers cannot be given samples. Each effect takes its own dimensions from the samples; a pixel is
seen through its centre, but where its area is sampled, too.
"""

from collections.abc import Callable
from typing import Any, NamedTuple, Optional

import drjit
import mitsuba
import numpy
from numpy.typing import NDArray

mitsuba.set_variant("llvm_ad_rgb")

Transform = mitsuba.ScalarTransform4f
Description = dict[str, Any]

# Rays that are traced at once.
WAVEFRONT = 1 << 20
# How far the train moves while the shutter is open.
TRAVEL = 0.8
# Sampled by no effect: a lamp at infinity has but one direction.
ANYWHERE = mitsuba.Point2f(0.5, 0.5)


def grey(reflectance: float) -> Description:
    return {"type": "diffuse", "reflectance": {"type": "rgb", "value": reflectance}}


def checked(squares: float) -> Description:
    """Dark and bright squares, so many along a side."""
    colors = {f"color{i}": {"type": "rgb", "value": value} for i, value in enumerate((0.08, 0.8))}
    to_uv = Transform().scale([squares / 2, squares / 2, 1])
    return {"type": "diffuse", "reflectance": {"type": "checkerboard", "to_uv": to_uv, **colors}}


def ground(size: float, bsdf: Description) -> Description:
    return {"type": "rectangle", "to_world": Transform().scale([size, size, 1]), "bsdf": bsdf}


def wall(y: float, size: float, bsdf: Description) -> Description:
    upright = Transform().translate([0, y, 0]).rotate([1, 0, 0], 90).scale([size, size, 1])
    return {"type": "rectangle", "to_world": upright, "bsdf": bsdf}


def ball(centre: list[float], radius: float, reflectance: float = 0.7) -> Description:
    return {"type": "sphere", "center": centre, "radius": radius, "bsdf": grey(reflectance)}


def post(x: float, y: float, height: float, width: float) -> Description:
    stretched = Transform().translate([x, y, height / 2]).scale([width / 2, width / 2, height / 2])
    return {"type": "cube", "to_world": stretched, "bsdf": grey(0.7)}


def sun() -> Description:
    return {"type": "directional", "direction": [0.5, 0.8, -1.0], "irradiance": {"type": "rgb", "value": 3.0}}


def camera(kind: str, size: tuple[int, int], origin: list[float], target: list[float], fov: float, **more: float) -> Description:
    film = {"type": "hdrfilm", "width": size[0], "height": size[1], "filter": {"type": "box"}}
    to_world = Transform().look_at(origin=origin, target=target, up=[0, 0, 1])
    return {"type": kind, "to_world": to_world, "fov": fov, "film": film, **more}


class World:
    """What is at rest, with camera and light, and what moves while the shutter is open, by `velocity` in all."""

    def __init__(self, still: Description, moving: Optional[Description] = None, velocity: tuple[float, ...] = (0, 0, 0)):
        self.still = mitsuba.load_dict({"type": "scene", **still})
        self.moving = mitsuba.load_dict({"type": "scene", **moving}) if moving else None
        self.velocity = mitsuba.Vector3f(*velocity)
        self.camera = self.still.sensors()[0]

    def radiance(self, ray: mitsuba.Ray3f, light: mitsuba.Point2f = ANYWHERE, time: Any = 0.5) -> mitsuba.Float:
        """The luminance that reaches the camera along a ray at a time from 0 to 1, by light straight from the lamp.

        Mitsuba's shapes do not move: in place of them the rays do, the other way.
        """
        # From the middle of what the shutter sees.
        offset = self.velocity * (time - 0.5)
        hit = self.still.ray_intersect(ray)
        value = self.lit(hit, light, offset)
        if self.moving:
            other = self.moving.ray_intersect(shifted(ray, -offset))
            is_nearer = other.t < hit.t
            other.p += offset
            value = drjit.select(is_nearer, self.lit(other, light, offset), value)
        return value

    def lit(self, hit: mitsuba.SurfaceInteraction3f, light: mitsuba.Point2f, offset: mitsuba.Vector3f) -> mitsuba.Float:
        is_hit = hit.is_valid()
        lamp, weight = self.still.sample_emitter_direction(hit, light, False, is_hit)
        shadow = hit.spawn_ray_to(lamp.p)
        is_dark = self.still.ray_test(shadow, is_hit)
        if self.moving:
            is_dark |= self.moving.ray_test(shifted(shadow, -offset), is_hit)
        reflected = hit.bsdf().eval(mitsuba.BSDFContext(), hit, hit.to_local(lamp.d), is_hit)
        return drjit.select(is_hit & ~is_dark, mitsuba.luminance(reflected * weight), 0)

    def ray(self, film: mitsuba.Point2f, lens: mitsuba.Point2f = ANYWHERE) -> mitsuba.Ray3f:
        ray, _ = self.camera.sample_ray(0, 0, film, lens)
        return ray


def shifted(ray: mitsuba.Ray3f, offset: mitsuba.Vector3f) -> mitsuba.Ray3f:
    moved = mitsuba.Ray3f(ray)
    moved.o = ray.o + offset
    return moved


class Effect(NamedTuple):
    name: str
    # What is sampled, for the page.
    about: str
    dimensions: int
    world: Callable[[tuple[int, int]], World]
    # The luminance by the samples' coordinates; where in the pixel it is seen, unless that is sampled, is its centre.
    luminance: Callable[[World, Callable[[Any, Any], mitsuba.Point2f], list[mitsuba.Float]], mitsuba.Float]


def balls_in_depth(size: tuple[int, int]) -> World:
    """Balls from near to far, on squares before a wall with squares; the third is in focus."""
    origin, focus = [0, -6, 1.6], [0.2, 0, 0.6]
    scene = {
        "sun": sun(),
        "ground": ground(14, checked(56)),
        "wall": wall(9, 14, checked(40)),
        "camera": camera(
            "thinlens",
            size,
            origin,
            focus,
            36,
            aperture_radius=0.22,
            focus_distance=float(numpy.linalg.norm(numpy.subtract(origin, focus))),
        ),
    }
    for i, (x, y, radius) in enumerate([(-0.75, -3.6, 0.35), (0.85, -2.8, 0.3), (0.2, 0, 0.6), (-1.7, 3, 0.7), (2.2, 5, 0.9)]):
        scene[f"ball{i}"] = ball([x, y, radius], radius)
    for i in range(9):
        scene[f"post{i}"] = post(-3.6 + 0.9 * i, 6.5, 2.2, 0.12)
    return World(scene)


def lamp_above(size: tuple[int, int]) -> World:
    """A ball and a row of posts, whose shadows of a square lamp fall towards the camera."""
    facing = Transform().look_at(origin=[-2.0, 2.4, 2.4], target=[0, 0, 0.3], up=[0, 0, 1]).scale([0.5, 0.5, 1])
    emission = {"type": "area", "radiance": {"type": "rgb", "value": 20.0}}
    scene = {
        "lamp": {"type": "rectangle", "to_world": facing, "emitter": emission},
        "ground": ground(8, grey(0.7)),
        "camera": camera("perspective", size, [0, -4.5, 3.2], [0, -0.3, 0.2], 36),
        "ball": ball([0.8, 0.2, 0.45], 0.45),
    }
    for i in range(6):
        scene[f"post{i}"] = post(-1.5 + 0.32 * i, 0.1, 0.8, 0.1)
    return World(scene)


def stage(size: tuple[int, int]) -> Description:
    return {
        "sun": sun(),
        "ground": ground(10, checked(40)),
        "wall": wall(1.6, 10, checked(40)),
        "camera": camera("perspective", size, [0, -5, 1.5], [0, 0, 0.75], 38),
    }


def train(x: float) -> Description:
    """Balls and posts in a row, whose middle is at `x`."""
    wagons = {
        "large": ball([x - 1.2, 0, 0.55], 0.55),
        "small": ball([x + 0.1, -0.7, 0.25], 0.25, 0.9),
        "high": ball([x + 0.4, 0.2, 1.4], 0.3, 0.4),
    }
    return wagons | {f"post{i}": post(x + 0.9 + 0.2 * i, 0.2, 1.1, 0.06) for i in range(5)}


def passing_by(size: tuple[int, int]) -> World:
    """A train that moves to the right, before a wall with squares, and its shadows with it."""
    return World(stage(size), train(0.0), (TRAVEL, 0, 0))


CENTRE = (0.5, 0.5)
EFFECTS = [
    Effect(
        "depth of field",
        "the lens of a camera, in two dimensions",
        2,
        balls_in_depth,
        lambda world, film, u: world.radiance(world.ray(film(*CENTRE), mitsuba.Point2f(u[0], u[1]))),
    ),
    Effect(
        "soft shadows",
        "a square lamp, in two dimensions",
        2,
        lamp_above,
        lambda world, film, u: world.radiance(world.ray(film(*CENTRE)), mitsuba.Point2f(u[0], u[1])),
    ),
    Effect(
        "motion blur",
        "the time in which the shutter is open, in one dimension",
        1,
        passing_by,
        lambda world, film, u: world.radiance(world.ray(film(*CENTRE)), time=u[0]),
    ),
    Effect(
        "motion blur in the pixel",
        "place in the pixel and time together, in three dimensions",
        3,
        passing_by,
        lambda world, film, u: world.radiance(world.ray(film(u[0], u[1])), time=u[2]),
    ),
]


class Picture:
    """An effect that is rendered, of so many pixels."""

    def __init__(self, effect: Effect, size: tuple[int, int]):
        self.effect, self.size = effect, size
        self.world = effect.world(size)

    def of_pixels(self, first: int, samples: NDArray[numpy.float64]) -> NDArray[numpy.float64]:
        """The mean luminances of pixels from the `first` on, row by row."""
        pixels, count, _ = samples.shape
        index = numpy.repeat(numpy.arange(first, first + pixels), count)
        corner = [mitsuba.Float(part.astype(numpy.float32)) for part in (index % self.size[0], index // self.size[0])]
        coordinates = [mitsuba.Float(samples[:, :, axis].ravel().astype(numpy.float32)) for axis in range(samples.shape[2])]

        def film(x: Any, y: Any) -> mitsuba.Point2f:
            return mitsuba.Point2f((corner[0] + x) / self.size[0], (corner[1] + y) / self.size[1])

        luminance = numpy.array(self.effect.luminance(self.world, film, coordinates), dtype=float)
        return luminance.reshape(pixels, count).mean(1)

    def render(self, count: int, sample: Callable[[int], NDArray[numpy.float64]]) -> NDArray[numpy.float64]:
        """All pixels, from the samples that a function makes for a number of pixels; in parts, if there are many."""
        step, total = max(WAVEFRONT // count, 1), self.size[0] * self.size[1]
        parts = [self.of_pixels(first, sample(min(step, total - first))) for first in range(0, total, step)]
        return numpy.concatenate(parts)
