// azulejo for JavaScript: blue-noise sampling of planes, triangle meshes and boxes, relaxation, analysis, in WebAssembly.
// index.d.ts documents all calls. Arrays are copied into the memory of the module and results out of it, so that what a call
// returns is an ordinary typed array of the caller's, never on memory that threads share.

let wasm;

// The threads of the module, or null if it is the one without.
let pool = null;

/** The number of threads that calls run on. */
export let threads = 1;

// The call that runs: its callbacks, and what one of them threw.
let running = null;

// Whether a callback lets the call go on: anything but false does. What it throws must not unwind the module.
function ask(callback, argument) {
    if (!callback) return 1;
    try {
        return callback(argument()) === false ? 0 : 1;
    } catch (error) {
        running.thrown = { error };
        return 0;
    }
}

const IMPORTS = {
    azulejo: {
        progress: (done) => {
            mustHaveThreads();
            return ask(running.progress, () => done);
        },
        visit: (pointer, count) => ask(running.visit, () => view(Float32Array, pointer, 2 * count).slice()),
    },
};

// A thread that has ended, without memory, leaves its work undone, for which the call would wait.
function mustHaveThreads() {
    if (!pool?.hasEnded()) return;
    pool.close();
    throw new WebAssembly.RuntimeError("a thread has ended, as when memory is used up: close() the module and init() it anew");
}

// Numbers in the module's memory. Pointers are signed, as WebAssembly's integers are in JavaScript. Where a thread has let
// shared memory grow, this one may not know its length yet: growing it by nothing tells.
function view(Type, pointer, length) {
    const { memory } = wasm;
    const start = pointer >>> 0;
    if (start + length * Type.BYTES_PER_ELEMENT > memory.buffer.byteLength) memory.grow(0);
    return new Type(memory.buffer, start, length);
}

/** What a call throws that a callback has ended. */
export class Cancelled extends Error {
    constructor() {
        super("the call was cancelled");
        this.name = "Cancelled";
    }
}

// The module of its bytes, a Response or an address.
async function compiled(source) {
    if (source instanceof WebAssembly.Module) return source;
    if (source instanceof URL && source.protocol === "file:") {
        source = await (await import("node:fs/promises")).readFile(source);
    } else if (source instanceof URL || typeof source === "string") {
        source = await fetch(source);
    }
    if (typeof Response !== "undefined" && source instanceof Response) {
        if (!source.ok) throw new Error(`source: ${source.url} answers ${source.status}`);
        source = await source.arrayBuffer();
    }
    return WebAssembly.compile(source);
}

// A pool of threads, or null where there can be none, or one would do.
async function threaded(wanted, source) {
    if (wanted === 1) return null;
    const { mayWait, processors, sharedMemory, startPool } = await import("./pool.js");
    const memory = sharedMemory();
    const count = wanted === 0 ? Math.min(await processors(), MOST_THREADS) : wanted;
    if (memory === null || count === 1) return null;
    if (!mayWait()) throw new Error("threads: the main thread of a page may not wait for others: make calls in a worker");
    const module = await compiled(source ?? new URL("azulejo-threads.wasm", import.meta.url));
    return { count, ...(await startPool(module, memory, count, IMPORTS)) };
}

const MOST_THREADS = 256;
const INIT = { threads: 1, source: null, threadedSource: null };

async function load(given) {
    const isOptions = given !== null && Object.getPrototypeOf(given) === Object.prototype;
    const options = withDefaults(INIT, isOptions ? given : { source: given });
    pool = await threaded(whole("threads", options.threads, MOST_THREADS + 1), options.threadedSource);
    if (pool) {
        [wasm, threads] = [pool.wasm, pool.count];
        return;
    }
    const module = await compiled(options.source ?? new URL("azulejo.wasm", import.meta.url));
    wasm = (await WebAssembly.instantiate(module, IMPORTS)).exports;
}

// The loading of the module, which happens once.
let loading = null;

export function init(options = {}) {
    loading ??= load(options).catch((error) => {
        loading = null;
        throw error;
    });
    return loading;
}

export async function close() {
    mustNotRun("close");
    await loading;
    const ended = pool;
    [wasm, pool, loading, threads] = [undefined, null, null, 1];
    await ended?.close();
}

const BOUNDED = { periodic: 0, bounded: 1 };
const ORDERS = { any: 0, progressive: 1 };
const SURFACES = { open: 0, first: 1 };
const PROJECTORS = { local: 0, global: 1 };
const PRIORITIES = { squareness: 0, projector: 1 };
const NEIGHBOURHOODS = { delaunay: 0, nearest: 1 };
const METHODS = { momentum: 0, thesis: 1 };
const DISTRIBUTIONS = { activeness: 0, average: 1, dominant: 2, zero: 3, eighty_twenty: 4 };
const VISITS = { both_ends: 0, one_end: 1 };
const CONVERGENCE = { motion: 0, variance: 1 };
const STOPPED = ["converged", "steps", "cancelled"];
const DEFAULT_QUOTIENT = 2 ** (1 / 8);

const WATCHED = { progress: null };
const DOMAIN = { ...WATCHED, domainMin: [0, 0], domainMax: [1, 1], boundary: "periodic" };
const CUBOID = { ...WATCHED, domainMin: [0, 0, 0], domainMax: [1, 1, 1], boundary: "periodic" };
const GIVEN = { givenPositions: null, givenClearances: null };
const ORDERING = { order: "any", quotient: DEFAULT_QUOTIENT };
const PLANE = { ...DOMAIN, ...GIVEN, ...ORDERING, radius: 0, count: 0, leafSize: 20, seed: 0, coarsest: Infinity };
const PROJECTION = { projectors: "local", priority: "squareness" };
const SURFACE = {
    ...WATCHED, ...GIVEN, ...ORDERING, ...PROJECTION, radius: 0, count: 0, seed: 0, cosine: -1, iterations: -1, maximal: true,
};
const VARYING = { ...WATCHED, ...GIVEN, ...ORDERING, seed: 0, cosine: -1 };
const CLASSES = { ...VARYING, masks: null };
const DENSITY = { values: null, radius: 0, count: 0, width: 0, height: 0, texture: null };
const EDITED_PLANE = { ...DOMAIN, ...GIVEN, radius: 0, leafSize: 20, seed: 0 };
const GROWING = { ...GIVEN, ...PROJECTION, radius: 0, seed: 0, cosine: -1 };
const REGION = { centre: null, radius: null, min: null, max: null };
const VOLUME = { ...CUBOID, ...GIVEN, ...ORDERING, radius: 0, count: 0, seed: 0, leafSize: 0 };
const CLASSES_IN_SPACE = { ...CUBOID, ...GIVEN, seed: 0 };
const SPACE = { ...CUBOID, radius: 0 };
const INSIDE = { ...WATCHED, ...GIVEN, ...ORDERING, radius: 0, count: 0, surface: "open", tolerance: 0.0625, thickness: 0, seed: 0 };
const VARYING_VOLUME = { ...CUBOID, tolerance: 0.0625, seed: 0 };
const MAXIMAL = { ...DOMAIN, radius: 0, seed: 0 };
const MERGE = { ...DOMAIN, radius: 0, seed: 0, maximalPieces: false };
const PIECE = { positions: null, min: [0, 0], max: [1, 1] };
const MASK = { ...WATCHED, width: 0, height: 0, depth: 1, channels: 1, seed: 0, sigma: 1.5 };
const DRESS = { normals: null, normalIndices: null, mask: null };
// Of the thesis's method, and their defaults there.
const THESIS = {
    conflictRadius: 0.95, attractionRadius: 1.05, step: 0.05, decay: 1, neighbours: 6, distribution: "activeness",
    visits: "both_ends", convergence: "motion",
};
const RELAX = {
    ...DOMAIN, neighbourhood: "delaunay", method: "momentum", maxIterations: 100, tolerance: null, seed: 0,
    ...Object.fromEntries(Object.keys(THESIS).map((name) => [name, null])),
};
const SCATTER = { ...DOMAIN, seed: 0 };
// Of several classes, and to a density.
const RELAX_CLASSES = { ...DOMAIN, maxIterations: 100, tolerance: 0.001, seed: 0 };
const RELAX_VOLUME = { ...CUBOID, maxIterations: 100, tolerance: 0.001, seed: 0 };
const RELAX_INSIDE = { ...WATCHED, fixed: null, sliding: null, maxIterations: 100, tolerance: 0.001, seed: 0 };
const CORRELATION = { ...DOMAIN, maxIterations: 100, tolerance: 0.005, seed: 0 };
const IMAGE = { values: null, width: 0, height: 0 };
const DITHERED = { values: null, width: 0, height: 0, depth: 1, channels: 1 };
const RELAX_SURFACE = { ...WATCHED, density: null, maxIterations: 100, tolerance: 0.0005, seed: 0 };
const THIN = { ...WATCHED, radius: 0, count: 0, order: "any", seed: 0 };
const SPECTRA = { ...DOMAIN, frequencyStride: 1 };
const SPACE_SPECTRUM = { ...CUBOID, frequencyStride: 1, width: 0.05 };
const SPECTRUM = { ...DOMAIN, size: 256, width: 0.02 };
const DIFFERENCES = { ...WATCHED, direction: [1, 0, 0], seed: 0 };
const PROBES = { ...WATCHED, probes: 100_000, seed: 0 };

// The caller's options over the defaults. Names and types that no option has are refused.
function withDefaults(defaults, options = {}) {
    for (const [name, value] of Object.entries(options)) {
        if (!(name in defaults)) throw new TypeError(`${name}: no such option`);
        if (typeof defaults[name] === "number" && typeof value !== "number" && typeof value !== "bigint") {
            throw new TypeError(`${name}: ${value} is not a number`);
        }
        if (name === "progress" && typeof value !== "function" && value != null) {
            throw new TypeError("progress: not a function");
        }
    }
    const all = { ...defaults };
    for (const [name, value] of Object.entries(options)) if (value !== undefined) all[name] = value;
    return all;
}

function constant(name, value, constants) {
    if (Object.hasOwn(constants, value)) return constants[value];
    throw new TypeError(`${name}: ${value} is none of ${Object.keys(constants).join(", ")}`);
}

function whole(name, value, limit = 2 ** 32) {
    if (Number.isInteger(value) && value >= 0 && value < limit) return value;
    throw new RangeError(`${name}: ${value} is not a whole number from 0 to ${limit - 1}`);
}

function seedOf({ seed }) {
    const isWhole = typeof seed === "bigint" || Number.isSafeInteger(seed);
    if (isWhole && seed >= 0 && BigInt(seed) < 1n << 64n) return BigInt(seed);
    throw new RangeError(`seed: ${seed} is not a whole number from 0 to 2^64 - 1`);
}

function corner(name, value, axes = 2) {
    if (value?.length === axes && [...value].every((x) => typeof x === "number")) return [...value];
    throw new TypeError(`${name}: not ${axes === 2 ? "two" : "three"} numbers`);
}

function domainOf({ domainMin, domainMax, boundary }, axes = 2) {
    const corners = [...corner("domainMin", domainMin, axes), ...corner("domainMax", domainMax, axes)];
    return [...corners, constant("boundary", boundary, BOUNDED)];
}

// What a call of the module returns.
const [SUCCEEDED, CANCELLED] = [1, 2];

// Arguments in the module's memory, freed with the answer when the call has been made.
class Call {
    #taken = [];

    // Bytes of the module's memory.
    #take(argument, bytes) {
        const pointer = wasm.azulejo_take(bytes);
        if (pointer === 0) throw new RangeError(`${argument}: ${bytes} bytes exceed the memory`);
        this.#taken.push([pointer, bytes]);
        return pointer;
    }

    // [pointer, rows] of an array of numbers, `width` in each row. Float32Array, Float64Array and so on, or any array.
    rows(argument, array, Type, width) {
        if (array === null) return [0, 0];
        if (typeof array?.length !== "number") throw new TypeError(`${argument}: not an array of numbers`);
        if (array.length % width !== 0) {
            throw new RangeError(`${argument}: ${array.length} numbers are no rows of ${width}`);
        }
        const pointer = this.#take(argument, array.length * Type.BYTES_PER_ELEMENT);
        view(Type, pointer, array.length).set(array);
        return [pointer, array.length / width];
    }

    // The pointer of numbers that the module lays out as a struct.
    options(numbers) {
        return this.rows("options", numbers, Float64Array, numbers.length)[0];
    }

    // A place for a handle.
    handle() {
        const [pointer] = this.rows("handle", [0], Uint32Array, 1);
        return pointer;
    }

    // Makes a call; its answer as arrays of these types.
    make(name, args, ...types) {
        const outcome = wasm[`azulejo_${name}`](...args);
        try {
            // Relaxation returns its state when it is cancelled.
            if (running.thrown) throw running.thrown.error;
            if (outcome === CANCELLED) throw new Cancelled();
            if (outcome !== SUCCEEDED) throw new Error(inJavaScript(new TextDecoder().decode(answer(0, Uint8Array))));
            return types.map((Type, index) => answer(index, Type));
        } finally {
            wasm.azulejo_answer_free();
        }
    }

    free() {
        for (const [pointer, bytes] of this.#taken) wasm.azulejo_give_back(pointer, bytes);
    }
}

function answer(index, Type) {
    const bytes = wasm.azulejo_answer_bytes(index) >>> 0;
    if (bytes === 0) return new Type(0);
    return view(Type, wasm.azulejo_answer(index), bytes / Type.BYTES_PER_ELEMENT).slice();
}

// The library names arguments as C does.
function inJavaScript(message) {
    const [argument, ...rest] = message.split(":");
    const name = argument.replace(/_([a-z])/g, (_, letter) => letter.toUpperCase());
    return [name, ...rest].join(":");
}

// Callbacks must not call the module: what the running call uses might change or be freed.
function mustNotRun(what) {
    if (running) throw new Error(`${what}: another call runs, whose callback this is`);
}

function calling(body, { progress = null, visit = null } = {}) {
    if (!wasm) throw new Error("init: the module is not loaded; await init() first");
    mustNotRun("call");
    mustHaveThreads();
    const call = new Call();
    running = { progress, visit, thrown: null };
    try {
        return body(call);
    } finally {
        running = null;
        if (!pool?.hasEnded()) call.free();
    }
}

// A radius and a count, of which one is 0.
function amount(radius, count) {
    if (count > 0 && radius !== 0) throw new RangeError(`radius: ${radius}, but there is a count, from which it follows`);
    return [radius, whole("count", count)];
}

function planeOptions(call, options) {
    const { radius, count, leafSize, order, quotient, coarsest } = options;
    const numbers = [
        ...amount(radius, count), ...domainOf(options), leafSize, constant("order", order, ORDERS), quotient, coarsest,
    ];
    return call.options(numbers);
}

function given(call, { givenPositions, givenClearances }, axes) {
    const positions = call.rows("givenPositions", givenPositions, Float32Array, axes);
    return [...positions, ...call.rows("givenClearances", givenClearances, Float64Array, 1)];
}

const withRanks = (set, ranks) => (ranks.length > 0 ? { ...set, ranks } : set);

export function kdrtSample(options) {
    options = withDefaults(PLANE, options);
    return calling((call) => {
        if (options.count > 0 && options.givenPositions?.length) {
            throw new RangeError("givenPositions: must be none where there is a count");
        }
        const args = [planeOptions(call, options), seedOf(options), ...given(call, options, 2)];
        const types = [Float32Array, Float32Array, Float64Array];
        const [positions, ranks, [radius, isMaximal]] = call.make("kdrt_sample", args, ...types);
        return withRanks({ positions, radius, isMaximal: isMaximal === 1 }, ranks);
    }, options);
}

export function kdrtStream(visit, options) {
    if (typeof visit !== "function") throw new TypeError("visit: not a function");
    options = withDefaults(PLANE, options);
    calling((call) => {
        if (options.count > 0) throw new RangeError(`count: ${options.count}, but streams are made by radius`);
        call.make("kdrt_stream", [planeOptions(call, options), seedOf(options), ...given(call, options, 2)]);
    }, { ...options, visit });
}

export function kdrtSampleWindow(options, windowMin, windowMax) {
    const plane = new KdrtPlane(options);
    try {
        return plane.window(windowMin, windowMax);
    } finally {
        plane.free();
    }
}

// The radii of classes of the plane.
function matrix(call, { radius, count }, radii) {
    if (radius !== 0) throw new RangeError(`radius: ${radius}, but classes have radii of their own`);
    if (count !== 0) throw new RangeError(`count: ${count}, but classes are made by their radii`);
    return call.rows("radii", radii, Float64Array, 1);
}

export function classesRadii(own, factor = 1) {
    return calling((call) => call.make("classes_radii", [...call.rows("own", own, Float64Array, 1), factor], Float64Array)[0]);
}

export function kdrtSampleClasses(options, radii) {
    options = withDefaults(PLANE, options);
    return calling((call) => {
        const own = matrix(call, options, radii);
        const args = [planeOptions(call, options), seedOf(options), ...given(call, options, 2), ...own];
        const types = [Float32Array, Uint32Array, Float32Array];
        const [positions, classes, ranks] = call.make("kdrt_sample_classes", args, ...types);
        return withRanks({ positions, classes }, ranks);
    }, options);
}

export function maximalSample(options) {
    options = withDefaults(MAXIMAL, options);
    return calling((call) => {
        const args = [options.radius, ...domainOf(options), seedOf(options)];
        return { positions: call.make("maximal_sample", args, Float32Array)[0] };
    }, options);
}

export function kdrtMerge(pieces, options, fixed = null) {
    options = withDefaults(MERGE, options);
    return calling((call) => {
        const all = [...pieces].map((piece, index) => {
            const { positions, min, max } = withDefaults(PIECE, piece);
            const size = positions?.length;
            if (!(size % 2 === 0)) throw new RangeError(`pieces: [${index}] has ${size} numbers, which are no rows of 2`);
            return { positions, corners: [...corner("min", min), ...corner("max", max)] };
        });
        const samples = new Float32Array(all.reduce((sum, { positions }) => sum + positions.length, 0));
        let filled = 0;
        for (const { positions } of all) {
            samples.set(positions, filled);
            filled += positions.length;
        }
        const counts = call.rows("pieces", all.map(({ positions }) => positions.length / 2), Uint32Array, 1);
        const args = [
            options.radius, ...domainOf(options), seedOf(options), options.maximalPieces ? 1 : 0, ...counts,
            call.rows("pieces", all.flatMap(({ corners }) => corners), Float64Array, 4)[0],
            ...call.rows("pieces", samples, Float32Array, 2), ...call.rows("fixed", fixed, Float32Array, 2),
        ];
        const [positions, [kept, eliminated, inserted]] = call.make("kdrt_merge", args, Float32Array, Float64Array);
        return { positions, kept, eliminated, inserted };
    }, options);
}

// Something in the module's memory, which free() frees, or the garbage collector some day.
class Handle {
    #pointer;
    #kind;
    #name;
    #module = wasm;
    static #registry = new FinalizationRegistry(([module, kind, pointer]) => Handle.#freeIn(module, kind, pointer));

    // What a module held that was closed is gone with it.
    static #freeIn(module, kind, pointer) {
        if (module === wasm) module[`azulejo_${kind}_free`](pointer);
    }

    constructor(kind, pointer, name = kind) {
        this.#pointer = pointer;
        this.#kind = kind;
        this.#name = name;
        Handle.#registry.register(this, [this.#module, kind, pointer], this);
    }

    get pointer() {
        if (this.#pointer === 0 || this.#module !== wasm) throw new Error(`${this.#name}: was freed`);
        return this.#pointer;
    }

    free() {
        if (this.#pointer === 0) return;
        mustNotRun(this.#name);
        Handle.#registry.unregister(this);
        Handle.#freeIn(this.#module, this.#kind, this.#pointer);
        this.#pointer = 0;
    }
}
if (Symbol.dispose) Handle.prototype[Symbol.dispose] = Handle.prototype.free;

// Makes a call that writes a handle behind its other arguments: the handle, and the arrays of the answer.
function created(name, args, options, ...types) {
    return calling((call) => {
        const out = call.handle();
        const arrays = call.make(name, [...args(call), out], ...types);
        return [view(Uint32Array, out, 1)[0], ...arrays];
    }, options);
}

export class KdrtPlane extends Handle {
    #hasClasses;

    constructor(options, radii = null) {
        options = withDefaults(PLANE, options);
        if (options.count > 0) throw new RangeError(`count: ${options.count}, but windows are made by radius`);
        const [pointer] = created("kdrt_create", (call) => {
            const own = radii === null ? [0, 0] : matrix(call, options, radii);
            return [planeOptions(call, options), seedOf(options), ...given(call, options, 2), ...own];
        }, options);
        super("kdrt", pointer, "plane");
        this.#hasClasses = radii !== null;
    }

    window(windowMin, windowMax) {
        const corners = [...corner("windowMin", windowMin), ...corner("windowMax", windowMax)];
        return calling((call) => {
            const types = [Float32Array, Float32Array, Uint32Array];
            const [positions, ranks, classes] = call.make("kdrt_window", [this.pointer, ...corners], ...types);
            return withRanks({ positions, ...(this.#hasClasses ? { classes } : {}) }, ranks);
        });
    }
}

// The first argument of a Mesh that exists in the module's memory.
const MADE = Symbol("made");

// What a Mesh is made of that a call makes with these arguments before the handle.
function mesh(name, args, watched) {
    const [pointer, numbers, report] = created(name, args, watched, Float64Array, Float64Array);
    return { pointer, numbers, report };
}

// Where samples lie on a mesh.
const places = (call, { triangles, barycentrics }) => [
    ...call.rows("triangles", triangles, Uint32Array, 1), ...call.rows("barycentrics", barycentrics, Float32Array, 2),
];

export class Mesh extends Handle {
    constructor(positions, indices, options) {
        const made = positions === MADE ? indices : mesh("mesh_create", (call) => [
            ...call.rows("positions", positions, Float32Array, 3), ...call.rows("indices", indices, Uint32Array, 3),
        ]);
        super("mesh", made.pointer);
        [this.area, this.vertexCount, this.triangleCount] = made.numbers;
        if (Object.values(withDefaults(DRESS, options)).every((array) => array === null)) return;
        try {
            return this.#with(options);
        } finally {
            this.free();
        }
    }

    static parse(name, bytes) {
        const contents = bytes instanceof ArrayBuffer ? new Uint8Array(bytes) : bytes;
        const text = new TextEncoder().encode(String(name));
        return new Mesh(MADE, mesh("mesh_parse", (call) => [
            ...call.rows("name", text, Uint8Array, 1), ...call.rows("bytes", contents, Uint8Array, 1),
        ]));
    }

    #with(dress) {
        const { normals, normalIndices, mask } = withDefaults(DRESS, dress);
        return new Mesh(MADE, mesh("mesh_with", (call) => [
            this.pointer, ...call.rows("normals", normals, Float32Array, 3),
            ...call.rows("normalIndices", normalIndices, Uint32Array, 3),
            ...call.rows("mask", mask && Array.from(mask, (isSampled) => (isSampled ? 1 : 0)), Uint8Array, 1),
        ]));
    }

    withNormals(normals, normalIndices = null) {
        if (normals == null) throw new TypeError("normals: not an array of numbers");
        return this.#with({ normals, normalIndices });
    }

    withMask(mask) {
        if (mask == null) throw new TypeError("mask: not an array");
        return this.#with({ mask });
    }

    deform(positions) {
        return new Mesh(MADE, mesh("mesh_deform", (call) => [
            this.pointer, ...call.rows("positions", positions, Float32Array, 3),
        ]));
    }

    points(samples) {
        return calling((call) => surfaceSamples(call.make("mesh_points", [this.pointer, ...places(call, samples)], ...SAMPLES)));
    }

    isClosed() {
        return calling((call) => call.make("mesh_is_closed", [this.pointer], Uint8Array)[0][0] === 1);
    }

    contains(positions, options) {
        return calling((call) => {
            const args = [this.pointer, ...call.rows("positions", positions, Float32Array, 3)];
            return call.make("mesh_contains", args, Uint8Array)[0];
        }, withDefaults(WATCHED, options));
    }

    arrays() {
        return calling((call) => {
            const types = [Float32Array, Uint32Array, Float64Array, Float32Array, Uint32Array, Uint8Array];
            const [positions, indices, origin, ...dress] = call.make("mesh_arrays", [this.pointer], ...types);
            const named = Object.keys(DRESS).map((name, index) => [name, dress[index]]);
            return { positions, indices, origin, ...Object.fromEntries(named.filter(([, array]) => array.length > 0)) };
        });
    }
}

function meshPointer(of) {
    if (of instanceof Mesh) return of.pointer;
    throw new TypeError("mesh: not a Mesh");
}

const SAMPLES = [Float32Array, Float32Array, Uint32Array, Float32Array, Float32Array, Float32Array];

const withInterpolated = (set, normals) => (normals.length > 0 ? { ...set, interpolatedNormals: normals } : set);

function surfaceSamples([positions, normals, triangles, barycentrics, ranks, interpolated]) {
    return withInterpolated(withRanks({ positions, normals, triangles, barycentrics }, ranks), interpolated);
}

const projection = ({ projectors, priority }) =>
    [constant("projectors", projectors, PROJECTORS), constant("priority", priority, PRIORITIES)];

// The figures of a report that are known.
function known(figures) {
    return Object.fromEntries(Object.entries(figures).filter(([, figure]) => figure >= 0));
}

// The report of a set on a mesh.
function reported([radius, coveringRadius, rho, iterations, darts, uncoveredBefore, uncoveredAfter]) {
    return { radius, rho, iterations, darts, ...known({ coveringRadius, uncoveredBefore, uncoveredAfter }) };
}

export function pspSample(mesh, options) {
    options = withDefaults(SURFACE, options);
    return calling((call) => {
        const { radius, count, order, quotient, cosine, iterations, maximal } = options;
        const numbers = [
            radius, whole("count", count), constant("order", order, ORDERS), quotient, cosine, iterations, maximal ? 1 : 0,
            ...projection(options),
        ];
        const place = call.options(numbers);
        const args = [meshPointer(mesh), place, seedOf(options), ...given(call, options, 3)];
        const [report, ...samples] = last(call.make("psp_sample", args, ...SAMPLES, Float64Array));
        return { ...surfaceSamples(samples), ...reported(report) };
    }, options);
}

export function volumeSample(options) {
    options = withDefaults(VOLUME, options);
    return calling((call) => {
        const { radius, count, order, quotient, leafSize } = options;
        const numbers = [
            ...amount(radius, count), ...domainOf(options, 3), constant("order", order, ORDERS), quotient, leafSize,
        ];
        const place = call.options(numbers);
        const types = [Float32Array, Float32Array, Float64Array];
        const args = [place, seedOf(options), ...given(call, options, 3)];
        const [positions, ranks, [found, coveringRadius]] = call.make("volume_sample", args, ...types);
        return withRanks({ positions, radius: found, coveringRadius }, ranks);
    }, options);
}

export function volumeSampleClasses(options, radii) {
    options = withDefaults(CLASSES_IN_SPACE, options);
    return calling((call) => {
        const cuboid = call.options(domainOf(options, 3));
        const args = [
            cuboid, seedOf(options), ...given(call, options, 3), ...call.rows("radii", radii, Float64Array, 1),
        ];
        const [positions, classes] = call.make("volume_sample_classes", args, Float32Array, Uint32Array);
        return { positions, classes };
    }, options);
}

export function volumeSampleInside(mesh, options) {
    options = withDefaults(INSIDE, options);
    return calling((call) => {
        const { radius, count, surface, tolerance, order, quotient, thickness } = options;
        const numbers = [
            ...amount(radius, count), constant("surface", surface, SURFACES), tolerance, constant("order", order, ORDERS),
            quotient, thickness,
        ];
        const place = call.options(numbers);
        const types = [Float32Array, Float32Array, Float64Array];
        const args = [meshPointer(mesh), place, seedOf(options), ...given(call, options, 3)];
        const [positions, ranks, report] = call.make("volume_sample_inside", args, ...types);
        const [found, coveringRadius, depth, surfaceSamples] = report;
        return withRanks({ positions, radius: found, coveringRadius, depth, surfaceSamples }, ranks);
    }, options);
}

export function volumeAdaptiveSample(options, gridValues, gridSize, mesh = null) {
    const { domainMin, domainMax, boundary, tolerance } = options ?? {};
    const [unused, where] = mesh === null ? [{ tolerance }, "without"] : [{ domainMin, domainMax, boundary }, "with"];
    for (const [name, value] of Object.entries(unused)) {
        if (value !== undefined) throw new TypeError(`${name}: has no effect ${where} a mesh`);
    }
    options = withDefaults(VARYING_VOLUME, options);
    return calling((call) => {
        const numbers = [...domainOf(options, 3), ...corner("gridSize", gridSize, 3).map((x) => whole("gridSize", x)), options.tolerance];
        const pointer = mesh === null ? 0 : meshPointer(mesh);
        const args = [pointer, call.options(numbers), seedOf(options), ...call.rows("gridValues", gridValues, Float32Array, 1)];
        const types = [Float32Array, Float64Array, Float64Array];
        const [positions, radii, [radius, coveringRadius]] = call.make("volume_adaptive_sample", args, ...types);
        return { positions, radii, radius, coveringRadius };
    }, options);
}

export function maskCreate(options) {
    options = withDefaults(MASK, options);
    const sizes = ["width", "height", "depth", "channels"].map((name) => whole(name, options[name]));
    return calling((call) => {
        return call.make("mask_create", [...sizes, seedOf(options), options.sigma], Uint32Array)[0];
    }, options);
}

export function maskDither(ranks, mask, image, levels = 2) {
    mask = withDefaults(MASK, mask);
    image = withDefaults(DITHERED, image);
    const sizes = (of) => ["width", "height", "depth", "channels"].map((name) => whole(name, of[name]));
    return calling((call) => {
        const { values } = image;
        const isBytes = values instanceof Uint8Array || values instanceof Uint8ClampedArray;
        const args = [
            ...sizes(mask), ...call.rows("ranks", ranks, Uint32Array, 1), ...sizes(image), whole("levels", levels),
            Number(isBytes), ...call.rows("values", values, isBytes ? Uint8Array : Float32Array, 1),
        ];
        return call.make("mask_dither", args, Uint8Array)[0];
    });
}

function density(of, isRelaxed = false) {
    const options = withDefaults(DENSITY, of);
    const { values, radius, count, width, height } = options;
    if (values === null) throw new TypeError("values: a density needs some");
    if (isRelaxed) {
        if (radius !== 0 || count !== 0) throw new TypeError("radius: has no effect in a relaxation, nor has count");
    } else if ((radius === 0) === (count === 0)) {
        throw new RangeError(`radius: ${radius}, and count ${count}: one of them must be 0`);
    }
    return { ...options, kind: 2, size: [whole("width", width), whole("height", height)] };
}

const RADII_OF_VERTICES = { kind: 1, radius: 0, count: 0, size: [0, 0], texture: null };
const NO_RADII = { ...RADII_OF_VERTICES, kind: 0, values: null };

// The arguments of sets whose radius varies, or could.
function varying(call, mesh, options, { kind, radius, count, size, values, texture }, name) {
    const { order, quotient, cosine } = options;
    const numbers = [constant("order", order, ORDERS), quotient, cosine, kind, radius, count, ...size];
    return [
        meshPointer(mesh), call.options(numbers), seedOf(options),
        ...given(call, options, 3), ...call.rows(name, values, Float32Array, 1),
        ...call.rows("texture", texture, Float32Array, 2),
    ];
}

function adaptive(mesh, options, unit, name) {
    options = withDefaults(VARYING, options);
    return calling((call) => {
        const args = varying(call, mesh, options, unit, name);
        const arrays = call.make("psp_adaptive", args, ...SAMPLES, Float64Array, Float64Array);
        const [radii, report] = arrays.slice(SAMPLES.length);
        return { ...surfaceSamples(arrays), radii, ...reported(report) };
    }, options);
}

export function pspAdaptiveSample(mesh, options, vertexRadii) {
    return adaptive(mesh, options, { ...RADII_OF_VERTICES, values: vertexRadii }, "vertexRadii");
}

export function pspAdaptiveWithDensity(mesh, options, of) {
    return adaptive(mesh, options, density(of), "density");
}

function inClasses(mesh, options, radii, unit) {
    options = withDefaults(CLASSES, options);
    return calling((call) => {
        const args = [
            ...varying(call, mesh, options, unit, "density"), ...call.rows("radii", radii, Float64Array, 1),
            ...call.rows("masks", options.masks, Uint32Array, 1),
        ];
        const arrays = call.make("psp_sample_classes", args, ...SAMPLES, Uint32Array, Float64Array, Float64Array);
        const [classes, localRadii, report] = arrays.slice(SAMPLES.length);
        const own = unit.kind === 0 ? {} : { radii: localRadii };
        return { ...surfaceSamples(arrays), classes, ...own, ...reported(report) };
    }, options);
}

export function pspSampleClasses(mesh, options, radii) {
    return inClasses(mesh, options, radii, NO_RADII);
}

export function pspClassesWithDensity(mesh, options, radii, of) {
    return inClasses(mesh, options, radii, density(of));
}

// The last of some arrays before the others.
const last = (arrays) => [arrays.at(-1), ...arrays.slice(0, -1)];

// A set that is edited: of the plane, or on a mesh.
class EditedSet extends Handle {
    #axes;

    constructor(pointer, axes) {
        super("set", pointer);
        this.#axes = axes;
    }

    // What a call returns of samples, and what comes behind it.
    #edited(call, name, args, ...more) {
        const types = [Float32Array, Float32Array, Uint32Array, Float32Array, Float64Array, Float32Array, ...more];
        const arrays = call.make(`set_${name}`, [this.pointer, ...args], ...types);
        const [positions, normals, triangles, barycentrics, ids, interpolated, ...rest] = arrays;
        const samples = this.#axes === 2 ? { positions, ids } : { positions, normals, triangles, barycentrics, ids };
        return [withInterpolated(samples, interpolated), ...rest];
    }

    points() {
        return calling((call) => this.#edited(call, "points", [])[0]);
    }

    erase(region) {
        const { centre, radius, min, max } = withDefaults(REGION, region);
        if ((centre === null) !== (radius === null)) {
            const [missing, other] = centre === null ? ["centre", "radius"] : ["radius", "centre"];
            throw new TypeError(`${missing}: none, but there is a ${other}`);
        }
        if (radius !== null && typeof radius !== "number") throw new TypeError(`radius: ${radius} is not a number`);
        const height = Array(3 - this.#axes).fill(0);
        const place = (name, value, usual) => (value === null ? usual : [...corner(name, value, this.#axes), ...height]);
        return calling((call) => {
            const bounds = [
                ...place("min", min, Array(3).fill(-Infinity)), ...place("max", max, Array(3).fill(Infinity)),
                ...place("centre", centre, [0, 0, 0]), radius ?? Infinity,
            ];
            return this.#edited(call, "erase", [call.rows("region", bounds, Float64Array, 10)[0]])[0];
        });
    }

    eraseIds(ids) {
        return calling((call) => this.#edited(call, "erase_ids", call.rows("ids", ids, Float64Array, 1))[0]);
    }

    restore({ positions, triangles = null, barycentrics = null, ids }) {
        calling((call) => {
            const [place, count] = call.rows("positions", positions, Float32Array, this.#axes);
            call.make("set_restore", [
                this.pointer, place, count * this.#axes, ...call.rows("triangles", triangles, Uint32Array, 1),
                ...call.rows("barycentrics", barycentrics, Float32Array, 2), ...call.rows("ids", ids, Float64Array, 1),
            ]);
        });
    }

    addGiven(positions, clearances = null) {
        return calling((call) => {
            const [place, count] = call.rows("givenPositions", positions, Float32Array, this.#axes);
            const args = [place, count * this.#axes, ...call.rows("givenClearances", clearances, Float64Array, 1)];
            const [erased, [first]] = this.#edited(call, "add_given", args, Float64Array);
            return { first, erased };
        });
    }

    removeGiven(ids) {
        calling((call) => call.make("set_remove_given", [this.pointer, ...call.rows("ids", ids, Float64Array, 1)]));
    }

    refill(seed = 0, options) {
        const watched = withDefaults(WATCHED, options);
        return calling((call) => this.#edited(call, "refill", [seedOf({ seed })])[0], watched);
    }
}

export class Plane extends EditedSet {
    constructor(options, positions = null) {
        options = withDefaults(EDITED_PLANE, options);
        const [pointer] = created("plane_create", (call) => {
            const numbers = planeOptions(call, { ...PLANE, ...options });
            const begun = [positions === null ? 0 : 1, ...call.rows("positions", positions, Float32Array, 2)];
            return [numbers, seedOf(options), ...given(call, options, 2), ...begun];
        }, options);
        super(pointer, 2);
    }
}

export class Psp extends EditedSet {
    constructor(mesh, options) {
        options = withDefaults(GROWING, options);
        const { radius, cosine } = options;
        const [pointer] = created("psp_create", (call) => [
            meshPointer(mesh), radius, cosine, ...projection(options), seedOf(options), ...given(call, options, 3),
        ]);
        super(pointer, 3);
    }

    advance(iterations, options) {
        return calling((call) => {
            const args = [this.pointer, whole("iterations", iterations)];
            return call.make("set_advance", args, Float64Array)[0][0];
        }, withDefaults(WATCHED, options));
    }

    fill(options) {
        const watched = withDefaults(WATCHED, options);
        return calling((call) => call.make("set_fill", [this.pointer], Float64Array)[0][0], watched);
    }
}

export function dcrRelax(positions, options) {
    options = withDefaults(RELAX, options);
    return calling((call) => {
        const own = Object.keys(THESIS).filter((name) => options[name] !== null);
        const method = constant("method", options.method, METHODS);
        if (method === METHODS.momentum && own.length > 0) throw new Error(`${own[0]}: is of the method "thesis" only`);
        const { conflictRadius, attractionRadius, step, decay, neighbours, distribution, visits, convergence } =
            withDefaults(THESIS, Object.fromEntries(own.map((name) => [name, options[name]])));
        const numbers = [
            ...domainOf(options), constant("neighbourhood", options.neighbourhood, NEIGHBOURHOODS), method,
            whole("maxIterations", options.maxIterations), toleranceOf(options), conflictRadius, attractionRadius, step, decay,
            whole("neighbours", neighbours), constant("distribution", distribution, DISTRIBUTIONS),
            constant("visits", visits, VISITS), constant("convergence", convergence, CONVERGENCE),
        ];
        const args = [call.options(numbers), seedOf(options), ...call.rows("positions", positions, Float32Array, 2)];
        return relaxation(call.make("dcr_relax", args, Float32Array, Float64Array));
    }, options);
}

// -1 for that of the method.
function toleranceOf({ tolerance }) {
    if (tolerance === null) return -1;
    if (tolerance >= 0) return tolerance;
    throw new RangeError(`tolerance: ${tolerance} is no number from 0`);
}

// Relaxed points of the plane.
function relaxation([positions, report]) {
    const [iterations, stopped, motion, smallestDistance, rho, relativeCoveringRadius] = report;
    return { positions, iterations, stopped: STOPPED[stopped], motion, smallestDistance, rho, relativeCoveringRadius };
}

export function dcrRelaxClasses(positions, classes, options) {
    options = withDefaults(RELAX_CLASSES, options);
    return calling((call) => {
        const { maxIterations, tolerance } = options;
        const args = [
            ...domainOf(options), whole("maxIterations", maxIterations), tolerance, seedOf(options),
            ...call.rows("positions", positions, Float32Array, 2), ...call.rows("classes", classes, Uint32Array, 1),
        ];
        const types = [Float32Array, Float64Array, Float64Array, Float64Array];
        const [relaxed, report, classRho, classRelativeCoveringRadius] = call.make("dcr_relax_classes", args, ...types);
        return { ...relaxation([relaxed, report]), classRho, classRelativeCoveringRadius };
    }, options);
}

export function dcrRelaxToCorrelation(positions, correlation, reach, options) {
    options = withDefaults(CORRELATION, options);
    return calling((call) => {
        const { maxIterations, tolerance } = options;
        const args = [
            ...domainOf(options), whole("maxIterations", maxIterations), tolerance, seedOf(options),
            ...call.rows("positions", positions, Float32Array, 2), reach,
            ...call.rows("correlation", correlation, Float64Array, 1),
        ];
        const types = [Float32Array, Float64Array, Float64Array];
        const [relaxed, report, [residual]] = call.make("dcr_relax_to_correlation", args, ...types);
        return { ...relaxation([relaxed, report]), residual };
    }, options);
}

export function dcrCorrelationOfPower(power, highest, reach = 12, bins = 480) {
    return calling((call) => {
        const args = [highest, reach, whole("bins", bins), ...call.rows("power", power, Float64Array, 1)];
        return call.make("dcr_correlation_of_power", args, Float64Array)[0];
    });
}

export function volumeRelax(positions, options) {
    options = withDefaults(RELAX_VOLUME, options);
    return calling((call) => {
        const place = call.options(domainOf(options, 3));
        const args = [
            place, whole("maxIterations", options.maxIterations), options.tolerance, seedOf(options),
            ...call.rows("positions", positions, Float32Array, 3),
        ];
        return relaxationInSpace(call.make("volume_relax", args, Float32Array, Float64Array));
    }, options);
}

export function volumeRelaxInside(mesh, positions, options) {
    options = withDefaults(RELAX_INSIDE, options);
    return calling((call) => {
        const flags = (name) => {
            const of = options[name] && Array.from(options[name], (is) => (is ? 1 : 0));
            return call.rows(name, of, Uint8Array, 1);
        };
        const args = [
            meshPointer(mesh), whole("maxIterations", options.maxIterations), options.tolerance, seedOf(options),
            ...call.rows("positions", positions, Float32Array, 3), ...flags("fixed"), ...flags("sliding"),
        ];
        return relaxationInSpace(call.make("volume_relax_inside", args, Float32Array, Float64Array));
    }, options);
}

function relaxationInSpace([positions, [iterations, stopped, motion, smallestDistance, rho]]) {
    return { positions, iterations, stopped: STOPPED[stopped], motion, smallestDistance, rho };
}

// An image of densities: its values, and its size behind them.
function image(call, density) {
    const { values, width, height } = withDefaults(IMAGE, density);
    if (values === null) throw new TypeError("values: a density needs some");
    return [...call.rows("density", values, Float32Array, 1), whole("width", width), whole("height", height)];
}

export function dcrScatter(density, count, options) {
    options = withDefaults(SCATTER, options);
    return calling((call) => {
        const args = [...domainOf(options), whole("count", count), seedOf(options), ...image(call, density)];
        return { positions: call.make("dcr_scatter", args, Float32Array)[0] };
    }, options);
}

export function dcrRelaxDensity(positions, density, options) {
    options = withDefaults(RELAX_CLASSES, options);
    return calling((call) => {
        const { maxIterations, tolerance } = options;
        const args = [
            ...domainOf(options), whole("maxIterations", maxIterations), tolerance, seedOf(options),
            ...call.rows("positions", positions, Float32Array, 2), ...image(call, density),
        ];
        return relaxation(call.make("dcr_relax_density", args, Float32Array, Float64Array));
    }, options);
}

export function dcrSurfaceRelax(mesh, samples, options) {
    options = withDefaults(RELAX_SURFACE, options);
    const { size, values, texture } = options.density === null ? NO_RADII : density(options.density, true);
    return calling((call) => {
        const { maxIterations, tolerance } = options;
        const args = [
            meshPointer(mesh), whole("maxIterations", maxIterations), tolerance, seedOf(options), ...places(call, samples),
            ...size, ...call.rows("density", values, Float32Array, 1), ...call.rows("texture", texture, Float32Array, 2),
        ];
        const [report, ...relaxed] = last(call.make("dcr_surface_relax", args, ...SAMPLES, Float64Array));
        const [iterations, stopped, motion, smallestDistance, rho] = report;
        return { ...surfaceSamples(relaxed), iterations, stopped: STOPPED[stopped], motion, smallestDistance, rho };
    }, options);
}

export function dcrRemesh(of, samples, options) {
    const watched = withDefaults(WATCHED, options);
    const made = mesh("dcr_remesh", (call) => [meshPointer(of), ...places(call, samples)], watched);
    const [
        triangles, disputed, leftOut, boundaryEdges, innerEdges, nonManifoldEdges, nonManifoldVertices, unusedVertices, euler,
        smallestAngle, largestAngle, meanSmallestAngle,
    ] = made.report;
    return {
        mesh: new Mesh(MADE, made), triangles, disputed, leftOut, boundaryEdges, innerEdges, nonManifoldEdges,
        nonManifoldVertices, unusedVertices, euler, smallestAngle, largestAngle, meanSmallestAngle,
    };
}

export function thin(positions, dimensions, options) {
    options = withDefaults(THIN, options);
    return calling((call) => {
        if (dimensions !== 2 && dimensions !== 3) throw new RangeError(`dimensions: ${dimensions} is not 2 or 3`);
        const { radius, count, order } = options;
        const cloud = call.rows("positions", positions, Float32Array, dimensions);
        const args = [
            ...cloud, dimensions, radius, whole("count", count), constant("order", order, ORDERS), seedOf(options),
        ];
        const [indices, ranks] = call.make("thin", args, Uint32Array, Float32Array);
        return withRanks({ indices }, ranks);
    }, options);
}

// A measurement of the plane: its arguments are the domain, the positions, and more.
function ofPlane(positions, options, body) {
    options = withDefaults(DOMAIN, options);
    return calling((call) => {
        return body(call, [...domainOf(options), ...call.rows("positions", positions, Float32Array, 2)]);
    }, options);
}

export function planeMeasure(positions, options) {
    return ofPlane(positions, options, (call, args) => {
        const [
            count, smallestDistance, meanDistance, hexagonalDistance, coveringRadius, bondOrder, triangles, obtuse,
            below30Degrees, anglesBelow30Degrees, edgeMean, edgeVariation, areaVariation, beyond4Sigma,
        ] = call.make("plane_measure", args, Float64Array)[0];
        return {
            count, smallestDistance, meanDistance, hexagonalDistance,
            rho: count === 0 ? Infinity : smallestDistance / hexagonalDistance, coveringRadius, bondOrder, triangles, obtuse,
            below30Degrees, anglesBelow30Degrees, edgeMean, edgeVariation, areaVariation, beyond4Sigma,
        };
    });
}

export function planeSmallestDistance(positions, options) {
    return ofPlane(positions, options, (call, args) => call.make("plane_distance", [...args, 0], Float64Array)[0][0]);
}

export function planeCoveringRadius(positions, options) {
    return ofPlane(positions, options, (call, args) => call.make("plane_distance", [...args, 1], Float64Array)[0][0]);
}

export function planeNearestHistogram(positions, reach, bins, options) {
    return ofPlane(positions, options, (call, args) => {
        return call.make("plane_nearest_histogram", [...args, reach, whole("bins", bins)], Uint32Array)[0];
    });
}

export function spaceMeasure(positions, options) {
    options = withDefaults(SPACE, options);
    return calling((call) => {
        const place = call.options(domainOf(options, 3));
        const args = [place, options.radius, ...call.rows("positions", positions, Float32Array, 3)];
        const [measured] = call.make("space_measure", args, Float64Array);
        const [
            count, smallestDistance, meanDistance, packedDistance, rho, coveringRadius, relativeCoveringRadius, conflicts, gaps,
        ] = measured;
        return {
            count, smallestDistance, meanDistance, packedDistance, rho, coveringRadius, relativeCoveringRadius, conflicts, gaps,
        };
    }, options);
}

export function spaceCoverage(positions, radius, options) {
    options = withDefaults(CUBOID, options);
    return calling((call) => {
        const place = call.options(domainOf(options, 3));
        const args = [place, radius, ...call.rows("positions", positions, Float32Array, 3)];
        const [[coveringRadius, gaps]] = call.make("space_coverage", args, Float64Array);
        return { coveringRadius, gaps };
    }, options);
}

export function spaceRadialDistribution(positions, reach, bins, options) {
    options = withDefaults(CUBOID, options);
    return calling((call) => {
        const place = call.options(domainOf(options, 3));
        const args = [place, reach, whole("bins", bins), ...call.rows("positions", positions, Float32Array, 3)];
        return call.make("space_radial_distribution", args, Float64Array)[0];
    }, options);
}

export function spaceSpectrum(positions, frequencyReach, options) {
    options = withDefaults(SPACE_SPECTRUM, options);
    return calling((call) => {
        const place = call.options(domainOf(options, 3));
        const args = [
            place, frequencyReach, whole("frequencyStride", options.frequencyStride), options.width,
            ...call.rows("positions", positions, Float32Array, 3),
        ];
        return annuliOf(call.make("space_spectrum", args, Float64Array)[0]);
    }, options);
}

export function spaceAxisPower(positions, axis, count, options) {
    options = withDefaults(CUBOID, options);
    return calling((call) => {
        const place = call.options(domainOf(options, 3));
        const sizes = [whole("axis", axis), whole("count", count)];
        const args = [place, ...sizes, ...call.rows("positions", positions, Float32Array, 3)];
        return call.make("space_axis_power", args, Float64Array)[0];
    }, options);
}

export function meshMeasure(mesh, positions, options) {
    options = withDefaults(WATCHED, options);
    return calling((call) => {
        const args = [meshPointer(mesh), ...call.rows("positions", positions, Float32Array, 3)];
        const [[smallestDistance, coveringRadius]] = call.make("mesh_measure", args, Float64Array);
        return { smallestDistance, coveringRadius };
    }, options);
}

export function planeCoverage(positions, radius, options) {
    return ofPlane(positions, options, (call, [...args]) => {
        args.splice(5, 0, radius);
        const [[coveringRadius, gaps]] = call.make("plane_coverage", args, Float64Array);
        return { coveringRadius, gaps };
    });
}

export function meshCoverage(mesh, positions, radius, options) {
    return calling((call) => {
        const args = [meshPointer(mesh), radius, ...call.rows("positions", positions, Float32Array, 3)];
        const [[coveringRadius, gaps]] = call.make("mesh_coverage", args, Float64Array);
        return { coveringRadius, gaps };
    }, withDefaults(WATCHED, options));
}

export function spaceSmallestDistance(positions, options) {
    return calling((call) => {
        const args = call.rows("positions", positions, Float32Array, 3);
        return call.make("space_smallest_distance", args, Float64Array)[0][0];
    }, withDefaults(WATCHED, options));
}

export function meshUncoveredFraction(mesh, positions, radius, options) {
    options = withDefaults(PROBES, options);
    return calling((call) => {
        const args = [
            meshPointer(mesh), radius, BigInt(whole("probes", options.probes)), seedOf(options),
            ...call.rows("positions", positions, Float32Array, 3),
        ];
        return call.make("mesh_uncovered_fraction", args, Float64Array)[0][0];
    }, options);
}

export function planeRadialDistribution(positions, reach, bins, options) {
    return ofPlane(positions, options, (call, args) => {
        return call.make("plane_radial_distribution", [...args, reach, whole("bins", bins)], Float64Array)[0];
    });
}

// The handle of the mean of what the caller has, of one kind.
function meanOf(argument, kind, Kind, all) {
    const pointers = [...all].map((one) => {
        if (one instanceof Kind) return one.pointer;
        throw new TypeError(`${argument}: not all are of the class ${Kind.name}`);
    });
    return created(`${kind}_mean`, (call) => call.rows(argument, pointers, Uint32Array, 1))[0];
}

function annuliOf(numbers) {
    return Array.from({ length: numbers.length / 4 }, (_, i) => {
        const [frequency, power, anisotropy, count] = numbers.subarray(4 * i, 4 * i + 4);
        return { frequency, power, anisotropy, count };
    });
}

export class Spectrum extends Handle {
    constructor(positions, size, options) {
        if (positions === MADE) {
            super("spectrum", options);
            this.size = size;
            return;
        }
        options = withDefaults(SPECTRA, options);
        const sizes = [whole("size", size), whole("frequencyStride", options.frequencyStride)];
        const [pointer] = created("spectrum_create", (call) => [
            ...domainOf(options), ...call.rows("positions", positions, Float32Array, 2), ...sizes,
        ], options);
        super("spectrum", pointer);
        this.size = size;
    }

    static mean(spectra) {
        const all = [...spectra];
        return new Spectrum(MADE, all[0]?.size, meanOf("spectra", "spectrum", Spectrum, all));
    }

    power() {
        return calling((call) => call.make("spectrum_power", [this.pointer], Float32Array)[0]);
    }

    radial(width = 0.05) {
        return annuliOf(calling((call) => call.make("spectrum_radial", [this.pointer, width], Float64Array))[0]);
    }

    measure(low, high, width) {
        return calling((call) => {
            const args = [this.pointer, low, high, width];
            const [column, row, effectiveNyquist, oscillation, contrast, peak, x, y] =
                call.make("spectrum_measure", args, Float64Array)[0];
            const figures = { frequencyStep: [column, row], contrast, peak, peakFrequency: [x, y] };
            return { ...figures, ...known({ effectiveNyquist, oscillation }) };
        });
    }
}

export function spectrum(positions, options) {
    const { size, width, ...others } = withDefaults(SPECTRUM, options);
    const made = new Spectrum(positions, size, others);
    try {
        return { size, power: made.power(), annuli: made.radial(width) };
    } finally {
        made.free();
    }
}

export class Differences extends Handle {
    constructor(mesh, samples, options) {
        if (mesh === MADE) {
            super("differences", samples);
            return;
        }
        options = withDefaults(DIFFERENCES, options);
        const { positions, normals } = samples;
        const direction = corner("direction", options.direction, 3);
        const [pointer] = created("differences_create", (call) => [
            meshPointer(mesh), ...call.rows("positions", positions, Float32Array, 3),
            ...call.rows("normals", normals, Float32Array, 3), call.options(direction), seedOf(options),
        ], options);
        super("differences", pointer);
    }

    static mean(differences) {
        return new Differences(MADE, meanOf("differences", "differences", Differences, differences));
    }

    #densities() {
        const types = [Float64Array, Float64Array];
        return calling((call) => call.make("differences_densities", [this.pointer], ...types));
    }

    density() {
        return this.#densities()[0];
    }

    radial() {
        return this.#densities()[1];
    }

    power(frequencies) {
        return calling((call) => {
            const args = [this.pointer, ...call.rows("frequencies", frequencies, Float64Array, 1)];
            return call.make("differences_power", args, Float64Array)[0];
        });
    }
}
