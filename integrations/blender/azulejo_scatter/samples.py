"""Samples of a surface, and how what stands on them is turned and scaled. Knows no Blender."""

from dataclasses import dataclass

import azulejo
import numpy as np

# Streams of random numbers: those of one do not depend on how much is taken of another.
_TURN, _SCALE, _PICK, _SHUFFLE = range(4)


@dataclass
class Samples:
    """One row for each sample; azulejo sorts them by class and then, if there are ranks, from coarse to fine."""

    origin: np.ndarray
    positions: np.ndarray
    normals: np.ndarray
    classes: np.ndarray
    ranks: np.ndarray
    shares: np.ndarray
    rotations: np.ndarray
    scales: np.ndarray
    picks: np.ndarray


def sample(surface, settings, factors, progress=None):
    """Samples a surface. `settings` has the parameters; `factors` are the radii of the classes, in its radius."""
    if settings.scale_min > settings.scale_max:
        raise ValueError(f"scale_min: {settings.scale_min:g} is above scale_max, {settings.scale_max:g}")
    mesh = azulejo.Mesh(
        surface.vertices, surface.triangles, normals=surface.normals, normal_indices=surface.normal_indices
    )
    points = _points(mesh, surface, settings, factors, progress)
    classes = np.zeros(len(points), np.int32) if points.classes is None else points.classes.astype(np.int32)
    normals = _normals(points)
    count = len(points)
    ranked = settings.order == "PROGRESSIVE"
    stretch = settings.scale_max - settings.scale_min
    return Samples(
        origin=surface.origin + points.origin,
        positions=points.local_positions,
        normals=normals,
        classes=classes,
        ranks=points.ranks if ranked else np.zeros(count, np.float32),
        shares=_shares(classes, None if ranked else settings.seed),
        rotations=_rotations(_axes(normals, settings.align), settings.turn * (_random(settings.seed, _TURN, count) - 0.5)),
        scales=(settings.scale_min + stretch * _random(settings.seed, _SCALE, count)).astype(np.float32),
        picks=(_random(settings.seed, _PICK, count) * 2**16).astype(np.int32),
    )


def _points(mesh, surface, settings, factors, progress):
    density = surface.density
    options = {"order": settings.order.lower(), "seed": settings.seed, "progress": progress}
    if surface.avoided is not None:
        shape = (len(surface.avoided), len(factors)) if len(factors) > 1 else len(surface.avoided)
        options["given_positions"] = surface.avoided
        options["given_clearances"] = np.full(shape, settings.clearance)
    by_count = settings.amount == "COUNT"
    if len(factors) > 1:
        if by_count:
            raise ValueError(f"count: {len(factors)} classes are sampled by a radius")
        radii = azulejo.classes_radii(factors) if settings.between == "TOGETHER" else _means(factors)
        if density is None:
            return azulejo.psp_sample_classes(mesh, radii * settings.radius, **options)
        return azulejo.psp_classes_with_density(mesh, radii, density, radius=settings.radius, **options)
    if by_count:
        amount = {"count": settings.count}
        if density is not None:
            # Only then is the count exact.
            options["order"] = "progressive"
    else:
        amount = {"radius": settings.radius * factors[0]}
    if density is None:
        return azulejo.psp_sample(mesh, **amount, **options)
    return azulejo.psp_adaptive_with_density(mesh, density, **amount, **options)


def _means(factors):
    own = np.array(factors, np.float64)
    return (own[:, None] + own) / 2.0


def _random(seed, stream, count):
    return np.random.default_rng([seed, stream]).random(count)


def _normals(points):
    """Those of the shading, or of the triangle where these cancel each other."""
    normals = points.interpolated_normals.astype(np.float64)
    lengths = np.linalg.norm(normals, axis=1, keepdims=True)
    smooth = lengths[:, 0] > 1e-6
    normals = np.where(smooth[:, None], normals / np.where(lengths > 0.0, lengths, 1.0), points.normals)
    return normals.astype(np.float32)


def _shares(classes, seed):
    """The share of the own class that comes before each sample, in its order; with a seed in a random one."""
    shares = np.empty(len(classes), np.float32)
    for each in np.unique(classes):
        of_class = np.flatnonzero(classes == each)
        if seed is not None:
            np.random.default_rng([seed, _SHUFFLE, int(each)]).shuffle(of_class)
        shares[of_class] = np.arange(len(of_class)) / len(of_class)
    return shares


def _axes(normals, align):
    axes = align * normals.astype(np.float64) + (1.0 - align) * np.array([0.0, 0.0, 1.0])
    lengths = np.linalg.norm(axes, axis=1, keepdims=True)
    return np.where(lengths > 1e-6, axes / np.where(lengths > 0.0, lengths, 1.0), normals)


def _rotations(axes, turns):
    """Quaternions (w, x, y, z): a number of turns about z, and then the shortest way from z to the axis."""
    arcs = np.stack([1.0 + axes[:, 2], -axes[:, 1], axes[:, 0], np.zeros(len(axes))], axis=1)
    lengths = np.linalg.norm(arcs, axis=1, keepdims=True)
    # Opposite to z there are many shortest ways.
    arcs = np.where(lengths > 1e-6, arcs / np.where(lengths > 0.0, lengths, 1.0), [0.0, 1.0, 0.0, 0.0])
    w, x, y, _ = arcs.T
    cosine, sine = np.cos(np.pi * turns), np.sin(np.pi * turns)
    return np.stack([w * cosine, x * cosine + y * sine, y * cosine - x * sine, w * sine], axis=1).astype(np.float32)
