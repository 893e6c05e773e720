// The library, in a worker: the page stays responsive while it samples. Tasks keep nothing that they cannot make again, so
// that a worker can be ended at any time, and a new one take its place.
import * as azulejo from "./azulejo/index.js";
import { bestCandidate, bridson, countConflicts, jittered, wrapped } from "./naive.js";

// On all processors where the page is isolated, else on one.
const ready = azulejo.init({ threads: 0 });

// The result of a call, and its milliseconds.
function timed(body) {
    const start = performance.now();
    const result = body();
    return [result, performance.now() - start];
}

// The last thing of a kind, so long as its key is the same.
function kept(make) {
    let key = null, value = null;
    return (wanted, ...rest) => {
        if (wanted !== key) {
            value?.free();
            [key, value] = [null, null];
            value = make(...rest);
            key = wanted;
        }
        return value;
    };
}

const keptPlane = kept((options) => new azulejo.KdrtPlane(options));
const keptMesh = kept(({ name, bytes, positions, indices }) => (
    bytes ? azulejo.Mesh.parse(name, bytes) : new azulejo.Mesh(positions, indices)
));
const meshOf = (source) => keptMesh(source.id, source);

// The samples of one class.
function ofClass(positions, classes, wanted) {
    const out = [];
    classes.forEach((k, i) => {
        if (k === wanted) out.push(positions[3 * i], positions[3 * i + 1], positions[3 * i + 2]);
    });
    return Float32Array.from(out);
}

const tasks = {
    // The samples of a window of a plane.
    plane({ options, min, max }) {
        const [plane, made] = timed(() => keptPlane(JSON.stringify(options), options));
        const [{ positions }, milliseconds] = timed(() => plane.window(min, max));
        return { positions, milliseconds, made };
    },

    // What is needed to draw a mesh.
    mesh({ mesh }) {
        const { positions, indices } = meshOf(mesh).arrays();
        return { positions, indices, area: meshOf(mesh).area };
    },

    surface({ mesh, options, own, factor }) {
        const on = meshOf(mesh);
        if (!own) {
            const [set, milliseconds] = timed(() => azulejo.pspSample(on, options));
            return { ...set, milliseconds };
        }
        const radii = azulejo.classesRadii(own, factor);
        const [set, milliseconds] = timed(() => azulejo.pspSampleClasses(on, options, radii));
        return { ...set, radii, milliseconds };
    },

    // Conflicts and gaps of a set on a mesh, by the calls of the library's analysis, on the samples as they were returned.
    certificate({ mesh, positions, radius, cover }) {
        const [found, milliseconds] = timed(() => {
            const smallest = azulejo.spaceSmallestDistance(positions);
            const conflicts = smallest >= radius ? 0 : countConflicts(positions, 3, radius);
            return { smallest, conflicts, ...azulejo.meshCoverage(meshOf(mesh), positions, cover) };
        });
        return { ...found, milliseconds };
    },

    // The same of several classes. Of gaps only those of the first class: it has the largest radius and covers the mesh by
    // itself. Each other class covers it together with those before, at several distances.
    classCertificate({ mesh, positions, classes, radii, count }) {
        const [found, milliseconds] = timed(() => {
            let conflicts = 0;
            const sets = Array.from({ length: count }, (_, k) => ofClass(positions, classes, k));
            for (let k = 0; k < count; k++) {
                const own = radii[k * count + k];
                if (azulejo.spaceSmallestDistance(sets[k]) < own) conflicts += countConflicts(sets[k], 3, own);
                for (let j = 0; j < k; j++) {
                    // Between two classes: pairs of the union that are closer than their radius and not of one class.
                    const both = new Float32Array([...sets[j], ...sets[k]]);
                    const isPair = (a, b) => (a < sets[j].length / 3) !== (b < sets[j].length / 3);
                    conflicts += countConflicts(both, 3, radii[j * count + k], undefined, isPair);
                }
            }
            const { gaps } = azulejo.meshCoverage(meshOf(mesh), sets[0], radii[0]);
            return { conflicts, gaps, sizes: sets.map((set) => set.length / 3) };
        });
        return { ...found, milliseconds };
    },

    // azulejo and naive algorithms on the unit torus, judged alike.
    peers({ radius, seed, candidates }) {
        const judged = (name, [positions, milliseconds]) => {
            const smallest = azulejo.planeSmallestDistance(positions);
            const conflicts = smallest >= radius ? 0 : countConflicts(positions, 2, radius, wrapped);
            const { gaps, coveringRadius } = azulejo.planeCoverage(positions, radius);
            return { name, positions, milliseconds, count: positions.length / 2, smallest, conflicts, gaps, coveringRadius };
        };
        const ours = judged("azulejo", timed(() => azulejo.kdrtSample({ radius, seed }).positions));
        return { radius, sets: [
            ours,
            judged("Bridson's dart throwing", timed(() => bridson(radius, seed))),
            judged("Jittered grid", timed(() => jittered(ours.count, seed))),
            judged("Best candidate", timed(() => bestCandidate(ours.count, candidates, seed))),
        ] };
    },

    stipple({ values, width, height, count, seed, steps }) {
        const longer = Math.max(width, height);
        const domain = { domainMin: [0, 0], domainMax: [width / longer, height / longer], boundary: "bounded" };
        const density = { values, width, height };
        const [set, milliseconds] = timed(() => {
            const { positions } = azulejo.dcrScatter(density, count, { ...domain, seed });
            return azulejo.dcrRelaxDensity(positions, density, { ...domain, seed, maxIterations: steps });
        });
        return { ...set, domainMax: domain.domainMax, milliseconds };
    },

    // The inside of a box or of a mesh; how far apart samples are is measured on what was returned.
    volume({ mesh, options }) {
        const [set, milliseconds] = timed(() => (
            mesh ? azulejo.volumeSampleInside(meshOf(mesh), options) : azulejo.volumeSample(options)
        ));
        const smallest = azulejo.spaceSmallestDistance(set.positions);
        const conflicts = smallest >= set.radius ? 0 : countConflicts(set.positions, 3, set.radius);
        return { ...set, smallest, conflicts, milliseconds };
    },

    mask({ options, image, levels }) {
        const [ranks, milliseconds] = timed(() => azulejo.maskCreate(options));
        const [dithered, ditherMilliseconds] = timed(() => azulejo.maskDither(ranks, options, image, levels));
        return { ranks, dithered, milliseconds, ditherMilliseconds };
    },
};

onmessage = async ({ data: { id, task, args } }) => {
    try {
        await ready;
        const result = tasks[task](args);
        const arrays = [result, ...(result.sets ?? [])].flatMap((part) => Object.values(part)).filter(ArrayBuffer.isView);
        postMessage({ id, result }, arrays.map(({ buffer }) => buffer));
    } catch (error) {
        // A trap: the module's memory is used up, and what it holds is lost.
        postMessage({ id, error: error.message, isLost: error instanceof WebAssembly.RuntimeError });
    }
};
