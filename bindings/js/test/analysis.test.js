// What is measured of sets, and relaxation by the thesis's method.
import assert from "node:assert/strict";
import { before, test } from "node:test";
import * as azulejo from "../index.js";
import { covering, hasSum, ready, smallest, wrapped } from "./oracles.js";

before(ready);

const near = (found, wanted, within = 1e-6) =>
    assert.ok(Math.abs(found - wanted) <= within, `${found}, but ${wanted} by the oracle`);
const mean = (numbers) => numbers.reduce((sum, x) => sum + x, 0) / numbers.length;
const variation = (numbers) => mean(numbers.map((x) => (x - mean(numbers)) ** 2)) / mean(numbers) ** 2;

// Of each point the distance of the nearest other one, by all pairs.
function nearestOf(positions, width, wrap) {
    const count = positions.length / width;
    const distance = (i, j) => Math.sqrt(Array.from({ length: width }, (_, axis) =>
        wrap(positions[width * i + axis] - positions[width * j + axis]) ** 2).reduce((sum, d) => sum + d, 0));
    const others = (i) => Array.from({ length: count }, (_, j) => (i === j ? Infinity : distance(i, j)));
    return Array.from({ length: count }, (_, i) => Math.min(...others(i)));
}

const IMAGES = [-1, 0, 1].flatMap((x) => [-1, 0, 1].map((y) => [x, y]));

// The Delaunay triangles of points of the unit torus, each once, by empty circles among all images.
function trianglesOf(positions, reach) {
    const sites = [];
    for (let i = 0; i < positions.length; i += 2) {
        for (const [x, y] of IMAGES) sites.push([positions[i] + x, positions[i + 1] + y, i / 2, x === 0 && y === 0]);
    }
    const distance = (a, b) => Math.hypot(a[0] - b[0], a[1] - b[1]);
    const found = new Map();
    for (const a of sites.filter(([, , , isOriginal]) => isOriginal)) {
        const around = sites.filter((b) => b !== a && distance(a, b) < 2 * reach);
        around.forEach((b, i) => around.slice(0, i).forEach((c) => {
            const [bx, by, cx, cy] = [b[0] - a[0], b[1] - a[1], c[0] - a[0], c[1] - a[1]];
            const twice = 2 * (bx * cy - by * cx);
            const [bb, cc] = [bx * bx + by * by, cx * cx + cy * cy];
            const centre = [a[0] + (cy * bb - by * cc) / twice, a[1] + (bx * cc - cx * bb) / twice];
            const radius = distance(centre, a);
            if (radius > 2 * reach || around.some((d) => d !== b && d !== c && distance(d, centre) < radius - 1e-9)) return;
            // Of the images of a triangle those are one whose centres are.
            const key = centre.map((x) => Math.round((x - Math.floor(x)) * 1e7) % 1e7).join(" ");
            found.set(key, [a, b, c]);
        }));
    }
    return [...found.values()];
}

test("points of the plane are measured as by naive code", () => {
    const { positions } = azulejo.kdrtSample({ count: 60, seed: 3 });
    const figures = azulejo.planeMeasure(positions);
    const nearest = nearestOf(positions, 2, wrapped);
    const hexagonal = Math.sqrt(2 / (Math.sqrt(3) * 60));
    assert.equal(figures.count, 60);
    near(figures.smallestDistance, Math.min(...nearest), 1e-12);
    near(figures.meanDistance, mean(nearest), 1e-12);
    near(figures.hexagonalDistance, hexagonal, 1e-12);
    near(figures.rho, Math.min(...nearest) / hexagonal, 1e-12);
    assert.equal(azulejo.planeSmallestDistance(positions), figures.smallestDistance);
    assert.equal(azulejo.planeCoveringRadius(positions), figures.coveringRadius);
    const farthest = covering(positions, wrapped, 400);
    assert.ok(figures.coveringRadius >= farthest && figures.coveringRadius < farthest + Math.SQRT1_2 / 400);

    const triangles = trianglesOf(positions, figures.coveringRadius);
    assert.deepEqual([triangles.length, figures.triangles], [120, 120]);
    const sides = (of) => [0, 1, 2].map((k) => Math.hypot(of[k][0] - of[(k + 1) % 3][0], of[k][1] - of[(k + 1) % 3][1]));
    const angles = triangles.map((of) => {
        const [c, a, b] = sides(of);
        const opposite = (x, y, z) => (Math.acos((y * y + z * z - x * x) / (2 * y * z)) * 180) / Math.PI;
        return [opposite(a, b, c), opposite(b, c, a), opposite(c, a, b)];
    });
    const share = (list, is) => list.filter(is).length / list.length;
    near(figures.obtuse, share(angles, (of) => Math.max(...of) > 90));
    near(figures.below30Degrees, share(angles, (of) => Math.min(...of) < 30));
    near(figures.anglesBelow30Degrees, share(angles.flat(), (angle) => angle < 30));
    const lengths = triangles.flatMap(sides);
    near(figures.edgeMean, mean(lengths));
    near(figures.edgeVariation, variation(lengths));
    const areas = triangles.map(([a, b, c]) => Math.abs((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) / 2);
    near(mean(areas), 1 / 120, 1e-9);
    near(figures.areaVariation, variation(areas));
    const sigma = Math.sqrt(variation(areas)) * mean(areas);
    near(figures.beyond4Sigma, share(areas, (area) => Math.abs(area - mean(areas)) > 4 * sigma));
    // Of each point the directions to its neighbours, each once for two triangles.
    const orders = Array.from({ length: 60 }, () => new Map());
    for (const of of triangles) {
        for (const a of of) {
            for (const b of of) {
                const angle = Math.atan2(b[1] - a[1], b[0] - a[0]);
                if (a !== b) orders[a[2]].set(Math.round(angle * 1e6), angle);
            }
        }
    }
    near(figures.bondOrder, mean(orders.map((of) => {
        const all = [...of.values()];
        return Math.hypot(mean(all.map((angle) => Math.cos(6 * angle))), mean(all.map((angle) => Math.sin(6 * angle))));
    })));
    assert.throws(() => azulejo.planeMeasure([2, 2]), /^Error: positions: /);
    assert.deepEqual([azulejo.planeMeasure([]).count, azulejo.planeMeasure([]).rho], [0, Infinity]);
});

test("nearest neighbours are counted in bins", () => {
    for (const [boundary, wrap] of [["periodic", wrapped], ["bounded", (d) => d]]) {
        const { positions } = azulejo.kdrtSample({ count: 500, boundary });
        const hexagonal = Math.sqrt(2 / (Math.sqrt(3) * 500));
        const expected = new Uint32Array(20);
        for (const distance of nearestOf(positions, 2, wrap)) expected[Math.floor((distance / hexagonal) * 20)]++;
        assert.deepEqual(azulejo.planeNearestHistogram(positions, 1, 20, { boundary }), expected);
    }
    assert.throws(() => azulejo.planeNearestHistogram([0.5, 0.5], 1, 0), /^Error: bins: /);
    assert.throws(() => azulejo.planeNearestHistogram([0.5, 0.5], -1, 5), /^Error: reach: /);
});

test("figures and gaps of cuboids", () => {
    const { positions } = azulejo.volumeSample({ radius: 0.2, seed: 4 });
    const count = positions.length / 3;
    const figures = azulejo.spaceMeasure(positions);
    assert.equal(figures.count, count);
    near(figures.meanDistance, mean(nearestOf(positions, 3, wrapped)), 1e-9);
    near(figures.packedDistance, Math.cbrt(Math.SQRT2 / count), 1e-12);
    near(figures.rho, smallest(positions, 3, wrapped) / figures.packedDistance, 1e-9);
    near(figures.relativeCoveringRadius, figures.coveringRadius / figures.packedDistance, 1e-12);
    for (const radius of [0.19, 0.2]) {
        const coverage = azulejo.spaceCoverage(positions, radius);
        assert.equal(coverage.gaps, azulejo.spaceMeasure(positions, { radius }).gaps);
        assert.equal(coverage.gaps > 0, radius < 0.2);
        near(coverage.coveringRadius, figures.coveringRadius, 1e-9);
    }
    // One ball around the middle of a cube leaves its 8 corners.
    assert.equal(azulejo.spaceCoverage([0.5, 0.5, 0.5], 0.8, { boundary: "bounded" }).gaps, 8);
    assert.throws(() => azulejo.spaceCoverage(positions, 0), /^Error: radius: /);
});

test("spectra and distributions of cuboids are those of naive sums", () => {
    const { positions } = azulejo.volumeSample({ radius: 0.2, seed: 4 });
    const count = positions.length / 3;
    const power = (...waves) => {
        const turn = (i) => 2 * Math.PI * waves.reduce((sum, k, axis) => sum + k * positions[3 * i + axis], 0);
        const turns = Array.from({ length: count }, (_, i) => turn(i));
        const sum = (of) => turns.reduce((sum, turn) => sum + of(turn), 0);
        return (sum(Math.cos) ** 2 + sum(Math.sin) ** 2) / count;
    };
    for (const axis of [0, 1, 2]) {
        const waves = (k) => [0, 1, 2].map((other) => (other === axis ? k : 0));
        azulejo.spaceAxisPower(positions, axis, 12).forEach((found, i) => near(found, power(...waves(i + 1)), 1e-6));
    }
    const [shell] = azulejo.spaceSpectrum(positions, 2.1 / Math.cbrt(count), { width: 1 });
    const along = [-2, -1, 0, 1, 2];
    const all = along.flatMap((x) => along.flatMap((y) => along.map((z) => [x, y, z])));
    const inside = all.filter((waves) => Math.hypot(...waves) <= 2 && Math.hypot(...waves) > 0);
    assert.equal(2 * shell.count, inside.length);
    near(shell.power, mean(inside.map((waves) => power(...waves))), 1e-5);
    const density = azulejo.spaceRadialDistribution(positions, 1.5, 15);
    const rho = azulejo.spaceMeasure(positions).rho;
    density.forEach((found, bin) => assert.equal(found > 0, bin + 1 > 10 * rho));
    const throws = (call, argument) => assert.throws(call, new RegExp(`^Error: ${argument}: `));
    throws(() => azulejo.spaceSpectrum(positions, 0), "frequencyReach");
    throws(() => azulejo.spaceSpectrum(positions, 1, { frequencyStride: 0 }), "frequencyStride");
    throws(() => azulejo.spaceSpectrum(positions, 1, { width: 0 }), "width");
    throws(() => azulejo.spaceAxisPower(positions, 3, 1), "axis");
    throws(() => azulejo.spaceAxisPower(positions, 0, 0), "count");
    throws(() => azulejo.spaceRadialDistribution(positions, 9, 1), "reach");
});

test("spectra are those of naive Fourier sums", () => {
    const sets = [1, 2].map((seed) => azulejo.kdrtSample({ count: 300, seed }).positions);
    const power = (positions, x, y) => {
        const turns = Array.from({ length: 300 }, (_, i) => 2 * Math.PI * (x * positions[2 * i] + y * positions[2 * i + 1]));
        const sum = (of) => turns.reduce((sum, turn) => sum + of(turn), 0);
        return (sum(Math.cos) ** 2 + sum(Math.sin) ** 2) / 300;
    };
    for (const frequencyStride of [1, 3]) {
        const spectra = sets.map((positions) => new azulejo.Spectrum(positions, 24, { frequencyStride }));
        const grid = Array.from({ length: 24 * 24 }, (_, i) => [(i % 24) - 12, Math.floor(i / 24) - 12]);
        const expected = sets.map((positions) => grid.map(([x, y]) =>
            (x === 0 && y === 0 ? 0 : power(positions, frequencyStride * x, frequencyStride * y))));
        spectra.forEach((spectrum, k) => spectrum.power().forEach((found, i) => near(found, expected[k][i], 1e-4)));
        const both = azulejo.Spectrum.mean(spectra);
        assert.equal(both.size, 24);
        both.power().forEach((found, i) => near(found, (expected[0][i] + expected[1][i]) / 2, 1e-4));

        // The annuli of the mean, from its frequencies of one half plane.
        const step = frequencyStride / Math.sqrt(300);
        const half = grid.filter(([x, y]) => (y >= 0 && x < 12 && y < 12) && (y > 0 || x > 0));
        const [width, rings] = [0.3, []];
        for (const [x, y] of half) {
            const frequency = Math.hypot(x, y) * step;
            if (Math.hypot(x, y) > 11) continue;
            (rings[Math.floor(frequency / width)] ??= []).push([frequency, both.power()[(y + 12) * 24 + x + 12]]);
        }
        const annuli = both.radial(width);
        let checked = 0;
        for (const ring of rings.filter((ring) => ring?.length > 1)) {
            const found = annuli.find(({ frequency }) => Math.abs(frequency - mean(ring.map(([frequency]) => frequency))) < 1e-9);
            if (found?.count !== ring.length) continue;
            checked++;
            near(found.power, mean(ring.map(([, power]) => power)), 1e-4);
        }
        assert.ok(checked >= Math.min(annuli.length, rings.length) - 1 && checked > 1, `${checked} of ${annuli.length}`);

        const [low, high] = [0.2, 3];
        const figures = both.measure(low, high, width);
        figures.frequencyStep.forEach((found) => near(found, step, 1e-12));
        const inRange = annuli.filter(({ frequency }) => frequency >= low && frequency < high);
        const all = inRange.reduce((sum, { count }) => sum + count, 0);
        near(figures.contrast, inRange.reduce((sum, { count, anisotropy }) => sum + count * anisotropy, 0) / all, 1e-9);
        // The peak is the power at its frequency over the mean of its annulus.
        const [x, y] = figures.peakFrequency.map((frequency) => Math.round(frequency / step));
        const length = Math.hypot(x, y) * step;
        const ring = rings[Math.floor(length / width)].map(([, power]) => power);
        near(figures.peak, both.power()[(y + 12) * 24 + x + 12] / mean(ring), 0.05 * figures.peak);
        assert.ok(figures.peak > 1 && length >= low && length < high);
        for (const spectrum of [...spectra, both]) spectrum.free();
    }
    // The mean power within twice the effective Nyquist frequency is 0.1 (Heck et al. 2013).
    const large = new azulejo.Spectrum(azulejo.dcrRelax(sets[0]).positions, 256);
    const { effectiveNyquist, oscillation } = large.measure(0.2, 2, 0.05);
    const inside = [...large.power()].filter((_, i) => {
        const [x, y] = [(i % 256) - 128, Math.floor(i / 256) - 128];
        return (x !== 0 || y !== 0) && Math.hypot(x, y) / Math.sqrt(300) < 2 * effectiveNyquist;
    });
    near(mean(inside), 0.1, 0.02);
    assert.ok(effectiveNyquist > 0.35 && oscillation > 0, `${effectiveNyquist} ${oscillation}`);
    const tiny = new azulejo.Spectrum(sets[0], 4).measure(0.01, 0.2, 0.05);
    assert.equal("effectiveNyquist" in tiny, false);
    assert.deepEqual(azulejo.spectrum(sets[0], { size: 24, width: 0.3 }).power, new azulejo.Spectrum(sets[0], 24).power());
    const throws = (body, name) => assert.throws(body, (error) => error.message.startsWith(`${name}: `));
    throws(() => new azulejo.Spectrum(sets[0], 1), "size");
    throws(() => new azulejo.Spectrum(sets[0], 8, { frequencyStride: 0 }), "frequencyStride");
    throws(() => large.radial(0), "width");
    throws(() => large.measure(NaN, 1, 0.1), "low");
    throws(() => azulejo.Spectrum.mean([]), "spectra");
    throws(() => azulejo.Spectrum.mean([large, new azulejo.Spectrum(sets[0], 8)]), "spectra");
    large.free();
    throws(() => large.power(), "spectrum");
});

test("relaxation by the thesis's method has the bytes of the Rust calls, and options of its own", () => {
    const { positions } = azulejo.kdrtSample({ count: 1000, seed: 14 });
    const thesis = { method: "thesis", maxIterations: 60 };
    const bounded = { ...thesis, neighbourhood: "nearest", boundary: "bounded" };
    const relaxed = azulejo.dcrRelax(positions, bounded);
    assert.ok(hasSum("thesis nearest", relaxed.positions));
    assert.ok(hasSum("thesis nearest: report", Float64Array.of(relaxed.motion, relaxed.rho, relaxed.relativeCoveringRadius)));
    near(relaxed.smallestDistance, smallest(relaxed.positions, 2), 1e-9);
    const defaults = {
        conflictRadius: 0.95, attractionRadius: 1.05, step: 0.05, decay: 1, neighbours: 6, distribution: "activeness",
        visits: "both_ends", convergence: "motion", tolerance: 0.005,
    };
    assert.deepEqual(azulejo.dcrRelax(positions, { ...bounded, ...defaults }), relaxed);
    const others = {
        conflictRadius: 0.8, step: 0.1, decay: 0.9, neighbours: 3, distribution: "eighty_twenty", visits: "one_end", tolerance: 1,
    };
    for (const [name, value] of Object.entries(others)) {
        assert.notDeepEqual(azulejo.dcrRelax(positions, { ...bounded, [name]: value }).positions, relaxed.positions, name);
    }
    const delaunay = azulejo.dcrRelax(positions, thesis);
    assert.notDeepEqual(azulejo.dcrRelax(positions, { ...thesis, attractionRadius: 1.3 }).positions, delaunay.positions);
    assert.ok(azulejo.dcrRelax(positions, { ...thesis, maxIterations: 1000 }).iterations > 60);
    const throws = (body, name) => assert.throws(body, (error) => error.message.startsWith(`${name}: `));
    for (const [name, value] of Object.entries({ ...defaults, tolerance: null })) {
        if (value !== null) throws(() => azulejo.dcrRelax(positions, { [name]: value }), name);
    }
    throws(() => azulejo.dcrRelax(positions, { ...thesis, conflictRadius: 2 }), "conflictRadius");
    throws(() => azulejo.dcrRelax(positions, { ...thesis, neighbours: 0.5 }), "neighbours");
    throws(() => azulejo.dcrRelax(positions, { ...thesis, distribution: "none" }), "distribution");
    throws(() => azulejo.dcrRelax(positions, { ...thesis, step: "1" }), "step");
    throws(() => azulejo.dcrRelax(positions, { tolerance: -1 }), "tolerance");
    throws(() => azulejo.dcrRelax(positions, { method: "other" }), "method");
});
