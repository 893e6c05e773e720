/**
 * Blue-noise sampling: maximal Poisson-disk sets of the plane, of triangle meshes and of boxes, relaxation, thinning,
 * analysis.
 *
 * A radius is the smallest distance between two samples, centre to centre. Positions are packed: x y or x y z of each
 * sample. The same options and seed give the same bytes, everywhere. Calls run to their end before they return; use
 * a worker for long ones. Refusals are thrown as an Error whose message begins with the name of the argument.
 */

/** Numbers, packed: a typed array or an ordinary one. They are copied. */
export type Numbers = ArrayLike<number>;

/** A whole number from 0 to 2^64 - 1; above 2^53 - 1 a bigint. */
export type Seed = number | bigint;

/** A module: its bytes, the compiled module, a Response or an address. */
export type Source = URL | string | BufferSource | WebAssembly.Module | Response;

export interface InitOptions {
    /**
     * The threads that calls run on: 0, one for each processor, to 256; default 1. Results do not depend on it. More than one
     * need memory that threads share, which browsers give to pages that are isolated (`crossOriginIsolated`); elsewhere calls
     * run on one. The main thread of a page may not wait for others, and is refused more than one.
     */
    threads?: number;
    /** The module of one thread; default `azulejo.wasm` beside the script. */
    source?: Source | null;
    /** The module of several threads; default `azulejo-threads.wasm` beside the script. */
    threadedSource?: Source | null;
}

/** Loads the module, once; must be awaited before all other calls. A `Source` is that of the options. */
export function init(options?: InitOptions | Source): Promise<void>;

/** The number of threads that calls run on: 1, or that of `init` where threads can share memory. */
export let threads: number;

/** Ends the threads and forgets the module, all meshes, planes and sets in its memory included; `init` loads it anew. */
export function close(): Promise<void>;

/**
 * Called with the fraction of a call that is done, from 0 to 1, after each piece of its work. If it returns false, the call throws
 * `Cancelled`, but for relaxations, which return their state, with `stopped` `cancelled`. What it throws, the call throws. It must
 * not make other calls, nor free anything.
 */
export type Progress = (done: number) => unknown;

export interface Watched {
    /** Called with the fraction that is done; null, the default: nothing is. */
    progress?: Progress | null;
}

/** What is thrown where a callback ended a call. */
export class Cancelled extends Error {}

/** A rectangle of the plane; its samples have `domainMin <= x < domainMax`. */
export interface Domain {
    /** The lower corner; default [0, 0]. */
    domainMin?: readonly [number, number];
    /** The upper corner; default [1, 1]. */
    domainMax?: readonly [number, number];
    /** `periodic`, the default: a torus. `bounded`: nothing lies outside. */
    boundary?: "periodic" | "bounded";
}

export interface Given {
    /** Existing samples, packed: they stay, are not returned, and cover what is within their clearance. */
    givenPositions?: Numbers | null;
    /** The clearance of each, 0 or more; by default the radius of the set. */
    givenClearances?: Numbers | null;
}

export interface Ordering {
    /** `progressive`: every prefix of the set is blue noise, and samples have ranks. Default `any`. */
    order?: "any" | "progressive";
    /** Of a progressive order: every prefix covers within this times its last rank, 1.02 to 1.5; default 2^(1/8). */
    quotient?: number;
}

export interface PlaneOptions extends Domain, Given, Ordering, Watched {
    /** The smallest distance of two samples, in the units of the domain. Required, unless there is a count. */
    radius?: number;
    /** The exact number of samples; 0, the default: as many as the radius gives. */
    count?: number;
    /** The shortest side of the leaves that tile the domain, in radii: at least 6, default 20. */
    leafSize?: number;
    /** Another seed gives another set. Default 0. */
    seed?: Seed;
    /** Of a progressive order: the radius of the coarsest level. Default Infinity: as coarse as the domain. */
    coarsest?: number;
}

export interface PlaneSamples {
    /** x y of each sample. */
    positions: Float32Array;
    /** In progressive order the rank of each: samples up to it are at least so far apart. Ranks never rise. */
    ranks?: Float32Array;
}

/** A maximal Poisson-disk set: no two samples are closer than the radius, no place is farther than it from all. */
export function kdrtSample(options: PlaneOptions): PlaneSamples & {
    /** The radius, that of the options or the one found for the count. */
    radius: number;
    /** True if the set is maximal for the radius. */
    isMaximal: boolean;
};

/**
 * Makes the set of kdrtSample and passes it on part by part, in its order, instead of keeping it: for sets that memory does not
 * hold. `visit`: called with each part, windows of at most about 50,000 samples, x y each; a domain that is too small to be tiled
 * is one part. If it returns false, the call throws `Cancelled`; what it throws, the call throws. It must not make other calls.
 * In no progressive order, nor to a count.
 */
export function kdrtStream(visit: (positions: Float32Array) => unknown, options: PlaneOptions): void;

/** The samples of a plane in a window, without the rest of the plane. */
export function kdrtSampleWindow(
    options: PlaneOptions,
    windowMin: readonly [number, number],
    windowMax: readonly [number, number],
): PlaneSamples;

/**
 * Samples of several classes. `radii`: a symmetric matrix, row by row, of the smallest distance of samples of two classes.
 * The `radius` and `count` of the options must be 0. `givenClearances` have a number for each class, given sample by given
 * sample. In progressive order each class is sorted coarse to fine.
 */
export function kdrtSampleClasses(options: PlaneOptions, radii: Numbers): PlaneSamples & {
    /** The class of each sample: its row in the matrix. */
    classes: Uint32Array;
};

export interface MaximalOptions extends Domain, Watched {
    /** The smallest distance of two samples, in the units of the domain. Required. */
    radius: number;
    /** Another seed gives another set. Default 0. */
    seed?: Seed;
}

/** A maximal set without the bias of tiles: slower, a reference. */
export function maximalSample(options: MaximalOptions): {
    /** x y of each sample. */
    positions: Float32Array;
};

/** A set of a part of a plane, of whose samples no two are closer than the radius. */
export interface Piece {
    /** x y of each sample, with `min <= x < max`. */
    positions: Numbers;
    /** The lower corner of its rectangle; rectangles do not overlap. */
    min: readonly [number, number];
    /** The upper corner. */
    max: readonly [number, number];
}

export interface KdrtMergeOptions extends Domain, Watched {
    /** The smallest distance of two samples, that of the pieces. Required. */
    radius: number;
    /** Another seed fills the seams differently. Default 0. */
    seed?: Seed;
    /** True: the pieces are maximal, at least farther than the radius from their edges; only seams are tested. Default 0, false. */
    maximalPieces?: boolean;
}

/** One maximal set of pieces, without seams. `fixed`: points that stay, the first samples of the result, x y each. */
export function kdrtMerge(pieces: Iterable<Piece>, options: KdrtMergeOptions, fixed?: Numbers | null): {
    /** x y of each sample. */
    positions: Float32Array;
    /** The number of samples of the pieces that are in the result. */
    kept: number;
    /** The number of those that are not. */
    eliminated: number;
    /** The number of new samples. */
    inserted: number;
};

/**
 * The matrix of classes of own radii, row by row, with the cross radii of Wei (2010) times `factor`, 1 by default: with less the
 * classes depend less on each other.
 */
export function classesRadii(own: Numbers, factor?: number): Float64Array;

/** Something in the module's memory: freed by `free`, by `using`, or some time after nothing refers to it. */
declare class Handle {
    /** Frees it; may be called again. */
    free(): void;
    [Symbol.dispose](): void;
}

/** The common part of all windows of a plane, made once. */
export class KdrtPlane extends Handle {
    /** `radii`: of several classes, as in kdrtSampleClasses. */
    constructor(options: PlaneOptions, radii?: Numbers | null);
    /** The samples with `windowMin <= x < windowMax`. */
    window(windowMin: readonly [number, number], windowMax: readonly [number, number]): PlaneSamples & {
        /** Of several classes: that of each sample. */
        classes?: Uint32Array;
    };
}

/** What a mesh may have beside its triangles. */
export interface MeshDress {
    /** Normals, x y z each: one for each vertex, or any number with `normalIndices`. Samples have them interpolated. */
    normals?: Numbers | null;
    /** Three normals of each triangle, those of its corners. */
    normalIndices?: Numbers | null;
    /** True or not 0 for each triangle that takes samples; others get none and need not be covered. */
    mask?: ArrayLike<number | boolean> | null;
}

/** Where samples lie on a mesh. */
export interface Places {
    /** The triangle of each. */
    triangles: Numbers;
    /** u v of each: its position is (1 - u - v) a + u b + v c of the triangle's corners. */
    barycentrics: Numbers;
}

/** Triangles in space; they need not be connected. A mesh does not change: its methods return others. */
export class Mesh extends Handle {
    /** `positions`: x y z of each vertex. `indices`: three vertices of each triangle. */
    constructor(positions: Numbers, indices: Numbers, options?: MeshDress);
    /** The area of all triangles that the mask does not leave out. */
    readonly area: number;
    /** The number of its vertices. */
    readonly vertexCount: number;
    /** The number of its triangles. */
    readonly triangleCount: number;
    /**
     * A mesh from the bytes of a file: OBJ, PLY, STL, OFF or GLB, by the extension of its name or else by its contents. Polygons
     * become triangles.
     */
    static parse(name: string, bytes: ArrayBuffer | Uint8Array): Mesh;
    /** The mesh with normals in place of those that it may have. */
    withNormals(normals: Numbers, normalIndices?: Numbers | null): Mesh;
    /** The mesh with a mask in place of the one that it may have. */
    withMask(mask: ArrayLike<number | boolean>): Mesh;
    /** The mesh with its vertices moved: triangles and mask stay, normals go. `positions`: x y z of each vertex. */
    deform(positions: Numbers): Mesh;
    /** The samples at places, such as those of samples on a mesh that was deformed since; to the bit on the mesh itself. */
    points(samples: Places): SurfaceSamples;
    /** True if an even number of triangles shares each edge, so that the mesh has an inside. */
    isClosed(): boolean;
    /**
     * For each position, x y z, 1 if it is inside the mesh, else 0: without error of a closed mesh, otherwise by the generalised
     * winding number.
     */
    contains(positions: Numbers, options?: Watched): Uint8Array;
    /**
     * Copies of its arrays: x y z of each vertex, less the `origin`; three vertices of each triangle; and `normals`,
     * `normalIndices` and the `mask`, 1 where samples are taken, if it has them.
     */
    arrays(): {
        positions: Float32Array;
        indices: Uint32Array;
        origin: Float64Array;
        normals?: Float32Array;
        normalIndices?: Uint32Array;
        mask?: Uint8Array;
    };
}

/** Of iterations: what projects patterns, and which candidate is kept. */
export interface Projection {
    /** `local`, the default: a projector for each part that faces about one direction. `global`: three for the whole mesh. */
    projectors?: "local" | "global";
    /** Of two candidates, `squareness`, the default, keeps the more squarely faced, `projector` that of the earlier one. */
    priority?: "squareness" | "projector";
}

export interface SurfaceOptions extends Given, Ordering, Projection, Watched {
    /** The smallest straight distance of two samples, in the units of the mesh. Required, unless there is a count. */
    radius?: number;
    /** The exact number of samples; 0, the default: as many as the radius gives. */
    count?: number;
    /** Another seed gives another set. Default 0. */
    seed?: Seed;
    /** Samples on triangles whose normals have a smaller cosine ignore each other; -1, the default: none do. */
    cosine?: number;
    /** The number of projections of patterns before gaps are filled; -1, the default: as the library chooses. */
    iterations?: number;
    /** True: gaps are filled; default true. */
    maximal?: boolean;
}

export interface SurfaceSamples {
    /** x y z of each sample. */
    positions: Float32Array;
    /** The unit normal of its triangle, x y z. */
    normals: Float32Array;
    /** The triangle that it lies on. */
    triangles: Uint32Array;
    /** u v of each sample: its position is (1 - u - v) a + u b + v c of the triangle's corners. */
    barycentrics: Float32Array;
    /** As those of PlaneSamples. */
    ranks?: Float32Array;
    /** If the mesh has normals: theirs, interpolated, x y z. */
    interpolatedNormals?: Float32Array;
}

/** What is reported of a set on a mesh. */
export interface SurfaceReport {
    /** The radius, that of the options or the one found for the count; of classes the smallest own radius; 0 where radii vary. */
    radius: number;
    /** A bound of the distance of any place from the samples, where one is known; where radii vary, of their factor. */
    coveringRadius?: number;
    /**
     * The radius over the distance of neighbours if as many samples stood in hexagonal order on the mesh's area; 0 of classes and
     * where radii vary.
     */
    rho: number;
    /** The number of projections of patterns that were made. */
    iterations: number;
    /** The number of darts that were thrown at uncovered surface. */
    darts: number;
    /** The share of the area that was uncovered before gaps were filled, if they were and it is known. */
    uncoveredBefore?: number;
    /** The share that is uncovered after it. */
    uncoveredAfter?: number;
}

/** A Poisson-disk set on a mesh, maximal unless the options say otherwise. */
export function pspSample(mesh: Mesh, options: SurfaceOptions): SurfaceSamples & SurfaceReport;

/** Options of sets on a mesh whose radius varies. */
export interface VaryingOptions extends Given, Ordering, Watched {
    /** Another seed gives another set. Default 0. */
    seed?: Seed;
    /** Samples on triangles whose normals have a smaller cosine ignore each other; -1, the default: none do. */
    cosine?: number;
}

/** The density of a set on a mesh, in any unit, 0 or more, and what it means: `radius` or `count`. */
export interface MeshDensity {
    /** A number for each vertex, interpolated on the triangles; or the pixels of an image, row by row. */
    values: Numbers;
    /** The radius where the density is 1. */
    radius?: number;
    /** About how many samples the set has, exactly in progressive order; of classes one of radius 1 by itself. */
    count?: number;
    /** Of an image: pixels in a row, over which u goes from 0 to 1. */
    width?: number;
    /** Of an image: rows, the first of which lies along v = 0. */
    height?: number;
    /** Of an image: u v of each vertex, or else of the three corners of each triangle. */
    texture?: Numbers | null;
}

export interface VaryingSamples extends SurfaceSamples {
    /** The radius of each sample: two are at least the mean of theirs apart. */
    radii: Float64Array;
}

/**
 * A maximal set on a mesh with a radius for each vertex, interpolated on the triangles. Given samples need clearances. In
 * progressive order the rank of a sample is what the radii of all samples up to it are multiplied by, and the `radius` of the
 * report is 1.
 */
export function pspAdaptiveSample(mesh: Mesh, options: VaryingOptions, vertexRadii: Numbers): VaryingSamples & SurfaceReport;

/**
 * A maximal set on a mesh whose radius follows from a density; ranks are radii at density 1, as is the `radius` of the report in
 * progressive order.
 */
export function pspAdaptiveWithDensity(mesh: Mesh, options: VaryingOptions, density: MeshDensity): VaryingSamples & SurfaceReport;

/** Options of sets of several classes on a mesh. */
export interface ClassOptions extends VaryingOptions {
    /** Of each triangle the classes that it takes, bit i for class i; by default all. */
    masks?: Numbers | null;
}

export interface ClassSamples extends SurfaceSamples {
    /** The class of each sample: its row in the matrix. */
    classes: Uint32Array;
}

/** Samples of several classes on a mesh; `radii` and clearances as in kdrtSampleClasses. */
export function pspSampleClasses(mesh: Mesh, options: ClassOptions, radii: Numbers): ClassSamples & SurfaceReport;

/**
 * The same where the radii are multiples of a local radius, which follows from a density: two samples keep the number of the
 * matrix times the mean of their local radii. With a `radius` of 1 `radii` are those at density 1.
 */
export function pspClassesWithDensity(
    mesh: Mesh,
    options: ClassOptions,
    radii: Numbers,
    density: MeshDensity,
): ClassSamples & SurfaceReport & {
    /** The local radius of each sample. */
    radii: Float64Array;
};

/** A ball, a box, or what both have in common; by default everywhere. Two numbers for each place in the plane, or three. */
export interface Region {
    /** The centre of the ball. */
    centre?: readonly number[] | null;
    /** The radius of the ball. */
    radius?: number | null;
    /** The lower corner of the box. */
    min?: readonly number[] | null;
    /** The upper corner of the box. */
    max?: readonly number[] | null;
}

/** Samples of the plane with their ids. */
export interface EditedPlaneSamples {
    /** x y of each sample. */
    positions: Float32Array;
    /** The id of each: a whole number that it keeps until it is erased, and that no other sample ever gets. */
    ids: Float64Array;
}

/** Samples of a mesh with their ids. */
export interface EditedSurfaceSamples extends SurfaceSamples {
    /** As those of EditedPlaneSamples; none before the first edit. */
    ids: Float64Array;
}

/**
 * A set that is edited. To undo a stroke of a brush, erase what `refill` added by its ids, and restore what `erase` returned:
 * the set is then as before, to the bit. To redo it, erase the same region and refill with the same seed.
 */
declare class EditedSet<Samples> extends Handle {
    /** A copy of the set as it is. */
    points(): Samples;
    /** Erases the samples in a region, and returns them. On a torus it may reach over the seam. */
    erase(region?: Region): Samples;
    /** Erases samples by their ids, and returns them. */
    eraseIds(ids: Numbers): Samples;
    /** Puts samples back that were erased; refused if one is too close to a sample or a given one by now. */
    restore(samples: Samples): void;
    /**
     * Adds given samples to those that the set was made with; samples that are too close to one are erased. `first`: the id
     * of the first of them, which the others follow.
     */
    addGiven(positions: Numbers, clearances?: Numbers | null): { first: number; erased: Samples };
    /** Removes given samples by their ids: 0, 1, 2 and so on for those that the set was made with. */
    removeGiven(ids: Numbers): void;
    /** Makes the set maximal again, and returns the new samples; looks only where edits can have left gaps. */
    refill(seed?: Seed, options?: Watched): Samples;
}

export interface EditedPlaneOptions extends Domain, Given, Watched {
    /** The smallest distance of two samples, in the units of the domain. Required. */
    radius: number;
    /** The shortest side of the leaves that tile the domain, in radii: at least 6, default 20. */
    leafSize?: number;
    /** Another seed gives another set. Default 0. */
    seed?: Seed;
}

/** A set of the plane that is edited: that of kdrtSample, or any `positions` of which no two are closer than the radius. */
export class Plane extends EditedSet<EditedPlaneSamples> {
    constructor(options: EditedPlaneOptions, positions?: Numbers | null);
}

export interface GrowingOptions extends Given, Projection {
    /** The smallest straight distance of two samples, in the units of the mesh. Required. */
    radius: number;
    /** Another seed gives another set. Default 0. */
    seed?: Seed;
    /** Samples on triangles whose normals have a smaller cosine ignore each other; -1, the default: none do. */
    cosine?: number;
}

/** A set on a mesh, empty at first, that grows, call by call, and is edited. */
export class Psp extends EditedSet<EditedSurfaceSamples> {
    constructor(mesh: Mesh, options: GrowingOptions);
    /** Adds samples by projections of patterns, until the first edit; returns their number. */
    advance(iterations: number, options?: Watched): number;
    /** Adds samples until the set is maximal; returns their number. */
    fill(options?: Watched): number;
}

export interface VolumeOptions extends Cuboid, Given, Ordering, Watched {
    /** The smallest distance of two samples, in the units of the domain. Required, unless there is a count. */
    radius?: number;
    /** The exact number of samples; 0, the default: as many as the radius gives. Given samples then need clearances. */
    count?: number;
    /** Another seed gives another set. Default 0. */
    seed?: Seed;
    /** The shortest side of a leaf of a tiled set, in radii, at least 6, without a count or an order; 0, the default: not tiled. */
    leafSize?: number;
}

/** A maximal Poisson-disk set of a cuboid. */
export function volumeSample(options: VolumeOptions): {
    /** x y z of each sample. */
    positions: Float32Array;
    /** As those of PlaneSamples. */
    ranks?: Float32Array;
    /** The radius, that of the options or the one found for the count. */
    radius: number;
    /** A bound of the distance of any place of the cuboid from the samples: for a count it is above the radius. */
    coveringRadius: number;
};

export interface VolumeClassesOptions extends Cuboid, Given, Watched {
    /** Another seed gives another set. Default 0. */
    seed?: Seed;
}

/**
 * Samples of several classes in a cuboid, sorted by class. `radii`: a symmetric matrix, row by row, of the smallest distance of
 * samples of two classes. `givenClearances` have a number for each class, given sample by given sample.
 */
export function volumeSampleClasses(options: VolumeClassesOptions | undefined, radii: Numbers): {
    /** x y z of each sample. */
    positions: Float32Array;
    /** The class of each sample: its row in the matrix. */
    classes: Uint32Array;
};

export interface VolumeInsideOptions extends Given, Ordering, Watched {
    /** The smallest distance of two samples, in the units of the mesh. Required, unless there is a count. */
    radius?: number;
    /** The exact number of samples; 0, the default: as many as the radius gives. Given samples then need clearances. */
    count?: number;
    /** `open`, the default: samples lie anywhere inside. `first`: a maximal set of the surface comes first. */
    surface?: "open" | "first";
    /** Places may stay open nearer to the surface than sqrt(3) times this many radii: 1/256 to 1/2; default 0.0625. */
    tolerance?: number;
    /** Only places that are no farther from the surface than this: at least 1/256 radius. Default 0: all of the inside. */
    thickness?: number;
    /** Another seed gives another set. Default 0. */
    seed?: Seed;
}

/** A maximal Poisson-disk set of the inside of a mesh, of which an even number of triangles share each edge. */
export function volumeSampleInside(mesh: Mesh, options: VolumeInsideOptions): {
    /** x y z of each sample. */
    positions: Float32Array;
    /** As those of PlaneSamples. */
    ranks?: Float32Array;
    /** The radius, that of the options or the one found for the count. */
    radius: number;
    /** A bound of the distance of any place that is deeper than `depth` from the samples. */
    coveringRadius: number;
    /** The greatest distance from the surface at which places can be open. */
    depth: number;
    /** The number of samples of the surface, which come first. */
    surfaceSamples: number;
};

/** Options of sets of volumes whose radius varies. */
export interface VaryingVolumeOptions extends Cuboid, Watched {
    /** With a mesh, in radii: places may stay open nearer to the surface than sqrt(3) times this; default 0.0625. */
    tolerance?: number;
    /** Another seed gives another set. Default 0. */
    seed?: Seed;
}

/**
 * A maximal set of a cuboid, or with a mesh of its inside, with radii on a grid of `gridSize`, numbers along x, y and z; x is the
 * fastest. The grid lies over the cuboid or the box around the mesh, with points on all faces, and is linear between them.
 */
export function volumeAdaptiveSample(
    options: VaryingVolumeOptions,
    gridValues: Numbers,
    gridSize: readonly [number, number, number],
    mesh?: Mesh | null,
): {
    /** x y z of each sample. */
    positions: Float32Array;
    /** The radius of each sample: two are at least the mean of theirs apart. */
    radii: Float64Array;
    /** The least radius of a sample. */
    radius: number;
    /** The largest radius on the grid: no place is farther from all samples. */
    coveringRadius: number;
};

export interface MaskOptions extends Watched {
    /** The pixels along x: 2 to 1,024, and up to 64 with a depth above 1. Required. */
    width: number;
    /** The pixels along y: 2 to 1,024, and up to 64 with a depth above 1. Required. */
    height: number;
    /** The pixels along z: 1, the default, is a mask of the plane; up to 64, one of space. */
    depth?: number;
    /** The number of independent masks: 1 to 64; default 1. */
    channels?: number;
    /** Another seed gives another mask. Default 0. */
    seed?: Seed;
    /** The standard deviation, in pixels, of the Gaussian by which voids and clusters are found: 0.5 to 4; default 1.5. */
    sigma?: number;
}

/**
 * The ranks of a blue-noise mask by void and cluster, a torus of pixels: channel by channel, in it x first, then y, then z. Each
 * rank from 0 to the number of pixels - 1 occurs once in a channel. An image is dithered by comparing it with
 * (rank + 0.5) / pixels, the mask repeated like a tile.
 */
export function maskCreate(options: MaskOptions): Uint32Array;

/** An image: a number for each pixel and channel, those of one pixel after each other; x first, then y, then z. */
export interface DitheredImage {
    /** Bytes from 0 to 255 in a Uint8Array or Uint8ClampedArray; in other arrays numbers, of which 0 to 1 count. Required. */
    values: Numbers;
    /** The pixels along x. Required. */
    width: number;
    /** The pixels along y. Required. */
    height: number;
    /** The pixels along z; default 1. */
    depth?: number;
    /** The numbers of a pixel; default 1. */
    channels?: number;
}

/**
 * An image in 2 to 256 levels, by default 2: for each of its numbers the level, 0 to `levels` - 1. `ranks`: those of
 * maskCreate, with the options `mask`; the mask is repeated over the image, its channels over those of the image. Light adds
 * up where numbers are linear, which those of sRGB are not.
 */
export function maskDither(ranks: Numbers, mask: MaskOptions, image: DitheredImage, levels?: number): Uint8Array;

/** The options from `conflictRadius` on are of the thesis's method, and refused of the other one. */
export interface RelaxOptions extends Domain, Watched {
    /** `delaunay`, the default: neighbours keep their distance and close holes. `nearest`: they only repel. */
    neighbourhood?: "delaunay" | "nearest";
    /** `momentum`, the default, or `thesis`: the algorithm of the thesis, chapter 4. */
    method?: "momentum" | "thesis";
    /** The largest number of steps; default 100. */
    maxIterations?: number;
    /** The motion at which the set has converged; by default 0.001, of the thesis 0.02, with nearest neighbours 0.005. */
    tolerance?: number | null;
    /** Used where points coincide only. Default 0. */
    seed?: Seed;
    /** Neighbours closer than this, in units of d_max, repel each other; default 0.95. */
    conflictRadius?: number | null;
    /** Delaunay neighbours farther apart than this, in units of d_max, attract each other; default 1.05. */
    attractionRadius?: number | null;
    /** The displacement by a tension of 1, in units of d_max; default 0.05. */
    step?: number | null;
    /** The factor of `step` from each step to the next; default 1. */
    decay?: number | null;
    /** The number of nearest neighbours; default 6. */
    neighbours?: number | null;
    /** The division of an edge's tension between its ends; default activeness. */
    distribution?: "activeness" | "average" | "dominant" | "zero" | "eighty_twenty" | null;
    /** The ends from which an edge is visited; default both_ends. */
    visits?: "both_ends" | "one_end" | null;
    /** The test of convergence; default motion. */
    convergence?: "motion" | "variance" | null;
}

export interface Relaxation {
    /** The number of steps made. */
    iterations: number;
    /** Why there were no more. */
    stopped: "converged" | "steps" | "cancelled";
    /** Half of the distance that points moved over the last 10 steps, root mean square, in units of d_max. */
    motion: number;
    /** The smallest distance of two points, in the units of the domain or mesh. */
    smallestDistance: number;
    /** The same in units of d_max, the distance of neighbours in hexagonal arrangement. */
    rho: number;
}

/** Moves points, x y each, until they are evenly spread. */
export function dcrRelax(positions: Numbers, options?: RelaxOptions): Relaxation & {
    /** x y of each point, in the order in which they came. */
    positions: Float32Array;
    /** The largest distance of a place of the domain from the set, in units of d_max. */
    relativeCoveringRadius: number;
};

/** Moves points of several classes until all together and each class by itself are spread more evenly. */
export function dcrRelaxClasses(
    positions: Numbers,
    classes: Numbers,
    options?: Domain & Watched & {
        /** The largest number of steps; default 100. */
        maxIterations?: number;
        /** The motion at which the set has converged; default 0.001. */
        tolerance?: number;
        /** Used where points coincide only. Default 0. */
        seed?: Seed;
    },
): Relaxation & {
    /** x y of each point, in the order in which they came. */
    positions: Float32Array;
    /** The largest distance of a place of the domain from the set, in units of d_max. */
    relativeCoveringRadius: number;
    /** The rho of each class, in units of the d_max of its own number of points. */
    classRho: Float64Array;
    /** The covering radius of each class in the same units. */
    classRelativeCoveringRadius: Float64Array;
};

/**
 * Moves points of a torus, x y each, until their pair correlation is the one wanted: `correlation` has g(r) in bins of equal
 * width up to `reach`, in units of d_max. A correlation that no set has ends with its residual.
 */
export function dcrRelaxToCorrelation(
    positions: Numbers,
    correlation: Numbers,
    reach: number,
    options?: Domain & Watched & {
        /** The largest number of steps; default 100. */
        maxIterations?: number;
        /** The residual at which the set has converged; default 0.005. */
        tolerance?: number;
        /** Used where points coincide or lie on one line only. Default 0. */
        seed?: Seed;
    },
): Relaxation & {
    /** x y of each point, in the order in which they came. */
    positions: Float32Array;
    /** The largest distance of a place of the domain from the set, in units of d_max. */
    relativeCoveringRadius: number;
    /** The root mean square of the difference of the radial power and the one wanted, both smoothed over about 1 / reach. */
    residual: number;
};

/**
 * The pair correlation, in `bins` bins up to `reach` (12 d_max), of sets whose radial power is constant in each of the bins of
 * `power` from 0 to the frequency `highest`, in units of sqrt(density), and 1 beyond.
 */
export function dcrCorrelationOfPower(power: Numbers, highest: number, reach?: number, bins?: number): Float64Array;

/** A cuboid; its points have `domainMin <= x < domainMax`. */
export interface Cuboid {
    /** The lower corner; default [0, 0, 0]. */
    domainMin?: readonly [number, number, number];
    /** The upper corner; default [1, 1, 1]. */
    domainMax?: readonly [number, number, number];
    /** `periodic`, the default: a torus. `bounded`: nothing lies outside. */
    boundary?: "periodic" | "bounded";
}

export interface VolumeRelaxOptions extends Cuboid, Watched {
    /** The largest number of steps; default 100. */
    maxIterations?: number;
    /** The motion at which the set has converged; default 0.001. */
    tolerance?: number;
    /** Used where points coincide or are clustered only. Default 0. */
    seed?: Seed;
}

/**
 * Moves points of a cuboid, x y z each, until they are evenly spread. The unit of `motion` and `rho` is the distance of
 * neighbours in the densest packing of as many points.
 */
export function volumeRelax(
    positions: Numbers,
    options?: VolumeRelaxOptions,
): Relaxation & {
    /** x y z of each point, in the order in which they came. */
    positions: Float32Array;
};

export interface VolumeRelaxInsideOptions extends Watched {
    /** True for each point that stays where it is; default: none does. */
    fixed?: ArrayLike<number | boolean> | null;
    /** True for each point that stands on the surface and moves along it; default: none does. No point is fixed and sliding. */
    sliding?: ArrayLike<number | boolean> | null;
    /** The largest number of steps; default 100. */
    maxIterations?: number;
    /** The motion at which the set has converged; default 0.001. */
    tolerance?: number;
    /** Used where points coincide only. Default 0. */
    seed?: Seed;
}

/**
 * Moves points inside a mesh, x y z each, until they are evenly spread. None leaves the inside; those that are fixed, such
 * as the first `surfaceSamples` of volumeSampleInside, need only be in the box around the mesh, those that slide on its surface.
 */
export function volumeRelaxInside(
    mesh: Mesh,
    positions: Numbers,
    options?: VolumeRelaxInsideOptions,
): Relaxation & {
    /** x y z of each point, in the order in which they came. */
    positions: Float32Array;
};

/** An image of densities, 0 or more and not 0 everywhere, in any unit, that is stretched over the domain. */
export interface DensityImage {
    /** The pixels, row by row; the first row lies along the lower side of the domain. */
    values: Numbers;
    /** Pixels in a row. */
    width: number;
    /** Rows. */
    height: number;
}

/** Random points with a density, x y of each: a start for dcrRelaxDensity. */
export function dcrScatter(
    density: DensityImage,
    count: number,
    options?: Domain & Watched & {
        /** Another seed gives other points. Default 0. */
        seed?: Seed;
    },
): { positions: Float32Array };

/** Moves points, x y each, until they are spread as a density wants: stippling. Lengths are in units of the local spacing. */
export function dcrRelaxDensity(
    positions: Numbers,
    density: DensityImage,
    options?: Domain & Watched & {
        /** The largest number of steps; default 100. */
        maxIterations?: number;
        /** The motion at which the set has converged; default 0.001. */
        tolerance?: number;
        /** Used where points coincide or are far from the density. Default 0. */
        seed?: Seed;
    },
): Relaxation & {
    /** x y of each point, in the order in which they came. */
    positions: Float32Array;
    /** The largest circumradius of three neighbours, in units of the local spacing. */
    relativeCoveringRadius: number;
};

export interface SurfaceRelaxOptions extends Watched {
    /** The density that samples shall have, without `radius` and `count`; none end where it is 0. Default: the same everywhere. */
    density?: MeshDensity | null;
    /** The largest number of steps; default 100. */
    maxIterations?: number;
    /** The motion at which the set has converged; default 0.0005. */
    tolerance?: number;
    /** Used where samples coincide, or are redistributed. Default 0. */
    seed?: Seed;
}

/** Moves samples over their mesh until they are evenly spread. */
export function dcrSurfaceRelax(
    mesh: Mesh,
    samples: Places,
    options?: SurfaceRelaxOptions,
): SurfaceSamples & Relaxation;

/**
 * Makes a mesh whose vertices are samples of another mesh, spread about evenly as those of maximal and relaxed sets are:
 * remeshing, to more triangles or to fewer. No edge has more than two triangles, and two at an edge are wound alike. Samples that
 * resolve the features of a closed surface give a closed surface of the same topology; otherwise there are holes.
 */
export function dcrRemesh(mesh: Mesh, samples: Places, options?: Watched): {
    /** Its vertex i is sample i. */
    mesh: Mesh;
    /** The number of triangles. */
    triangles: number;
    /** Triangles that are not in the Delaunay stars of all three corners. */
    disputed: number;
    /** Triangles of stars that are not in the mesh, because they do not go with others. */
    leftOut: number;
    /** Edges with one triangle: the boundary. */
    boundaryEdges: number;
    /** Edges with two triangles. */
    innerEdges: number;
    /** Edges with more than two: always 0. */
    nonManifoldEdges: number;
    /** Samples whose triangles are not all connected by edges at the sample. */
    nonManifoldVertices: number;
    /** Samples without a triangle. */
    unusedVertices: number;
    /** Vertices - edges + triangles, without unused vertices: 2 of a sphere, 0 of a torus, 1 of a disk. */
    euler: number;
    /** The smallest angle of all triangles, in degrees. */
    smallestAngle: number;
    /** The largest angle of all triangles, in degrees. */
    largestAngle: number;
    /** The mean over all triangles of their smallest angle, in degrees. */
    meanSmallestAngle: number;
};

export interface ThinOptions extends Watched {
    /** The smallest distance of selected points; 0, the default, sets none. */
    radius?: number;
    /** The number of points to select; 0, the default, sets no number. */
    count?: number;
    /** `progressive`: farthest-first. Default `any`: that of the cloud. */
    order?: "any" | "progressive";
    /** Selects the first point of the progressive order. Default 0. */
    seed?: Seed;
}

/** Points of a cloud, 2 or 3 numbers each, that are far from each other and near to all others. */
export function thin(
    positions: Numbers,
    dimensions: 2 | 3,
    options: ThinOptions,
): {
    /** The selected points. */
    indices: Uint32Array;
    /** In progressive order, the distance of each from those before it. */
    ranks?: Float32Array;
};

export interface Spacing {
    /** The smallest distance of two points; Infinity for less than two. */
    smallestDistance: number;
    /** The distance from the set of the place that is farthest from it. */
    coveringRadius: number;
}

/** What is measured of points of the plane. */
export interface PlaneFigures extends Spacing {
    /** The number of points. */
    count: number;
    /** The mean distance of a point to its nearest neighbour. */
    meanDistance: number;
    /** d_max, the distance of neighbours if as many points stood in hexagonal order. */
    hexagonalDistance: number;
    /** The smallest distance in units of d_max. */
    rho: number;
    /** The bond order psi6: 1 of a hexagonal lattice. */
    bondOrder: number;
    /** The number of Delaunay triangles. */
    triangles: number;
    /** The share of them that is obtuse. */
    obtuse: number;
    /** The share of them with an angle below 30 degrees. */
    below30Degrees: number;
    /** The share of all angles that is below 30 degrees. */
    anglesBelow30Degrees: number;
    /** The mean length of their edges. */
    edgeMean: number;
    /** The variance of the lengths over the square of their mean. */
    edgeVariation: number;
    /** The variance of the areas over the square of their mean. */
    areaVariation: number;
    /** The share of triangles whose area is more than 4 standard deviations from the mean. */
    beyond4Sigma: number;
}

/** Measures points of the plane, x y each: spacing, covering radius, bond order and Delaunay triangles. */
export function planeMeasure(positions: Numbers, options?: Domain & Watched): PlaneFigures;

/** The smallest distance of points of the plane alone, x y each; Infinity for less than two. */
export function planeSmallestDistance(positions: Numbers, options?: Domain & Watched): number;

/** The covering radius of points of the plane alone, x y each: exact, by the Voronoi diagram. */
export function planeCoveringRadius(positions: Numbers, options?: Domain & Watched): number;

/** The number of points whose nearest neighbour is in each of `bins` bins of equal width from 0 to `reach`, in units of d_max. */
export function planeNearestHistogram(
    positions: Numbers,
    reach: number,
    bins: number,
    options?: Domain & Watched,
): Uint32Array;

/** What is measured of points of a cuboid. */
export interface SpaceSpacing extends Spacing {
    /** The number of points. */
    count: number;
    /** The mean distance of a point to its nearest neighbour. */
    meanDistance: number;
    /** The distance of neighbours if as many points stood in the densest packing. */
    packedDistance: number;
    /** The smallest distance in units of packedDistance. */
    rho: number;
    /** The covering radius in units of packedDistance. */
    relativeCoveringRadius: number;
    /** The number of pairs that are nearer to each other than `radius`. */
    conflicts: number;
    /** The number of gaps that balls of `radius` leave: 0 for a maximal set. */
    gaps: number;
}

/** Measures points of a cuboid, x y z each. */
export function spaceMeasure(
    positions: Numbers,
    options?: Cuboid & Watched & {
        /** Counts conflicts and gaps of this radius; default 0: none. */
        radius?: number;
    },
): SpaceSpacing;

/** Measures positions on a mesh, x y z each; distances are straight. */
export function meshMeasure(mesh: Mesh, positions: Numbers, options?: Watched): Spacing;

export interface Coverage {
    /** The distance from the set of the place that is farthest from it. */
    coveringRadius: number;
    /** The number of connected places that are farther than the radius from the set, by more than the rounding of floats. */
    gaps: number;
}

/** The gaps of points of the plane, x y each, for a radius: 0 of a maximal set. */
export function planeCoverage(positions: Numbers, radius: number, options?: Domain & Watched): Coverage;

/** The gaps of points of a cuboid, x y z each, for a radius; places within half of it of each other are of one gap. */
export function spaceCoverage(positions: Numbers, radius: number, options?: Cuboid & Watched): Coverage;

/**
 * The radial distribution function of points of a cuboid, x y z each, in `bins` bins from 0 to `reach`, in units of
 * packedDistance: 1 where pairs are as frequent as of random points.
 */
export function spaceRadialDistribution(
    positions: Numbers,
    reach: number,
    bins: number,
    options?: Cuboid & Watched,
): Float64Array;

/**
 * The radial curves of the power spectrum of points of a cuboid, x y z each, up to a frequency in units of cbrt(density), as
 * those of the result are.
 */
export function spaceSpectrum(
    positions: Numbers,
    frequencyReach: number,
    options?: Cuboid & Watched & {
        /** 1, the default, takes all frequencies; k, up to 4096, every k-th along the axes. */
        frequencyStride?: number;
        /** The width of a shell; default 0.05. */
        width?: number;
    },
): Annulus[];

/**
 * The power of points of a cuboid, x y z each, on an axis (0 to 2) of frequencies: at 1, 2, ... `count` (up to 65536) waves along
 * a side. 1 is that of random points; planes across the axis show here and not in the radial mean.
 */
export function spaceAxisPower(positions: Numbers, axis: number, count: number, options?: Cuboid & Watched): Float64Array;

/** The gaps of positions on a mesh, x y z each, for a radius. */
export function meshCoverage(mesh: Mesh, positions: Numbers, radius: number, options?: Watched): Coverage;

/** The smallest straight distance of positions in space, x y z each; Infinity for less than two. */
export function spaceSmallestDistance(positions: Numbers, options?: Watched): number;

/** The share of the area of a mesh that is farther than a radius from positions, by random probes. */
export function meshUncoveredFraction(
    mesh: Mesh,
    positions: Numbers,
    radius: number,
    options?: Watched & {
        /** The number of probes; default 100,000. */
        probes?: number;
        /** Other seeds give other probes. Default 0. */
        seed?: Seed;
    },
): number;

/**
 * The radial distribution function of points of the plane, in `bins` bins from 0 to `reach`, in units of d_max: 1 where pairs
 * are as frequent as of random points.
 */
export function planeRadialDistribution(
    positions: Numbers,
    reach: number,
    bins: number,
    options?: Domain & Watched,
): Float64Array;

/** An annulus of a spectrum. */
export interface Annulus {
    /** Its mean frequency, in units of one over the mean spacing: sqrt(density) in the plane. */
    frequency: number;
    /** The mean power: 1 is that of random points. */
    power: number;
    /** The variance of the power over the square of its mean. */
    anisotropy: number;
    /** The number of frequencies. */
    count: number;
}

/** The power spectrum of points of the plane, kept to be measured, and to be averaged with others. */
export class Spectrum extends Handle {
    /** `positions`: x y each. `size`: the number of frequencies along each axis, 2 to 4096. */
    constructor(
        positions: Numbers,
        size: number,
        options?: Domain & Watched & {
            /** 1, the default, takes all frequencies; k, up to 4096, every k-th along both axes. */
            frequencyStride?: number;
        },
    );
    /** The number of frequencies along each axis. */
    readonly size: number;
    /** The mean of spectra of one size; noise fades with the square root of their number. */
    static mean(spectra: Iterable<Spectrum>): Spectrum;
    /** As that of spectrum(). */
    power(): Float32Array;
    /** The annuli of a width in units of sqrt(density), by default 0.05. */
    radial(width?: number): Annulus[];
    /** Its figures: `low` and `high` are the range of frequencies for contrast and peak, `width` is that of the annuli. */
    measure(low: number, high: number, width: number): {
        /** The distance of neighbouring frequencies along both axes, in units of sqrt(density). */
        frequencyStep: [number, number];
        /** Below this frequency there is almost no power (Heck et al. 2013), unless the spectrum is too small to tell. */
        effectiveNyquist?: number;
        /** The variation of the power above it, likewise. */
        oscillation?: number;
        /** The variation of the power within annuli. */
        contrast: number;
        /** The highest power in the range over the mean of its annulus; 0 for none. */
        peak: number;
        /** Where that is. */
        peakFrequency: [number, number];
    };
}

/**
 * The distribution p(d) of the differences of all pairs of samples on a mesh (Wei and Wang 2011), which takes the place of the
 * spectrum. Lengths are in mean spacings, sqrt(area / count).
 */
export class Differences extends Handle {
    constructor(
        mesh: Mesh,
        samples: { positions: Numbers; normals: Numbers },
        options?: Watched & {
            /** Its projection on the tangent plane is the x axis of the differences; default [1, 0, 0]. */
            direction?: readonly [number, number, number];
            /** Other seeds give other random points that pairs are compared with. Default 0. */
            seed?: Seed;
        },
    );
    /** The differences of sets of one kind together; noise fades with the square root of their number. */
    static mean(differences: Iterable<Differences>): Differences;
    /** p(d), 128 rows of 128 numbers, from -4 to 4 along both axes. */
    density(): Float64Array;
    /** The radial mean of p(d), 512 numbers from 0 to 8. */
    radial(): Float64Array;
    /** The radial mean of the power at frequencies from -32 to 32, in units of one over the mean spacing; 1 of random points. */
    power(frequencies: Numbers): Float64Array;
}

/** The power spectrum of points of the plane. */
export function spectrum(
    positions: Numbers,
    options?: Domain & Watched & {
        /** Frequencies along each axis, an even number; default 256. */
        size?: number;
        /** The width of the annuli, in units of sqrt(density); default 0.02. */
        width?: number;
    },
): {
    size: number;
    /** size rows of size powers; frequency 0 is at row and column size / 2. 1 is that of random points. */
    power: Float32Array;
    /** The radial mean: `frequency` in units of sqrt(density). */
    annuli: Annulus[];
};
