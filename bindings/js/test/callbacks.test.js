// Callbacks: streams, progress, and how they end calls.
import assert from "node:assert/strict";
import { before, test } from "node:test";
import * as azulejo from "../index.js";
import { hasSum, ready, torus } from "./oracles.js";

before(ready);

test("streams have the samples of the set in its order, part by part", () => {
    const options = { radius: 0.0045, domainMin: [1000, -3], domainMax: [1004, -1], seed: 12 };
    const [parts, done] = [[], []];
    const progress = (share) => {
        done.push(share);
    };
    assert.equal(azulejo.kdrtStream((part) => parts.push(part), { ...options, progress }), undefined);
    assert.ok(parts.length > 3 && parts.every((part) => part instanceof Float32Array && part.length > 0 && part.length <= 100_000));
    const all = Float32Array.from(parts.flatMap((part) => [...part]));
    assert.deepEqual(all, azulejo.kdrtSample(options).positions);
    assert.ok(hasSum("stream", all));
    assert.ok(done.length > 3 && done.at(-1) === 1 && done.every((share, i) => share >= (done[i - 1] ?? 0)));
    let visits = 0;
    const stops = () => azulejo.kdrtStream(() => ++visits < 2, options);
    assert.throws(stops, azulejo.Cancelled);
    assert.equal(visits, 2);
    assert.throws(() => azulejo.kdrtStream(() => { throw new RangeError("full"); }, options), /^RangeError: full/);
    const throws = (body, name) => assert.throws(body, (error) => error.message.startsWith(`${name}: `));
    throws(() => azulejo.kdrtStream(null, options), "visit");
    throws(() => azulejo.kdrtStream(() => {}, { count: 100 }), "count");
    throws(() => azulejo.kdrtStream(() => {}, { ...options, order: "progressive" }), "order");
    const around = { radius: 0.05, givenPositions: [0.5, 0.5], givenClearances: [0.2] };
    const whole = azulejo.kdrtSample(around).positions;
    azulejo.kdrtStream((part) => assert.deepEqual(part, whole), around);
    assert.ok(whole.length > 100);
});

// Every call that can be watched, by what it is called with. Relaxation returns its state where it is cancelled.
function watchable() {
    const mesh = torus(24, 16);
    const plane = azulejo.kdrtSample({ radius: 0.03 }).positions;
    const space = azulejo.volumeSample({ radius: 0.15 }).positions;
    const set = azulejo.pspSample(mesh, { radius: 0.15 });
    const inside = azulejo.volumeSampleInside(mesh, { radius: 0.1 }).positions;
    const density = { values: [1, 2, 3, 4], width: 2, height: 2 };
    const radii = [0.05, 0.04, 0.04, 0.05];
    const vertexRadii = new Float32Array(24 * 16).fill(0.15);
    const correlation = azulejo.dcrCorrelationOfPower([0], 0.5);
    const classes = new Uint32Array(plane.length / 2);
    const grown = () => new azulejo.Psp(mesh, { radius: 0.15 });
    return {
        kdrtSample: (options) => azulejo.kdrtSample({ radius: 0.01, ...options }),
        kdrtSampleCount: (options) => azulejo.kdrtSample({ count: 3000, ...options }),
        kdrtSampleWindow: (options) => azulejo.kdrtSampleWindow({ radius: 0.005, ...options }, [0, 0], [0.5, 0.5]),
        kdrtSampleClasses: (options) => azulejo.kdrtSampleClasses(options, radii),
        kdrtMerge: (options) => azulejo.kdrtMerge([], { radius: 0.02, ...options }),
        maximalSample: (options) => azulejo.maximalSample({ radius: 0.02, ...options }),
        Plane: (options) => new azulejo.Plane({ radius: 0.02, ...options }).points(),
        planeRefill: (options) => {
            const edited = new azulejo.Plane({ radius: 0.02 });
            edited.erase();
            return edited.refill(1, options);
        },
        pspSample: (options) => azulejo.pspSample(mesh, { radius: 0.1, ...options }),
        pspAdaptiveSample: (options) => azulejo.pspAdaptiveSample(mesh, options, vertexRadii),
        pspSampleClasses: (options) => azulejo.pspSampleClasses(mesh, options, radii.map((radius) => 3 * radius)),
        advance: (options) => grown().advance(2, options),
        fill: (options) => grown().fill(options),
        volumeSample: (options) => azulejo.volumeSample({ radius: 0.1, ...options }),
        volumeSampleInside: (options) => azulejo.volumeSampleInside(mesh, { radius: 0.1, ...options }),
        volumeAdaptiveSample: (options) => azulejo.volumeAdaptiveSample(options, [0.1, 0.2], [2, 1, 1]),
        contains: (options) => mesh.contains(space, options),
        maskCreate: (options) => azulejo.maskCreate({ width: 32, height: 32, ...options }),
        thin: (options) => azulejo.thin(plane, 2, { radius: 0.05, ...options }),
        dcrScatter: (options) => azulejo.dcrScatter(density, 3000, options),
        dcrRemesh: (options) => azulejo.dcrRemesh(mesh, set, options).triangles,
        planeMeasure: (options) => azulejo.planeMeasure(plane, options),
        planeSmallestDistance: (options) => azulejo.planeSmallestDistance(plane, options),
        planeCoveringRadius: (options) => azulejo.planeCoveringRadius(plane, options),
        planeNearestHistogram: (options) => azulejo.planeNearestHistogram(plane, 1, 10, options),
        planeRadialDistribution: (options) => azulejo.planeRadialDistribution(plane, 4, 16, options),
        planeCoverage: (options) => azulejo.planeCoverage(plane, 0.03, options),
        spaceSmallestDistance: (options) => azulejo.spaceSmallestDistance(space, options),
        spaceMeasure: (options) => azulejo.spaceMeasure(space, { radius: 0.15, ...options }),
        spaceCoverage: (options) => azulejo.spaceCoverage(space, 0.15, options),
        spaceRadialDistribution: (options) => azulejo.spaceRadialDistribution(space, 2, 16, options),
        spaceSpectrum: (options) => azulejo.spaceSpectrum(space, 1, options),
        spaceAxisPower: (options) => azulejo.spaceAxisPower(space, 1, 30, options),
        meshMeasure: (options) => azulejo.meshMeasure(mesh, set.positions, options),
        meshCoverage: (options) => azulejo.meshCoverage(mesh, set.positions, 0.15, options),
        meshUncoveredFraction: (options) => azulejo.meshUncoveredFraction(mesh, set.positions, 0.15, options),
        Spectrum: (options) => new azulejo.Spectrum(plane, 32, options).power(),
        spectrum: (options) => azulejo.spectrum(plane, { size: 32, ...options }),
        Differences: (options) => new azulejo.Differences(mesh, set, options).density(),
        dcrRelax: (options) => azulejo.dcrRelax(plane, options),
        dcrRelaxThesis: (options) => azulejo.dcrRelax(plane, { method: "thesis", maxIterations: 20, ...options }),
        dcrRelaxClasses: (options) => azulejo.dcrRelaxClasses(plane, classes, options),
        dcrRelaxDensity: (options) => azulejo.dcrRelaxDensity(plane, density, options),
        dcrRelaxToCorrelation: (options) =>
            azulejo.dcrRelaxToCorrelation(plane, correlation, 12, { maxIterations: 10, ...options }),
        dcrSurfaceRelax: (options) => azulejo.dcrSurfaceRelax(mesh, set, options),
        volumeRelax: (options) => azulejo.volumeRelax(space, options),
        volumeRelaxInside: (options) => azulejo.volumeRelaxInside(mesh, inside, options),
    };
}

test("progress grows from 0 to 1, changes no result, and ends calls", () => {
    for (const [name, run] of Object.entries(watchable())) {
        const plain = run({});
        const done = [];
        const watched = run({ progress: (share) => done.push(share) });
        assert.deepEqual(watched, plain, name);
        assert.ok(done.length >= 2 && done[0] >= 0 && done.at(-1) === 1, `${name}: ${done}`);
        assert.ok(done.every((share, i) => i === 0 || share >= done[i - 1]), `${name}: ${done}`);
        if (plain.stopped !== undefined) {
            const cancelled = run({ progress: () => false });
            assert.equal(cancelled.stopped, "cancelled", name);
            assert.equal(cancelled.positions.length, plain.positions.length, name);
        } else {
            assert.throws(() => run({ progress: () => false }), azulejo.Cancelled, name);
        }
        const fails = () => { throw new SyntaxError("mine"); };
        assert.throws(() => run({ progress: fails }), /^SyntaxError: mine/, name);
        assert.throws(() => run({ progress: 1 }), /^TypeError: progress: /, name);
        assert.deepEqual(run({ progress: undefined }), plain, name);
    }
});

test("callbacks make no calls and free nothing", () => {
    const mesh = torus(24, 16);
    for (const body of [() => azulejo.planeMeasure([0.5, 0.5]), () => mesh.free(), () => mesh.area && mesh.isClosed()]) {
        assert.throws(() => azulejo.pspSample(mesh, { radius: 0.2, progress: body }), /another call runs/);
    }
    assert.ok(azulejo.pspSample(mesh, { radius: 0.2 }).triangles.length > 50);
    const set = new azulejo.Psp(mesh, { radius: 0.1 });
    assert.throws(() => set.fill({ progress: () => false }), azulejo.Cancelled);
    set.fill();
    assert.deepEqual(set.points().positions, azulejo.pspSample(mesh, { radius: 0.1, iterations: 0 }).positions);
    const cancelled = new azulejo.Cancelled();
    assert.ok(cancelled instanceof Error && cancelled.name === "Cancelled" && cancelled.message.length > 0);
});
