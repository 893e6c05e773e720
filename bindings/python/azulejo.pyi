"""Blue-noise sampling: maximal Poisson-disk sets in the plane, on triangle meshes and in space, and their relaxation."""

from collections.abc import Callable, Iterator, Sequence
from os import PathLike
from typing import Any, Literal, Optional, Protocol, SupportsFloat, SupportsIndex, Union, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

__version__: str

_Numbers = Union[Sequence[float], NDArray[Any]]
_Boundary = Literal["periodic", "bounded"]
_Order = Literal["any", "progressive"]
_Progress = Optional[Callable[[float], object]]

# Doubles where the domain or mesh has an origin that is not 0.
_Floats = Union[NDArray[np.float32], NDArray[np.float64]]

class _HasFaces(Protocol):
    vertices: Any
    faces: Any

class _HasTriangles(Protocol):
    vertices: Any
    triangles: Any

class _PolyData(Protocol):
    points: Any
    faces: Any

_MeshLike = Union[Mesh, tuple[ArrayLike, ArrayLike], _HasFaces, _HasTriangles, _PolyData]

class Cancelled(Exception): ...

class Points:
    @property
    def positions(self) -> _Floats: ...
    @property
    def local_positions(self) -> NDArray[np.float32]: ...
    @property
    def origin(self) -> NDArray[np.float64]: ...
    @property
    def domain_min(self) -> Optional[list[float]]: ...
    @property
    def domain_max(self) -> Optional[list[float]]: ...
    @property
    def boundary(self) -> Optional[_Boundary]: ...
    @property
    def normals(self) -> Optional[NDArray[np.float32]]: ...
    @property
    def interpolated_normals(self) -> Optional[NDArray[np.float32]]: ...
    @property
    def triangles(self) -> Optional[NDArray[np.uint32]]: ...
    @property
    def barycentrics(self) -> Optional[NDArray[np.float32]]: ...
    @property
    def radii(self) -> Optional[NDArray[np.float64]]: ...
    @property
    def ranks(self) -> Optional[NDArray[np.float32]]: ...
    @property
    def classes(self) -> Optional[NDArray[np.uint32]]: ...
    @property
    def ids(self) -> Optional[NDArray[np.uint64]]: ...
    @property
    def report(self) -> Any: ...
    def __len__(self) -> int: ...
    def __iter__(self) -> Iterator[_Floats]: ...
    @overload
    def __getitem__(self, key: Union[int, np.integer[Any]]) -> _Floats: ...
    @overload
    def __getitem__(self, key: tuple[Any, ...]) -> Any: ...
    @overload
    def __getitem__(self, key: Union[slice, NDArray[Any], Sequence[int]]) -> Points: ...
    def __array__(self, dtype: Any = None, copy: Optional[bool] = None) -> NDArray[Any]: ...
    def __dlpack__(self, **options: Any) -> Any: ...
    def __dlpack_device__(self) -> tuple[int, int]: ...

class KdrtReport:
    @property
    def radius(self) -> float: ...
    @property
    def is_maximal(self) -> bool: ...

class VolumeReport:
    @property
    def radius(self) -> float: ...
    @property
    def covering_radius(self) -> float: ...
    @property
    def seconds(self) -> float: ...

class VolumeInsideReport:
    @property
    def radius(self) -> float: ...
    @property
    def covering_radius(self) -> float: ...
    @property
    def depth(self) -> float: ...
    @property
    def surface_samples(self) -> int: ...
    @property
    def seconds(self) -> float: ...

class KdrtMergeReport:
    @property
    def kept(self) -> int: ...
    @property
    def eliminated(self) -> int: ...
    @property
    def inserted(self) -> int: ...

class KdrtPlane:
    def __init__(
        self,
        radius: Optional[SupportsFloat] = 0.0,
        *,
        radii: Optional[ArrayLike] = None,
        domain_min: Optional[_Numbers] = None,
        domain_max: Optional[_Numbers] = None,
        boundary: _Boundary = "periodic",
        leaf_size: SupportsFloat = 20.0,
        seed: SupportsIndex = 0,
        order: _Order = "any",
        quotient: Optional[SupportsFloat] = None,
        coarsest: Optional[SupportsFloat] = None,
        given_positions: Optional[ArrayLike] = None,
        given_clearances: Optional[ArrayLike] = None,
        threads: SupportsIndex = 0,
        progress: _Progress = None,
    ) -> None: ...
    def window(self, window_min: _Numbers, window_max: _Numbers) -> Points: ...

class Plane:
    def __init__(
        self,
        radius: SupportsFloat,
        positions: Optional[ArrayLike] = None,
        *,
        domain_min: Optional[_Numbers] = None,
        domain_max: Optional[_Numbers] = None,
        boundary: Optional[_Boundary] = None,
        leaf_size: SupportsFloat = 20.0,
        seed: SupportsIndex = 0,
        given_positions: Optional[ArrayLike] = None,
        given_clearances: Optional[ArrayLike] = None,
        threads: SupportsIndex = 0,
        progress: _Progress = None,
    ) -> None: ...
    def __len__(self) -> int: ...
    def points(self) -> Points: ...
    def erase(
        self,
        centre: Optional[_Numbers] = None,
        radius: Optional[SupportsFloat] = None,
        *,
        min: Optional[_Numbers] = None,
        max: Optional[_Numbers] = None,
    ) -> Points: ...
    def erase_ids(self, ids: ArrayLike) -> Points: ...
    def restore(self, points: Points) -> None: ...
    def add_given(
        self, given_positions: ArrayLike, given_clearances: Optional[ArrayLike] = None
    ) -> tuple[int, Points]: ...
    def remove_given(self, ids: ArrayLike) -> None: ...
    def refill(
        self, seed: SupportsIndex = 0, *, threads: SupportsIndex = 0, progress: _Progress = None
    ) -> Points: ...

class Mesh:
    def __init__(
        self,
        positions: ArrayLike,
        indices: ArrayLike,
        *,
        normals: Optional[ArrayLike] = None,
        normal_indices: Optional[ArrayLike] = None,
        mask: Optional[ArrayLike] = None,
    ) -> None: ...
    @staticmethod
    def load(path: Union[str, PathLike[str]]) -> Mesh: ...
    def with_normals(self, normals: ArrayLike, normal_indices: Optional[ArrayLike] = None) -> Mesh: ...
    def with_mask(self, mask: ArrayLike) -> Mesh: ...
    def deform(self, positions: ArrayLike) -> Mesh: ...
    def points(self, triangles: ArrayLike, barycentrics: ArrayLike) -> Points: ...
    @property
    def vertex_count(self) -> int: ...
    @property
    def triangle_count(self) -> int: ...
    @property
    def positions(self) -> _Floats: ...
    @property
    def local_positions(self) -> NDArray[np.float32]: ...
    @property
    def origin(self) -> NDArray[np.float64]: ...
    @property
    def indices(self) -> NDArray[np.uint32]: ...
    @property
    def has_normals(self) -> bool: ...
    @property
    def normals(self) -> Optional[NDArray[np.float32]]: ...
    @property
    def normal_indices(self) -> Optional[NDArray[np.uint32]]: ...
    @property
    def mask(self) -> Optional[NDArray[np.bool_]]: ...
    @property
    def area(self) -> float: ...
    @property
    def is_closed(self) -> bool: ...
    def contains(
        self, positions: ArrayLike, *, threads: SupportsIndex = 0, progress: _Progress = None
    ) -> NDArray[np.bool_]: ...

class PspReport:
    @property
    def radius(self) -> float: ...
    @property
    def covering_radius(self) -> Optional[float]: ...
    @property
    def rho(self) -> float: ...
    @property
    def samples(self) -> int: ...
    @property
    def accepted(self) -> int: ...
    @property
    def iterations(self) -> int: ...
    @property
    def darts(self) -> int: ...
    @property
    def uncovered_before(self) -> Optional[float]: ...
    @property
    def uncovered_after(self) -> Optional[float]: ...
    @property
    def seconds(self) -> float: ...

class Psp:
    def __init__(
        self,
        mesh: _MeshLike,
        radius: SupportsFloat,
        *,
        seed: SupportsIndex = 0,
        projectors: Literal["local", "global"] = "local",
        priority: Literal["squareness", "projector"] = "squareness",
        given_positions: Optional[ArrayLike] = None,
        given_clearances: Optional[ArrayLike] = None,
        cosine: Optional[SupportsFloat] = None,
    ) -> None: ...
    def advance(
        self, iterations: SupportsIndex, *, threads: SupportsIndex = 0, progress: _Progress = None
    ) -> PspReport: ...
    def fill(self, *, threads: SupportsIndex = 0, progress: _Progress = None) -> PspReport: ...
    def __len__(self) -> int: ...
    def points(self) -> Points: ...
    def erase(
        self,
        centre: Optional[_Numbers] = None,
        radius: Optional[SupportsFloat] = None,
        *,
        min: Optional[_Numbers] = None,
        max: Optional[_Numbers] = None,
    ) -> Points: ...
    def erase_ids(self, ids: ArrayLike) -> Points: ...
    def restore(self, points: Points) -> None: ...
    def add_given(
        self, given_positions: ArrayLike, given_clearances: Optional[ArrayLike] = None
    ) -> tuple[int, Points]: ...
    def remove_given(self, ids: ArrayLike) -> None: ...
    def refill(
        self, seed: SupportsIndex = 0, *, threads: SupportsIndex = 0, progress: _Progress = None
    ) -> Points: ...

class DcrReport:
    @property
    def iterations(self) -> int: ...
    @property
    def stopped(self) -> Literal["converged", "steps", "cancelled"]: ...
    @property
    def motion(self) -> float: ...
    @property
    def smallest_distance(self) -> float: ...
    @property
    def rho(self) -> float: ...
    @property
    def relative_covering_radius(self) -> Optional[float]: ...
    @property
    def class_rho(self) -> Optional[NDArray[np.float64]]: ...
    @property
    def residual(self) -> Optional[float]: ...
    @property
    def class_relative_covering_radius(self) -> Optional[NDArray[np.float64]]: ...

class DcrRemeshReport:
    @property
    def triangles(self) -> int: ...
    @property
    def disputed(self) -> int: ...
    @property
    def left_out(self) -> int: ...
    @property
    def boundary_edges(self) -> int: ...
    @property
    def inner_edges(self) -> int: ...
    @property
    def non_manifold_edges(self) -> int: ...
    @property
    def non_manifold_vertices(self) -> int: ...
    @property
    def unused_vertices(self) -> int: ...
    @property
    def euler(self) -> int: ...
    @property
    def smallest_angle(self) -> float: ...
    @property
    def largest_angle(self) -> float: ...
    @property
    def mean_smallest_angle(self) -> float: ...

class Selection:
    @property
    def indices(self) -> NDArray[np.uint32]: ...
    @property
    def ranks(self) -> Optional[NDArray[np.float32]]: ...
    def __len__(self) -> int: ...
    def __iter__(self) -> Iterator[np.uint32]: ...
    def __getitem__(self, key: Any) -> Any: ...
    def __array__(self, dtype: Any = None, copy: Optional[bool] = None) -> NDArray[Any]: ...

class CoverageReport:
    @property
    def covering_radius(self) -> float: ...
    @property
    def gaps(self) -> int: ...

class SpaceReport:
    @property
    def count(self) -> int: ...
    @property
    def smallest_distance(self) -> float: ...
    @property
    def mean_distance(self) -> float: ...
    @property
    def conflicts(self) -> int: ...
    @property
    def packed_distance(self) -> float: ...
    @property
    def rho(self) -> float: ...
    @property
    def covering_radius(self) -> float: ...
    @property
    def relative_covering_radius(self) -> float: ...

class PlaneReport:
    @property
    def count(self) -> int: ...
    @property
    def smallest_distance(self) -> float: ...
    @property
    def mean_distance(self) -> float: ...
    @property
    def hexagonal_distance(self) -> float: ...
    @property
    def rho(self) -> float: ...
    @property
    def covering_radius(self) -> float: ...
    @property
    def bond_order(self) -> float: ...
    @property
    def triangles(self) -> int: ...
    @property
    def obtuse(self) -> float: ...
    @property
    def below_30_degrees(self) -> float: ...
    @property
    def angles_below_30_degrees(self) -> float: ...
    @property
    def edge_mean(self) -> float: ...
    @property
    def edge_variation(self) -> float: ...
    @property
    def area_variation(self) -> float: ...
    @property
    def beyond_4_sigma(self) -> float: ...

class SpectrumReport:
    @property
    def frequency_step(self) -> list[float]: ...
    @property
    def effective_nyquist(self) -> Optional[float]: ...
    @property
    def oscillation(self) -> Optional[float]: ...
    @property
    def contrast(self) -> float: ...
    @property
    def peak(self) -> float: ...
    @property
    def peak_frequency(self) -> list[float]: ...

class Spectrum:
    def __init__(
        self,
        positions: ArrayLike,
        size: SupportsIndex,
        frequency_stride: SupportsIndex = 1,
        *,
        domain_min: Optional[_Numbers] = None,
        domain_max: Optional[_Numbers] = None,
        boundary: Optional[_Boundary] = None,
        threads: SupportsIndex = 0,
        progress: _Progress = None,
    ) -> None: ...
    @staticmethod
    def mean(spectra: Sequence[Spectrum]) -> Spectrum: ...
    @property
    def size(self) -> int: ...
    @property
    def power(self) -> NDArray[np.float32]: ...
    def radial(self, width: SupportsFloat = 0.05) -> NDArray[np.float64]: ...
    def measure(self, low: SupportsFloat, high: SupportsFloat, width: SupportsFloat) -> SpectrumReport: ...

class Differences:
    def __init__(
        self,
        mesh: _MeshLike,
        positions: ArrayLike,
        normals: ArrayLike,
        direction: Optional[_Numbers] = None,
        *,
        seed: SupportsIndex = 0,
        threads: SupportsIndex = 0,
        progress: _Progress = None,
    ) -> None: ...
    @staticmethod
    def mean(differences: Sequence[Differences]) -> Differences: ...
    @property
    def density(self) -> NDArray[np.float64]: ...
    @property
    def radial(self) -> NDArray[np.float64]: ...
    def power(self, frequencies: ArrayLike) -> NDArray[np.float64]: ...

def classes_radii(own: ArrayLike, factor: SupportsFloat = 1.0) -> NDArray[np.float64]: ...
def kdrt_sample(
    radius: Optional[SupportsFloat] = 0.0,
    *,
    count: Optional[SupportsIndex] = 0,
    domain_min: Optional[_Numbers] = None,
    domain_max: Optional[_Numbers] = None,
    boundary: _Boundary = "periodic",
    leaf_size: SupportsFloat = 20.0,
    seed: SupportsIndex = 0,
    order: _Order = "any",
    quotient: Optional[SupportsFloat] = None,
    coarsest: Optional[SupportsFloat] = None,
    given_positions: Optional[ArrayLike] = None,
    given_clearances: Optional[ArrayLike] = None,
    threads: SupportsIndex = 0,
    progress: _Progress = None,
) -> Points: ...
def kdrt_sample_window(
    window_min: _Numbers,
    window_max: _Numbers,
    radius: SupportsFloat,
    *,
    domain_min: Optional[_Numbers] = None,
    domain_max: Optional[_Numbers] = None,
    boundary: _Boundary = "periodic",
    leaf_size: SupportsFloat = 20.0,
    seed: SupportsIndex = 0,
    order: _Order = "any",
    quotient: Optional[SupportsFloat] = None,
    coarsest: Optional[SupportsFloat] = None,
    given_positions: Optional[ArrayLike] = None,
    given_clearances: Optional[ArrayLike] = None,
    threads: SupportsIndex = 0,
    progress: _Progress = None,
) -> Points: ...
def kdrt_sample_classes(
    radii: ArrayLike,
    *,
    domain_min: Optional[_Numbers] = None,
    domain_max: Optional[_Numbers] = None,
    boundary: _Boundary = "periodic",
    leaf_size: SupportsFloat = 20.0,
    seed: SupportsIndex = 0,
    order: _Order = "any",
    quotient: Optional[SupportsFloat] = None,
    coarsest: Optional[SupportsFloat] = None,
    given_positions: Optional[ArrayLike] = None,
    given_clearances: Optional[ArrayLike] = None,
    threads: SupportsIndex = 0,
    progress: _Progress = None,
) -> Points: ...
def kdrt_stream(
    visit: Callable[[_Floats], object],
    radius: SupportsFloat,
    *,
    domain_min: Optional[_Numbers] = None,
    domain_max: Optional[_Numbers] = None,
    boundary: _Boundary = "periodic",
    leaf_size: SupportsFloat = 20.0,
    seed: SupportsIndex = 0,
    given_positions: Optional[ArrayLike] = None,
    given_clearances: Optional[ArrayLike] = None,
    threads: SupportsIndex = 0,
    progress: _Progress = None,
) -> None: ...
def maximal_sample(
    radius: SupportsFloat,
    *,
    domain_min: Optional[_Numbers] = None,
    domain_max: Optional[_Numbers] = None,
    boundary: _Boundary = "periodic",
    seed: SupportsIndex = 0,
    threads: SupportsIndex = 0,
    progress: _Progress = None,
) -> Points: ...
def volume_sample(
    radius: Optional[SupportsFloat] = 0.0,
    *,
    count: Optional[SupportsIndex] = 0,
    domain_min: Optional[_Numbers] = None,
    domain_max: Optional[_Numbers] = None,
    boundary: _Boundary = "periodic",
    seed: SupportsIndex = 0,
    order: _Order = "any",
    quotient: Optional[SupportsFloat] = None,
    given_positions: Optional[ArrayLike] = None,
    given_clearances: Optional[ArrayLike] = None,
    leaf_size: SupportsFloat = 0.0,
    threads: SupportsIndex = 0,
    progress: _Progress = None,
) -> Points: ...
def volume_sample_classes(
    radii: ArrayLike,
    *,
    domain_min: Optional[_Numbers] = None,
    domain_max: Optional[_Numbers] = None,
    boundary: _Boundary = "periodic",
    seed: SupportsIndex = 0,
    given_positions: Optional[ArrayLike] = None,
    given_clearances: Optional[ArrayLike] = None,
    threads: SupportsIndex = 0,
    progress: _Progress = None,
) -> Points: ...
def volume_sample_inside(
    mesh: _MeshLike,
    radius: Optional[SupportsFloat] = 0.0,
    *,
    count: Optional[SupportsIndex] = 0,
    surface: Literal["open", "first"] = "open",
    tolerance: SupportsFloat = 0.0625,
    thickness: SupportsFloat = 0.0,
    seed: SupportsIndex = 0,
    order: _Order = "any",
    quotient: Optional[SupportsFloat] = None,
    given_positions: Optional[ArrayLike] = None,
    given_clearances: Optional[ArrayLike] = None,
    threads: SupportsIndex = 0,
    progress: _Progress = None,
) -> Points: ...
def volume_adaptive_sample(
    grid_values: ArrayLike,
    *,
    mesh: Optional[_MeshLike] = None,
    domain_min: Optional[_Numbers] = None,
    domain_max: Optional[_Numbers] = None,
    boundary: _Boundary = "periodic",
    tolerance: SupportsFloat = 0.0625,
    seed: SupportsIndex = 0,
    threads: SupportsIndex = 0,
    progress: _Progress = None,
) -> Points: ...
def mask_create(
    width: SupportsIndex,
    height: SupportsIndex,
    *,
    depth: SupportsIndex = 1,
    channels: SupportsIndex = 1,
    seed: SupportsIndex = 0,
    sigma: SupportsFloat = 1.5,
    threads: SupportsIndex = 0,
    progress: _Progress = None,
) -> NDArray[np.uint32]: ...
def mask_dither(ranks: ArrayLike, image: ArrayLike, levels: SupportsIndex = 2) -> NDArray[np.uint8]: ...
def kdrt_merge(
    pieces: Sequence[tuple[ArrayLike, _Numbers, _Numbers]],
    radius: SupportsFloat,
    *,
    fixed: Optional[ArrayLike] = None,
    domain_min: Optional[_Numbers] = None,
    domain_max: Optional[_Numbers] = None,
    boundary: _Boundary = "periodic",
    seed: SupportsIndex = 0,
    maximal_pieces: bool = False,
    threads: SupportsIndex = 0,
    progress: _Progress = None,
) -> Points: ...
def psp_sample(
    mesh: _MeshLike,
    radius: Optional[SupportsFloat] = 0.0,
    *,
    count: Optional[SupportsIndex] = 0,
    order: _Order = "any",
    quotient: Optional[SupportsFloat] = None,
    iterations: Optional[SupportsIndex] = None,
    maximal: bool = True,
    seed: SupportsIndex = 0,
    projectors: Literal["local", "global"] = "local",
    priority: Literal["squareness", "projector"] = "squareness",
    given_positions: Optional[ArrayLike] = None,
    given_clearances: Optional[ArrayLike] = None,
    cosine: Optional[SupportsFloat] = None,
    threads: SupportsIndex = 0,
    progress: _Progress = None,
) -> Points: ...
def psp_sample_classes(
    mesh: _MeshLike,
    radii: ArrayLike,
    *,
    masks: Optional[ArrayLike] = None,
    order: _Order = "any",
    quotient: Optional[SupportsFloat] = None,
    seed: SupportsIndex = 0,
    given_positions: Optional[ArrayLike] = None,
    given_clearances: Optional[ArrayLike] = None,
    cosine: Optional[SupportsFloat] = None,
    threads: SupportsIndex = 0,
    progress: _Progress = None,
) -> Points: ...
def psp_classes_with_density(
    mesh: _MeshLike,
    radii: ArrayLike,
    density: ArrayLike,
    *,
    radius: Optional[SupportsFloat] = 0.0,
    count: Optional[SupportsFloat] = 0.0,
    texture: Optional[ArrayLike] = None,
    masks: Optional[ArrayLike] = None,
    order: _Order = "any",
    quotient: Optional[SupportsFloat] = None,
    seed: SupportsIndex = 0,
    given_positions: Optional[ArrayLike] = None,
    given_clearances: Optional[ArrayLike] = None,
    cosine: Optional[SupportsFloat] = None,
    threads: SupportsIndex = 0,
    progress: _Progress = None,
) -> Points: ...
def psp_adaptive_sample(
    mesh: _MeshLike,
    vertex_radii: ArrayLike,
    *,
    order: _Order = "any",
    quotient: Optional[SupportsFloat] = None,
    seed: SupportsIndex = 0,
    given_positions: Optional[ArrayLike] = None,
    given_clearances: Optional[ArrayLike] = None,
    cosine: Optional[SupportsFloat] = None,
    threads: SupportsIndex = 0,
    progress: _Progress = None,
) -> Points: ...
def psp_adaptive_with_density(
    mesh: _MeshLike,
    density: ArrayLike,
    *,
    radius: Optional[SupportsFloat] = 0.0,
    count: Optional[SupportsFloat] = 0.0,
    texture: Optional[ArrayLike] = None,
    order: _Order = "any",
    quotient: Optional[SupportsFloat] = None,
    seed: SupportsIndex = 0,
    given_positions: Optional[ArrayLike] = None,
    given_clearances: Optional[ArrayLike] = None,
    cosine: Optional[SupportsFloat] = None,
    threads: SupportsIndex = 0,
    progress: _Progress = None,
) -> Points: ...
def dcr_relax(
    positions: ArrayLike,
    *,
    domain_min: Optional[_Numbers] = None,
    domain_max: Optional[_Numbers] = None,
    boundary: Optional[_Boundary] = None,
    neighbourhood: Literal["delaunay", "nearest"] = "delaunay",
    method: Literal["momentum", "thesis"] = "momentum",
    max_iterations: SupportsIndex = 100,
    tolerance: Optional[SupportsFloat] = None,
    seed: SupportsIndex = 0,
    conflict_radius: Optional[SupportsFloat] = None,
    attraction_radius: Optional[SupportsFloat] = None,
    step: Optional[SupportsFloat] = None,
    decay: Optional[SupportsFloat] = None,
    neighbours: Optional[SupportsIndex] = None,
    distribution: Optional[Literal["activeness", "average", "dominant", "zero", "eighty_twenty"]] = None,
    visits: Optional[Literal["both_ends", "one_end"]] = None,
    convergence: Optional[Literal["motion", "variance"]] = None,
    threads: SupportsIndex = 0,
    progress: _Progress = None,
) -> Points: ...
def dcr_relax_classes(
    positions: ArrayLike,
    classes: ArrayLike,
    *,
    domain_min: Optional[_Numbers] = None,
    domain_max: Optional[_Numbers] = None,
    boundary: Optional[_Boundary] = None,
    max_iterations: SupportsIndex = 100,
    tolerance: Optional[SupportsFloat] = None,
    seed: SupportsIndex = 0,
    threads: SupportsIndex = 0,
    progress: _Progress = None,
) -> Points: ...
def dcr_correlation_of_power(
    power: ArrayLike,
    highest: SupportsFloat,
    *,
    reach: SupportsFloat = 12.0,
    bins: SupportsIndex = 480,
) -> NDArray[np.float64]: ...
def dcr_relax_to_correlation(
    positions: ArrayLike,
    correlation: ArrayLike,
    reach: SupportsFloat,
    *,
    domain_min: Optional[_Numbers] = None,
    domain_max: Optional[_Numbers] = None,
    boundary: Optional[_Boundary] = None,
    max_iterations: SupportsIndex = 100,
    tolerance: Optional[SupportsFloat] = None,
    seed: SupportsIndex = 0,
    threads: SupportsIndex = 0,
    progress: _Progress = None,
) -> Points: ...
def dcr_relax_density(
    positions: ArrayLike,
    density: ArrayLike,
    *,
    domain_min: Optional[_Numbers] = None,
    domain_max: Optional[_Numbers] = None,
    boundary: Optional[_Boundary] = None,
    max_iterations: SupportsIndex = 100,
    tolerance: Optional[SupportsFloat] = None,
    seed: SupportsIndex = 0,
    threads: SupportsIndex = 0,
    progress: _Progress = None,
) -> Points: ...
def dcr_scatter(
    density: ArrayLike,
    count: SupportsIndex,
    *,
    domain_min: Optional[_Numbers] = None,
    domain_max: Optional[_Numbers] = None,
    boundary: _Boundary = "periodic",
    seed: SupportsIndex = 0,
    threads: SupportsIndex = 0,
    progress: _Progress = None,
) -> Points: ...
def dcr_surface_relax(
    mesh: _MeshLike,
    triangles: ArrayLike,
    barycentrics: ArrayLike,
    *,
    density: Optional[ArrayLike] = None,
    texture: Optional[ArrayLike] = None,
    max_iterations: SupportsIndex = 100,
    tolerance: Optional[SupportsFloat] = None,
    seed: SupportsIndex = 0,
    threads: SupportsIndex = 0,
    progress: _Progress = None,
) -> Points: ...
def volume_relax(
    positions: ArrayLike,
    *,
    domain_min: Optional[_Numbers] = None,
    domain_max: Optional[_Numbers] = None,
    boundary: Optional[_Boundary] = None,
    max_iterations: SupportsIndex = 100,
    tolerance: Optional[SupportsFloat] = None,
    seed: SupportsIndex = 0,
    threads: SupportsIndex = 0,
    progress: _Progress = None,
) -> Points: ...
def volume_relax_inside(
    mesh: _MeshLike,
    positions: ArrayLike,
    *,
    fixed: Optional[ArrayLike] = None,
    sliding: Optional[ArrayLike] = None,
    max_iterations: SupportsIndex = 100,
    tolerance: Optional[SupportsFloat] = None,
    seed: SupportsIndex = 0,
    threads: SupportsIndex = 0,
    progress: _Progress = None,
) -> Points: ...
def dcr_remesh(
    mesh: _MeshLike,
    triangles: ArrayLike,
    barycentrics: ArrayLike,
    *,
    threads: SupportsIndex = 0,
    progress: _Progress = None,
) -> tuple[Mesh, DcrRemeshReport]: ...
def thin(
    positions: ArrayLike,
    *,
    radius: Optional[SupportsFloat] = 0.0,
    count: Optional[SupportsIndex] = 0,
    order: _Order = "any",
    seed: SupportsIndex = 0,
    threads: SupportsIndex = 0,
    progress: _Progress = None,
) -> Selection: ...
def plane_smallest_distance(
    positions: ArrayLike,
    *,
    domain_min: Optional[_Numbers] = None,
    domain_max: Optional[_Numbers] = None,
    boundary: Optional[_Boundary] = None,
    threads: SupportsIndex = 0,
    progress: _Progress = None,
) -> float: ...
def plane_covering_radius(
    positions: ArrayLike,
    *,
    domain_min: Optional[_Numbers] = None,
    domain_max: Optional[_Numbers] = None,
    boundary: Optional[_Boundary] = None,
    threads: SupportsIndex = 0,
    progress: _Progress = None,
) -> float: ...
def space_smallest_distance(
    positions: ArrayLike,
    *,
    threads: SupportsIndex = 0,
    progress: _Progress = None,
) -> float: ...
def plane_coverage(
    positions: ArrayLike,
    radius: SupportsFloat,
    *,
    domain_min: Optional[_Numbers] = None,
    domain_max: Optional[_Numbers] = None,
    boundary: Optional[_Boundary] = None,
    threads: SupportsIndex = 0,
    progress: _Progress = None,
) -> CoverageReport: ...
def space_coverage(
    positions: ArrayLike,
    radius: SupportsFloat,
    *,
    domain_min: Optional[_Numbers] = None,
    domain_max: Optional[_Numbers] = None,
    boundary: Optional[_Boundary] = None,
    threads: SupportsIndex = 0,
    progress: _Progress = None,
) -> CoverageReport: ...
def space_measure(
    positions: ArrayLike,
    radius: SupportsFloat = 0.0,
    *,
    domain_min: Optional[_Numbers] = None,
    domain_max: Optional[_Numbers] = None,
    boundary: Optional[_Boundary] = None,
    threads: SupportsIndex = 0,
    progress: _Progress = None,
) -> SpaceReport: ...
def space_radial_distribution(
    positions: ArrayLike,
    reach: SupportsFloat,
    bins: SupportsIndex,
    *,
    domain_min: Optional[_Numbers] = None,
    domain_max: Optional[_Numbers] = None,
    boundary: Optional[_Boundary] = None,
    threads: SupportsIndex = 0,
    progress: _Progress = None,
) -> NDArray[np.float64]: ...
def space_spectrum(
    positions: ArrayLike,
    frequency_reach: SupportsFloat,
    frequency_stride: SupportsIndex = 1,
    *,
    width: SupportsFloat = 0.05,
    domain_min: Optional[_Numbers] = None,
    domain_max: Optional[_Numbers] = None,
    boundary: Optional[_Boundary] = None,
    threads: SupportsIndex = 0,
    progress: _Progress = None,
) -> NDArray[np.float64]: ...
def space_axis_power(
    positions: ArrayLike,
    axis: SupportsIndex,
    count: SupportsIndex,
    *,
    domain_min: Optional[_Numbers] = None,
    domain_max: Optional[_Numbers] = None,
    boundary: Optional[_Boundary] = None,
    threads: SupportsIndex = 0,
    progress: _Progress = None,
) -> NDArray[np.float64]: ...
def mesh_coverage(
    mesh: _MeshLike,
    positions: ArrayLike,
    radius: SupportsFloat,
    *,
    threads: SupportsIndex = 0,
    progress: _Progress = None,
) -> CoverageReport: ...
def mesh_uncovered_fraction(
    mesh: _MeshLike,
    positions: ArrayLike,
    radius: SupportsFloat,
    *,
    probes: SupportsIndex = 100000,
    seed: SupportsIndex = 0,
    threads: SupportsIndex = 0,
    progress: _Progress = None,
) -> float: ...
def plane_measure(
    positions: ArrayLike,
    *,
    domain_min: Optional[_Numbers] = None,
    domain_max: Optional[_Numbers] = None,
    boundary: Optional[_Boundary] = None,
    threads: SupportsIndex = 0,
    progress: _Progress = None,
) -> PlaneReport: ...
def plane_nearest_histogram(
    positions: ArrayLike,
    reach: SupportsFloat,
    bins: SupportsIndex,
    *,
    domain_min: Optional[_Numbers] = None,
    domain_max: Optional[_Numbers] = None,
    boundary: Optional[_Boundary] = None,
    threads: SupportsIndex = 0,
    progress: _Progress = None,
) -> NDArray[np.uint64]: ...
def plane_radial_distribution(
    positions: ArrayLike,
    reach: SupportsFloat,
    bins: SupportsIndex,
    *,
    domain_min: Optional[_Numbers] = None,
    domain_max: Optional[_Numbers] = None,
    boundary: Optional[_Boundary] = None,
    threads: SupportsIndex = 0,
    progress: _Progress = None,
) -> NDArray[np.float64]: ...
