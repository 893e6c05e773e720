// The package against naive oracles: all pairs, and points of a fine grid; and the sums of tests/sums.txt.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { before, test } from "node:test";
import * as azulejo from "../index.js";
import { apart, covering, hasSum, interpolated, ready, smallest, sumsTorus, torus, wrapped } from "./oracles.js";

before(ready);

test("sets of the plane are conflict-free, maximal and the same each time", () => {
    for (const [boundary, wrap] of [["periodic", wrapped], ["bounded", (d) => d]]) {
        for (let seed = 0; seed < 3; seed++) {
            const options = { radius: 0.03, boundary, seed };
            const { positions } = azulejo.kdrtSample(options);
            assert.ok(positions.length / 2 > 600);
            assert.ok(smallest(positions, 2, wrap) >= 0.03);
            assert.ok(covering(positions, wrap) <= 0.03 + 1e-6);
            assert.deepEqual(positions, azulejo.kdrtSample(options).positions);
            const { smallestDistance, coveringRadius } = azulejo.planeMeasure(positions, { boundary });
            assert.ok(Math.abs(smallestDistance - smallest(positions, 2, wrap)) < 1e-12);
            assert.ok(coveringRadius <= 0.03 + 1e-6 && coveringRadius >= covering(positions, wrap));
        }
    }
    const seeds = [0, 1, 2n ** 63n].map((seed) => azulejo.kdrtSample({ radius: 0.03, seed }).positions);
    assert.notDeepEqual(seeds[0], seeds[1]);
    assert.notDeepEqual(seeds[0], seeds[2]);
});

test("sets of a cuboid are measured", () => {
    for (const [boundary, wrap] of [["periodic", wrapped], ["bounded", (d) => d]]) {
        const { positions } = azulejo.volumeSample({ radius: 0.2, boundary });
        const found = azulejo.spaceMeasure(positions, { boundary, radius: 0.2 });
        assert.ok(Math.abs(found.smallestDistance - smallest(positions, 3, wrap)) < 1e-12);
        assert.ok(found.coveringRadius <= 0.2 + 1e-6 && found.meanDistance >= found.smallestDistance);
        assert.deepEqual([found.conflicts, found.gaps], [0, 0]);
        assert.ok(azulejo.spaceMeasure(positions, { boundary, radius: 0.25 }).conflicts > 0);
        assert.ok(azulejo.spaceMeasure(positions, { boundary, radius: 0.16 }).gaps > 0);
        assert.throws(() => azulejo.spaceMeasure(positions, { boundary, radius: -1 }), /radius/);
    }
});

test("cuboids are tiled", () => {
    const { positions } = azulejo.volumeSample({ radius: 0.0288, leafSize: 6 });
    const share = positions.length / azulejo.volumeSample({ radius: 0.0288 }).positions.length;
    assert.ok(share > 1.005 && share < 1.06, share);
    const { conflicts, gaps } = azulejo.spaceMeasure(positions, { radius: 0.0288 });
    assert.deepEqual([conflicts, gaps], [0, 0]);
    assert.throws(() => azulejo.volumeSample({ radius: 0.1, leafSize: 5 }), /leafSize: 5/);
    assert.throws(() => azulejo.volumeSample({ count: 10, leafSize: 20 }), /leafSize: 20/);
});

test("points of a cuboid are relaxed", () => {
    const start = azulejo.volumeSample({ count: 400 }).positions;
    for (const [boundary, wrap] of [["periodic", wrapped], ["bounded", (d) => d]]) {
        const { positions, rho, smallestDistance, iterations } = azulejo.volumeRelax(start, { boundary });
        assert.equal(positions.length, start.length);
        assert.ok(Math.abs(smallest(positions, 3, wrap) / smallestDistance - 1) < 1e-9);
        assert.ok(Math.abs(rho - smallestDistance / Math.cbrt(Math.SQRT2 / 400)) < 1e-9 && rho > 0.88 && iterations <= 100);
        assert.deepEqual(azulejo.volumeRelax(start, { boundary, maxIterations: 0 }).positions, start);
        assert.throws(() => azulejo.volumeRelax([2, 0, 0], { boundary }), /positions/);
    }
});

test("points are relaxed to the spectrum of a step", () => {
    const correlation = azulejo.dcrCorrelationOfPower([0], 0.5);
    assert.equal(correlation.length, 480);
    assert.ok(correlation.every((value) => value > -1e-3) && Math.abs(correlation.at(-1) - 1) < 0.05);
    const start = azulejo.kdrtSample({ count: 1000 }).positions;
    const { positions, residual } = azulejo.dcrRelaxToCorrelation(start, correlation, 12);
    assert.ok(residual <= 0.02, `${residual}`);
    assert.notDeepEqual(positions, start);
    assert.throws(() => azulejo.dcrRelaxToCorrelation(start, correlation, 12, { boundary: "bounded" }), /boundary/);
    assert.throws(() => azulejo.dcrRelaxToCorrelation(start, correlation, -1), /reach/);
});

test("counts are exact, progressive sets have ranks that their prefixes keep", () => {
    const { positions, ranks, radius } = azulejo.kdrtSample({ count: 777, order: "progressive" });
    assert.equal(positions.length, 2 * 777);
    assert.ok(radius > 0);
    for (const count of [2, 10, 100, 777]) {
        assert.ok(smallest(positions.subarray(0, 2 * count), 2, wrapped) >= ranks[count - 1]);
    }
});

test("new samples keep clear of given ones", () => {
    const [givenPositions, givenClearances] = [[0.5, 0.5, 0.1, 0.2], [0.2, 0.05]];
    const { positions } = azulejo.kdrtSample({ radius: 0.02, givenPositions, givenClearances });
    for (let i = 0; i < positions.length; i += 2) {
        for (const k of [0, 1]) {
            const distance = Math.hypot(
                wrapped(positions[i] - Math.fround(givenPositions[2 * k])),
                wrapped(positions[i + 1] - Math.fround(givenPositions[2 * k + 1])),
            );
            assert.ok(distance >= givenClearances[k]);
        }
    }
});

test("windows of a plane are parts of it", () => {
    const options = { radius: 0.02, seed: 5 };
    const plane = new azulejo.KdrtPlane(options);
    const pairs = ({ positions }) => new Set(Array.from({ length: positions.length / 2 }, (_, i) =>
        `${positions[2 * i]} ${positions[2 * i + 1]}`));
    const all = pairs(azulejo.kdrtSample(options));
    const windows = [plane.window([0, 0], [0.5, 1]), plane.window([0.5, 0], [1, 1])].map(pairs);
    assert.deepEqual(new Set([...windows[0], ...windows[1]]), all);
    assert.deepEqual(pairs(azulejo.kdrtSampleWindow(options, [0, 0], [0.5, 1])), windows[0]);
    plane.free();
    plane.free();
    assert.throws(() => plane.window([0, 0], [1, 1]), /plane: was freed/);
});

test("classes keep their distances", () => {
    const radii = [0.06, 0.04, 0.04, 0.03];
    const { positions, classes } = azulejo.kdrtSampleClasses({ seed: 1 }, radii);
    assert.equal(classes.length, positions.length / 2);
    for (let i = 0; i < classes.length; i++) {
        for (let j = 0; j < i; j++) {
            const [x, y] = [0, 1].map((axis) => wrapped(positions[2 * i + axis] - positions[2 * j + axis]));
            assert.ok(Math.sqrt(x * x + y * y) >= radii[2 * classes[i] + classes[j]]);
        }
    }
});

test("classes around given samples and in progressive order have the bytes of the Rust calls", () => {
    const order = { order: "progressive", seed: 3 };
    const radii = [0.1, 0.07, 0.07, 0.05];
    const { positions, classes, ranks } = azulejo.kdrtSampleClasses(order, radii);
    for (const of of [0, 1]) {
        const own = [...classes.keys()].filter((i) => classes[i] === of);
        assert.ok(own.length > 50 && own.every((i, k) => k === 0 || ranks[i] <= ranks[own[k - 1]]));
        for (const count of [2, 12, own.length]) {
            const first = own.slice(0, count).flatMap((i) => [...positions.subarray(2 * i, 2 * i + 2)]);
            const rank = Math.min(ranks[own[count - 1]], 1);
            assert.ok(smallest(first, 2, wrapped) >= Math.min(rank, Math.SQRT1_2));
        }
    }
    const givenPositions = [0.5, 0.5, 0.25, 0.25];
    const around = azulejo.kdrtSampleClasses({ givenPositions, givenClearances: [0.2, 0, 0, 0.1] }, radii);
    const nearest = (given, of) => Math.min(...Array.from(around.classes, (at, i) => {
        const [x, y] = [0, 1].map((axis) => wrapped(around.positions[2 * i + axis] - givenPositions[2 * given + axis]));
        return at === of ? Math.hypot(x, y) : Infinity;
    }));
    assert.ok(nearest(0, 0) >= 0.2 && nearest(0, 1) < 0.2 && nearest(1, 1) >= 0.1 && nearest(1, 0) < 0.1);
    // Windows of a kept plane of classes are parts of it.
    const plane = new azulejo.KdrtPlane(order, radii);
    const window = plane.window([0.5, 0], [1, 1]);
    const row = (set, i) => [set.classes[i], set.ranks[i], ...set.positions.subarray(2 * i, 2 * i + 2)].join(" ");
    const whole = [...classes.keys()].filter((i) => positions[2 * i] >= 0.5).map((i) => row({ positions, classes, ranks }, i));
    assert.deepEqual([...window.classes.keys()].map((i) => row(window, i)).sort(), whole.sort());
    plane.free();
    assert.equal(new azulejo.KdrtPlane({ radius: 0.1 }).window([0, 0], [1, 1]).classes, undefined);
    const sums = azulejo.kdrtSampleClasses({ seed: 26, boundary: "bounded" }, classRadii([0.01, 0.01, 0.01, 0.01], 0.7));
    assert.ok(hasSum("classes equal", sums.positions, sums.classes));
    const given = {
        givenPositions: Array.from({ length: 300 }, (_, i) => [((i * 619) % 307) / 300, ((i * 41) % 301) / 301]).flat(),
        givenClearances: Array.from({ length: 600 }, (_, i) => 1e-3 * (i % 23) * (i % 2)),
    };
    const own = classRadii([0.015, 0.008], 0.9);
    const cleared = azulejo.kdrtSampleClasses({ seed: 26, ...given }, own);
    assert.ok(hasSum("classes around", cleared.positions, cleared.classes));
    const equally = azulejo.kdrtSampleClasses({ seed: 26, givenPositions: given.givenPositions }, own);
    assert.ok(hasSum("classes around equal", equally.positions, equally.classes));
    const part = new azulejo.KdrtPlane({ seed: 26, ...given }, own).window([0.8, 0.3], [1, 0.6]);
    assert.ok(hasSum("classes around, window", part.positions, part.classes));
});

// Wei's matrix for classes of these own radii.
function classRadii(own, factor = 1) {
    const smallestOwn = Math.min(...own);
    const square = (x) => x * x;
    const density = (radius) => own.filter((r) => r >= radius).reduce((sum, r) => sum + square(smallestOwn / r), 0);
    return own.flatMap((a, i) => own.map((b, j) =>
        i === j ? a : (factor * smallestOwn) / Math.sqrt(density(Math.min(a, b)))));
}

test("classes on meshes keep their distances, masks and ranks, and follow densities", () => {
    const positions = [], indices = [];
    // A square of 8 by 8 quads.
    for (let i = 0; i < 81; i++) positions.push((i % 9) / 8, Math.floor(i / 9) / 8, 0);
    for (let i = 0; i < 72; i++) if (i % 9 < 8) indices.push(i, i + 1, i + 10, i, i + 10, i + 9);
    const mesh = new azulejo.Mesh(positions, indices);
    const radii = [0.08, 0.06, 0.06, 0.05];
    const masks = Array.from({ length: indices.length / 3 }, (_, t) => (t < 64 ? 3 : 1));
    const check = (set, reach) => {
        assert.ok(set.classes.length > 80);
        for (let i = 0; i < set.classes.length; i++) {
            for (let j = 0; j < i; j++) {
                assert.ok(apart(set.positions, i, j) >= radii[2 * set.classes[i] + set.classes[j]] * reach(set, i, j));
            }
        }
        // Class 1 keeps to the lower half; class 0 has no gap at a place whose local radius is 1.
        assert.ok(set.classes.every((of, i) => of === 0 || set.positions[3 * i + 1] <= 0.5));
        for (let place = 0; place < 400; place++) {
            const [x, y] = [0.6 + (0.4 * (place % 20)) / 20, Math.floor(place / 20) / 20];
            assert.ok([...set.classes.keys()].some((i) => {
                const local = (1 + (set.radii ? set.radii[i] : 1)) / 2;
                const distance = Math.hypot(set.positions[3 * i] - x, set.positions[3 * i + 1] - y);
                return distance <= radii[set.classes[i]] * local + 1e-6;
            }));
        }
    };
    const set = azulejo.pspSampleClasses(mesh, { seed: 2, masks }, radii);
    check(set, () => 1);
    assert.equal(set.radii, undefined);
    // Four times the density in the left half: half the radius.
    const values = Array.from({ length: 81 }, (_, i) => (i % 9 < 4 ? 4 : 1));
    const dense = azulejo.pspClassesWithDensity(mesh, { seed: 2, masks }, radii, { values, radius: 1 });
    check(dense, ({ radii: local }, i, j) => (local[i] + local[j]) / 2);
    const inLeft = (set) => set.classes.filter((_, i) => set.positions[3 * i] < 0.375).length;
    assert.ok(inLeft(dense) > 2.5 * inLeft(set));
    const ordered = azulejo.pspSampleClasses(mesh, { order: "progressive", quotient: 1.3 }, radii);
    const own = [...ordered.classes.keys()].filter((i) => ordered.classes[i] === 1);
    assert.ok(own.every((i, k) => k === 0 || ordered.ranks[i] <= ordered.ranks[own[k - 1]]));
    const first = own.slice(0, 20).flatMap((i) => [...ordered.positions.subarray(3 * i, 3 * i + 3)]);
    assert.ok(smallest(first, 3) >= ordered.ranks[own[19]]);
    mesh.free();
});

test("classes on meshes and sets that follow a density have the bytes of the Rust calls", () => {
    const [positions, indices, normals] = sumsTorus();
    const mesh = new azulejo.Mesh(positions, indices);
    const masks = Array.from({ length: indices.length / 3 }, (_, i) => (i % 9 < 5 ? 7 : i % 8));
    const isSum = (name, set) => hasSum(name, set.positions, set.normals, interpolated(set, indices, normals),
        set.triangles, set.barycentrics, set.ranks ?? [], set.classes, set.radii ?? []);
    assert.ok(isSum("classes", azulejo.pspSampleClasses(mesh, { masks, seed: 46 }, classRadii([0.05, 0.1, 0.05]))));
    const values = Float32Array.from({ length: positions.length / 3 }, (_, i) =>
        Math.max(Math.fround(positions[3 * i] + Math.fround(0.5 * positions[3 * i + 2])), 0));
    const density = { values, count: 2000 };
    const dense = azulejo.pspClassesWithDensity(mesh, { masks, seed: 48 }, classRadii([1, 2, 1]), density);
    assert.ok(isSum("classes, density", dense));
    assert.ok(!isSum("classes", dense));
    mesh.free();
});

test("radii on meshes vary by vertex, by density and by image", () => {
    const mesh = torus();
    const x = (positions, i) => positions[3 * i];
    const vertices = 48 * 24;
    const angles = Array.from({ length: vertices }, (_, i) => Math.cos((2 * Math.PI * Math.floor(i / 24)) / 48));
    const vertexRadii = angles.map((cosine) => (cosine > 0 ? 0.1 : 0.25));
    const byRadii = azulejo.pspAdaptiveSample(mesh, { seed: 1 }, vertexRadii);
    assert.ok(byRadii.radii.length > 200 && Math.min(...byRadii.radii) < 0.11 && Math.max(...byRadii.radii) > 0.24);
    const byDensity = azulejo.pspAdaptiveWithDensity(
        mesh, { order: "progressive" }, { values: angles.map((cosine) => (cosine > 0 ? 4 : 1)), count: 300 });
    assert.equal(byDensity.triangles.length, 300);
    assert.equal(Math.fround(byDensity.radius), byDensity.ranks[299]);
    const right = byDensity.triangles.reduce((count, _, i) => count + (x(byDensity.positions, i) > 0), 0);
    assert.ok(right > 210 && right < 265);
    for (const { positions, radii } of [byRadii, byDensity]) {
        for (let i = 0; i < radii.length; i++) {
            for (let j = 0; j < i; j++) assert.ok(apart(positions, i, j) >= (radii[i] + radii[j]) / 2);
        }
    }
    const values = new Float32Array(32).fill(1);
    const ofVertices = Array(2 * vertices).fill(0.5);
    const ofCorners = Array(2 * 3 * 2 * vertices).fill(0.5);
    for (const texture of [ofVertices, ofCorners]) {
        const image = azulejo.pspAdaptiveWithDensity(mesh, {}, { values, width: 8, height: 4, texture, radius: 0.2 });
        assert.ok(image.radii.length > 100 && image.radii.every((radius) => Math.abs(radius - 0.2) < 1e-6));
    }
    mesh.free();
});

// The bytes of each sample by its id.
function byId({ positions, ids }, axes) {
    return new Map(Array.from(ids, (id, i) => [id, positions.subarray(axes * i, axes * (i + 1)).join(" ")]));
}

test("a stroke in the plane and its undo", () => {
    const plane = new azulejo.Plane({ radius: 0.02, seed: 4 });
    const before = plane.points();
    assert.deepEqual(before.positions, azulejo.kdrtSample({ radius: 0.02, seed: 4 }).positions);
    assert.deepEqual([...before.ids], [...before.ids.keys()]);
    const stroke = { centre: [1, 0.5], radius: 0.1 };
    const erased = plane.erase(stroke); // over the seam
    const sides = erased.positions.filter((_, i) => i % 2 === 0);
    assert.ok(sides.some((x) => x < 0.2) && sides.some((x) => x > 0.8));
    const added = plane.refill(5);
    const after = plane.points();
    assert.ok(smallest(after.positions, 2, wrapped) >= 0.02);
    assert.ok(covering(after.positions, wrapped) <= 0.02 + 1e-6);
    const expected = byId(before, 2);
    for (const id of erased.ids) assert.ok(expected.delete(id));
    for (const [id, place] of byId(added, 2)) expected.set(id, place);
    const sorted = (map) => [...map].sort(([a], [b]) => a - b);
    assert.deepEqual(sorted(byId(after, 2)), sorted(expected));
    assert.equal(plane.eraseIds(added.ids).ids.length, added.ids.length);
    plane.restore(erased);
    assert.deepEqual(sorted(byId(plane.points(), 2)), sorted(byId(before, 2)));
    plane.erase(stroke);
    assert.deepEqual(plane.refill(5n).positions, added.positions);
    assert.equal(plane.refill().ids.length, 0);
    plane.free();
    assert.throws(() => plane.points(), /set: was freed/);
});

test("sets of the plane begin with positions and take given samples", () => {
    const plane = new azulejo.Plane({ radius: 0.05, domainMax: [1, 2], boundary: "bounded" }, [0.25, 0.5, 0.75, 0.125]);
    assert.deepEqual([...plane.points().positions], [0.25, 0.5, 0.75, 0.125]);
    plane.refill();
    const { first, erased } = plane.addGiven([0.5, 1], [0.3]);
    assert.ok(first === 0 && erased.ids.length > 50);
    plane.refill();
    const distances = () => {
        const { positions } = plane.points();
        const distance = (_, i) => Math.hypot(positions[2 * i] - 0.5, positions[2 * i + 1] - 1);
        return Array.from({ length: positions.length / 2 }, distance);
    };
    assert.ok(Math.min(...distances()) >= 0.3);
    plane.removeGiven([0]);
    assert.ok(plane.refill(1).ids.length > 50);
    assert.ok(Math.min(...distances()) < 0.1);
    const low = plane.erase({ min: [0, 0], max: [1, 0.5] });
    assert.ok(low.ids.length > 100 && plane.points().positions.every((x, i) => i % 2 === 0 || x > 0.5));
    const left = distances().length;
    assert.ok(left > 100 && plane.erase().ids.length === left && distances().length === 0);
});

test("sets on meshes grow, are edited and undone", () => {
    const mesh = torus();
    const set = new azulejo.Psp(mesh, { radius: 0.15, seed: 2 });
    assert.equal(set.points().triangles.length, 0);
    assert.ok(set.advance(1) > 50);
    assert.ok(set.fill() > 0 && set.fill() === 0);
    const before = set.points();
    const whole = azulejo.pspSample(mesh, { radius: 0.15, seed: 2, iterations: 1 });
    assert.deepEqual(before.positions, whole.positions);
    assert.deepEqual(before.barycentrics, whole.barycentrics);
    assert.equal(before.ids.length, 0);
    const stroke = { centre: [1.4, 0, 0], radius: 0.5, min: [-2, -2, 0], max: [2, 2, 2] };
    const erased = set.erase(stroke);
    const inside = ([x, y, z]) => Math.hypot(x - 1.4, y, z) <= 0.5 && z >= 0;
    const row = (positions, i) => [...positions.subarray(3 * i, 3 * i + 3)];
    const rows = (positions) => Array.from({ length: positions.length / 3 }, (_, i) => row(positions, i));
    assert.deepEqual(rows(erased.positions), rows(before.positions).filter(inside));
    assert.deepEqual([...erased.ids], rows(before.positions).flatMap((row, i) => (inside(row) ? [i] : [])));
    assert.throws(() => set.advance(1), /iterations: of a set that has been edited/);
    const added = set.refill(7);
    assert.ok(added.ids.length > 5 && smallest(set.points().positions, 3) >= 0.15);
    assert.ok(azulejo.meshMeasure(mesh, set.points().positions).coveringRadius <= 0.15 + 1e-5);
    set.eraseIds(added.ids);
    set.restore(erased);
    const { positions, triangles, barycentrics, normals, ids } = set.points();
    assert.deepEqual([...ids], [...ids.keys()]);
    assert.deepEqual({ positions, triangles, barycentrics, normals, ids: before.ids }, before);
    set.erase(stroke);
    assert.deepEqual(set.refill(7).positions, added.positions);
    const { first, erased: near } = set.addGiven([1.4, 0, 0], [0.4]);
    assert.ok(first === 0 && near.ids.length > 3);
    const count = set.points().ids.length;
    assert.equal(count, ids.length - erased.ids.length + added.ids.length - near.ids.length);
    assert.equal(count + set.fill(), set.points().ids.length);
    mesh.free(); // the set keeps what it needs of it
    assert.ok(rows(set.points().positions).every(([x, y, z]) => Math.hypot(x - 1.4, y, z) >= 0.4));
    set.removeGiven([0]);
    assert.ok(set.refill().ids.length > 0);
});

test("relaxation spreads a set and says so", () => {
    const { positions } = azulejo.kdrtSample({ count: 1000 });
    const relaxed = azulejo.dcrRelax(positions, { seed: 1 });
    assert.equal(relaxed.positions.length, 2000);
    assert.ok(relaxed.rho > 0.8 && relaxed.iterations > 0);
    assert.ok(Math.abs(relaxed.smallestDistance - smallest(relaxed.positions, 2, wrapped)) < 1e-12);
    assert.deepEqual(relaxed, azulejo.dcrRelax(positions, { seed: 1 }));
});

test("sets on meshes are conflict-free, maximal, and can be relaxed", () => {
    const mesh = torus();
    assert.ok(Math.abs(mesh.area - 4 * Math.PI ** 2 * 0.4) < 0.3);
    const samples = pspChecked(mesh, { radius: 0.15, seed: 3 });
    assert.ok(azulejo.meshMeasure(mesh, samples.positions).coveringRadius <= 0.15 + 1e-5);
    assert.deepEqual(samples, azulejo.pspSample(mesh, { radius: 0.15, seed: 3 }));
    const relaxed = azulejo.dcrSurfaceRelax(mesh, samples, { maxIterations: 30 });
    assert.equal(relaxed.triangles.length, samples.triangles.length);
    assert.ok(Math.abs(relaxed.smallestDistance - smallest(relaxed.positions, 3)) < 1e-9);
    assert.ok(relaxed.smallestDistance > 0.15);
    const counted = azulejo.pspSample(mesh, { count: 200, order: "progressive" });
    assert.equal(counted.triangles.length, 200);
    assert.equal(counted.ranks.length, 200);
    pspChecked(mesh, { radius: 0.15, iterations: 1, maximal: false });
    mesh.free();
    assert.throws(() => azulejo.pspSample(mesh, { radius: 0.1 }), /mesh: was freed/);
});

function pspChecked(mesh, options) {
    const samples = azulejo.pspSample(mesh, options);
    assert.ok(samples.triangles.length > 100);
    assert.ok(smallest(samples.positions, 3) >= options.radius);
    return samples;
}

// The largest distance of a point of a grid of a box from the set.
function coveringInSpace(positions, low, high, wrap, cells = 20) {
    const along = (axis, i) => low[axis] + ((high[axis] - low[axis]) * (i + 0.5)) / cells;
    let most = 0;
    for (let place = 0; place < cells ** 3; place++) {
        const at = [0, 1, 2].map((axis) => along(axis, Math.floor(place / cells ** axis) % cells));
        let least = Infinity;
        for (let i = 0; i < positions.length; i += 3) {
            const squared = at.reduce((sum, x, axis) => sum + wrap(x - positions[i + axis]) ** 2, 0);
            least = Math.min(least, squared);
        }
        most = Math.max(most, least);
    }
    return Math.sqrt(most);
}

test("classes in cuboids keep their distances", () => {
    const radii = azulejo.classesRadii([0.25, 0.15]);
    const given = { givenPositions: [0.5, 0.5, 0.5], givenClearances: [0.4, 0.1] };
    const { positions, classes } = azulejo.volumeSampleClasses({ boundary: "bounded", ...given }, radii);
    const at = (i) => positions.subarray(3 * i, 3 * i + 3);
    const distance = (p, q) => Math.hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
    assert.ok(classes.length === positions.length / 3 && classes.includes(0) && classes.includes(1));
    for (let i = 0; i < classes.length; i++) {
        assert.ok(distance(at(i), [0.5, 0.5, 0.5]) >= given.givenClearances[classes[i]]);
        for (let j = 0; j < i; j++) assert.ok(distance(at(i), at(j)) >= radii[2 * classes[i] + classes[j]]);
    }
    assert.throws(() => azulejo.volumeSampleClasses({}, [1, 2, 3, 4]), /radii: \[0\]\[1\]/);
});

test("sets inside meshes are conflict-free, and maximal below the surface", () => {
    const corners = [0, 1, 2, 3, 4, 5, 6, 7].flatMap((k) => [k & 1, (k >> 1) & 1, k >> 2]);
    const squares = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    const triangles = squares.flatMap(([a, b, c, d]) => [a, b, c, a, c, d]);
    const mesh = new azulejo.Mesh(corners, triangles);
    for (const surface of ["open", "first"]) {
        const { positions, depth, surfaceSamples, ranks } = azulejo.volumeSampleInside(mesh, { radius: 0.15, surface });
        assert.ok(positions.every((x) => x >= 0 && x <= 1) && ranks === undefined);
        assert.equal(surfaceSamples > 100, surface === "first");
        assert.ok(smallest(positions, 3) >= 0.15 && depth < 0.11 * 0.15);
        const [low, high] = [[depth, depth, depth], [1 - depth, 1 - depth, 1 - depth]];
        assert.ok(coveringInSpace(positions, low, high, (d) => d) <= 0.15 + 1e-6);
    }
    const { positions: start, surfaceSamples } = azulejo.volumeSampleInside(mesh, { radius: 0.15, surface: "first" });
    const fixed = Array.from({ length: start.length / 3 }, (_, i) => i < surfaceSamples);
    const relaxed = azulejo.volumeRelaxInside(mesh, start, { fixed, maxIterations: 30 });
    assert.equal(relaxed.iterations, 30);
    assert.deepEqual(relaxed.positions.subarray(0, 3 * surfaceSamples), start.subarray(0, 3 * surfaceSamples));
    const moved = relaxed.positions.subarray(3 * surfaceSamples);
    assert.ok(mesh.contains(moved).every((is) => is === 1) && moved.some((x, i) => x !== start[3 * surfaceSamples + i]));
    const slid = azulejo.volumeRelaxInside(mesh, start, { sliding: fixed, maxIterations: 30 }).positions;
    const toSurface = (i) => Math.min(...slid.subarray(3 * i, 3 * i + 3).map((x) => Math.min(Math.abs(x), Math.abs(1 - x))));
    assert.ok(fixed.every((slides, i) => !slides || toSurface(i) < 1e-6));
    assert.ok(fixed.some((slides, i) => slides && slid[3 * i] !== start[3 * i]));
    assert.throws(() => azulejo.volumeRelaxInside(mesh, [0.5, 0.5, 0.5], { sliding: [1] }), /positions: point 0 is .*sliding/);
    assert.throws(() => azulejo.volumeRelaxInside(mesh, [0.5, 0.5, 2]), /positions: point 0 is .*, outside the mesh/);
    assert.throws(() => azulejo.volumeRelaxInside(mesh, [0.5, 0.5, 0.5], { fixed: [1, 0] }), /fixed: has 2 entries/);
    const counted = azulejo.volumeSampleInside(mesh, { count: 150, order: "progressive", tolerance: 0.1 });
    assert.deepEqual([counted.positions.length, counted.ranks.length], [450, 150]);
    const open = new azulejo.Mesh(corners, triangles.slice(3));
    const filled = azulejo.volumeSampleInside(open, { radius: 0.15 });
    assert.ok(smallest(filled.positions, 3) >= 0.15 && mesh.contains(filled.positions).every((is) => is === 1));
    const loose = new azulejo.Mesh(corners, triangles.slice(0, 3));
    assert.throws(() => azulejo.volumeSampleInside(loose, { radius: 0.15 }), /mesh: encloses nothing/);
    assert.throws(() => azulejo.volumeSampleInside(mesh, { radius: 0.15, surface: "last" }), /surface: last/);
    assert.throws(() => azulejo.volumeSampleInside(mesh, { radius: 0.15, tolerance: 1 }), /tolerance: /);
    const all = azulejo.volumeSampleInside(mesh, { radius: 0.15 }).positions;
    assert.deepEqual(azulejo.volumeSampleInside(mesh, { radius: 0.15, thickness: 0.501 }).positions, all);
    const shell = azulejo.volumeSampleInside(mesh, { radius: 0.15, thickness: 0.2 }).positions;
    const depths = Array.from({ length: shell.length / 3 }, (_, i) =>
        Math.min(...[...shell.subarray(3 * i, 3 * i + 3)].map((x) => Math.min(x, 1 - x))));
    assert.ok(shell.length < all.length && Math.max(...depths) <= 0.2 && smallest(shell, 3) >= 0.15);
    assert.throws(() => azulejo.volumeSampleInside(mesh, { radius: 0.15, thickness: NaN }), /thickness: /);
});

test("sets of boxes and solids with radii on a grid keep the mean of two radii", () => {
    const corners = Float32Array.from({ length: 24 }, (_, i) => (Math.floor(i / 3) >> i % 3) & 1);
    const faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    const mesh = new azulejo.Mesh(corners, Uint32Array.from(faces.flatMap(([a, b, c, d]) => [a, b, c, a, c, d])));
    const values = [0.1, 0.2, 0.15, 0.1];
    for (const of of [null, mesh]) {
        const options = of === null ? { boundary: "bounded", seed: 2 } : { tolerance: 0.1, seed: 2 };
        const { positions, radii, radius, coveringRadius } = azulejo.volumeAdaptiveSample(options, values, [2, 1, 2], of);
        assert.ok(radii.length > 200 && positions.length === 3 * radii.length);
        assert.ok(Math.min(...radii) === radius && Math.abs(coveringRadius - 0.2) < 1e-7);
        for (let i = 0; i < radii.length; i++) {
            for (let j = 0; j < i; j++) {
                const d = Math.hypot(...[0, 1, 2].map((k) => positions[3 * i + k] - positions[3 * j + k]));
                assert.ok(d >= 0.5 * (radii[i] + radii[j]) * (1 - 1e-12));
            }
        }
    }
    assert.throws(() => azulejo.volumeAdaptiveSample({}, values, [2, 2, 2]), /gridSize: /);
    assert.throws(() => azulejo.volumeAdaptiveSample({}, [0.1, -1], [2, 1, 1]), /gridValues: /);
    assert.throws(() => azulejo.volumeAdaptiveSample({ tolerance: 0.1 }, values, [2, 1, 2]), /tolerance: /);
    assert.throws(() => azulejo.volumeAdaptiveSample({ boundary: "bounded" }, values, [2, 1, 2], mesh), /boundary: /);
});

test("sets of boxes are conflict-free, maximal, exact in number and nested in progressive order", () => {
    const unit = [[0, 0, 0], [1, 1, 1]];
    const torus = azulejo.volumeSample({ radius: 0.15, seed: 3 });
    assert.ok(torus.positions.length / 3 > 150);
    assert.ok(smallest(torus.positions, 3, wrapped) >= 0.15);
    assert.ok(coveringInSpace(torus.positions, ...unit, wrapped) <= 0.15 + 1e-6);
    assert.equal(torus.coveringRadius, 0.15);
    const slab = { domainMin: [-1, 2, 0], domainMax: [1, 2.5, 0.25], boundary: "bounded" };
    const { positions } = azulejo.volumeSample({ radius: 0.1, ...slab });
    assert.ok(positions.every((x, i) => x >= slab.domainMin[i % 3] && x < slab.domainMax[i % 3]));
    assert.ok(smallest(positions, 3) >= 0.1);
    assert.ok(coveringInSpace(positions, slab.domainMin, slab.domainMax, (d) => d) <= 0.1 + 1e-6);
    const counted = azulejo.volumeSample({ count: 400, order: "progressive", quotient: 1.2 });
    assert.equal(counted.ranks.length, 400);
    for (const count of [100, 250, 400]) {
        const [prefix, rank] = [counted.positions.subarray(0, 3 * count), counted.ranks[count - 1]];
        assert.ok(smallest(prefix, 3, wrapped) >= rank);
        assert.ok(coveringInSpace(prefix, ...unit, wrapped) <= 1.2 * rank + 1e-6);
    }
});

test("sets of boxes keep clear of given samples, and have the bytes of the Rust calls", () => {
    const givenPositions = Array.from({ length: 180 }, (_, i) => ((Math.floor(i / 3) * [31, 47, 83][i % 3]) % 256) / 256);
    const givenClearances = Array.from({ length: 60 }, (_, i) => 0.3 / [1, 7, 60, 1000][i % 4]);
    const given = { givenPositions, givenClearances };
    const around = azulejo.volumeSample({ radius: 0.04, seed: 81, ...given });
    for (let k = 0; k < 60; k++) {
        for (let i = 0; i < around.positions.length; i += 3) {
            const offsets = [0, 1, 2].map((axis) => wrapped(around.positions[i + axis] - givenPositions[3 * k + axis]));
            assert.ok(Math.sqrt(offsets.reduce((sum, d) => sum + d * d, 0)) >= givenClearances[k]);
        }
    }
    assert.ok(hasSum("volume torus, given", around.positions));
    assert.ok(!hasSum("volume cube, given", around.positions));
    const ordered = { radius: 0.04, seed: 81, boundary: "bounded", order: "progressive", quotient: 1.3 };
    const { positions, ranks } = azulejo.volumeSample({ ...ordered, ...given });
    assert.ok(hasSum("volume cube, progressive, given", positions, ranks));
    const bar = { domainMin: [0.25, -7, 0], domainMax: [0.26, 7, 0.3], boundary: "bounded" };
    assert.ok(hasSum("volume bar", azulejo.volumeSample({ radius: 0.05, seed: 75, ...bar }).positions));
});

test("thinning selects what no selected point before is nearer to", () => {
    const cloud = azulejo.kdrtSample({ radius: 0.02 }).positions;
    const { indices } = azulejo.thin(cloud, 2, { radius: 0.1 });
    const selected = [];
    for (let i = 0; i < cloud.length / 2; i++) {
        const near = (j) => Math.sqrt((cloud[2 * i] - cloud[2 * j]) ** 2 + (cloud[2 * i + 1] - cloud[2 * j + 1]) ** 2) < 0.1;
        if (!selected.some(near)) selected.push(i);
    }
    assert.deepEqual([...indices], selected);
    assert.equal(azulejo.thin(cloud, 2, { count: 10, order: "progressive" }).ranks.length, 10);
});

test("low frequencies have little power, high ones that of random points", () => {
    const { positions } = azulejo.kdrtSample({ radius: 0.02 });
    const { power, annuli, size } = azulejo.spectrum(positions, { size: 128, width: 0.05 });
    assert.equal(power.length, size * size);
    const mean = (from, to) => {
        const inside = annuli.filter(({ frequency }) => frequency >= from && frequency < to);
        return inside.reduce((sum, ring) => sum + ring.power, 0) / inside.length;
    };
    assert.ok(mean(0.05, 0.4) < 0.1);
    assert.ok(mean(0.9, 1.3) > 0.8);
});

test("errors name the argument, and leave the module usable", () => {
    const throws = (body, name) => assert.throws(body, (error) => error.message.startsWith(`${name}: `));
    throws(() => azulejo.kdrtSample({ radius: -1 }), "radius");
    throws(() => azulejo.kdrtSample({ radius: 0.1, leafSize: 1 }), "leafSize");
    throws(() => azulejo.kdrtSample({ radius: 1e-5 }), "radius");
    throws(() => azulejo.kdrtSample({ count: 1e9 }), "count");
    throws(() => azulejo.kdrtSample({ radius: 1e-4, order: "progressive" }), "radius"); // more than 32 bits address
    throws(() => azulejo.kdrtSample({ radius: 0.1, seed: -1 }), "seed");
    throws(() => azulejo.kdrtSample({ radius: 0.1, boundary: "none" }), "boundary");
    throws(() => azulejo.kdrtSample({ radius: 0.1, sead: 1 }), "sead");
    throws(() => azulejo.kdrtSample({ radius: "1" }), "radius");
    throws(() => azulejo.dcrRelax([0.5, 2]), "positions");
    throws(() => azulejo.dcrRelax([0.5, 0.5, 0.5]), "positions");
    throws(() => new azulejo.Mesh([0, 0, 0], [0, 1, 2]), "indices");
    throws(() => azulejo.pspSample({}, { radius: 1 }), "mesh");
    throws(() => azulejo.kdrtSampleClasses({ radius: 0.1 }, [0.1]), "radius");
    throws(() => azulejo.kdrtSampleClasses({ count: 9 }, [0.1]), "count");
    throws(() => new azulejo.KdrtPlane({ radius: 0.1 }, [0.1]), "radius");
    throws(() => azulejo.kdrtSampleClasses({}, [0.1, 0.2, 0.3]), "radii");
    throws(() => new azulejo.Plane({ radius: 0.1 }, [0.5, 0.5, 0.5, 0.55]), "positions");
    throws(() => new azulejo.Plane({ radius: 0.1, count: 4 }), "count");
    const plane = new azulejo.Plane({ radius: 0.1 });
    throws(() => plane.erase({ radius: 0.1 }), "centre");
    throws(() => plane.erase({ centre: [0, 0] }), "radius");
    throws(() => plane.erase({ centre: [0, 0, 0], radius: 1 }), "centre");
    throws(() => plane.erase({ min: [1, 0], max: [0, 1] }), "region");
    throws(() => plane.eraseIds([1e6]), "ids");
    throws(() => plane.eraseIds([0.5]), "ids");
    throws(() => plane.eraseIds([0, 0]), "ids");
    throws(() => plane.restore({ positions: [0.5, 0.5], ids: [0] }), "points");
    throws(() => plane.removeGiven([0]), "ids");
    throws(() => plane.refill(-1), "seed");
    const flat = new azulejo.Mesh([0, 0, 0, 1, 0, 0, 0, 1, 0], [0, 1, 2]);
    throws(() => new azulejo.Psp(flat, { radius: 0 }), "radius");
    throws(() => azulejo.pspSampleClasses(flat, { masks: [1, 1] }, [0.1]), "maskCount");
    throws(() => azulejo.pspClassesWithDensity(flat, {}, [1], { values: [1, 1, 1] }), "radius");
    throws(() => azulejo.pspClassesWithDensity(flat, {}, [1], { values: [1, 1, 1], radius: 1, count: 1 }), "radius");
    throws(() => azulejo.pspAdaptiveWithDensity(flat, {}, { radius: 1 }), "values");
    throws(() => azulejo.pspAdaptiveWithDensity(flat, {}, { values: [1, 1], radius: 1 }), "density");
    throws(() => azulejo.pspAdaptiveSample(flat, {}, [1, 1]), "vertexRadii");
    throws(() => azulejo.pspAdaptiveSample(flat, { givenPositions: [0, 0, 0] }, [1, 1, 1]), "givenClearances");
    throws(() => azulejo.volumeSample(), "radius");
    throws(() => azulejo.volumeSample({ radius: 0.1, count: 5 }), "radius");
    throws(() => azulejo.volumeSample({ radius: 0.1, domainMin: [0, 0] }), "domainMin");
    throws(() => azulejo.volumeSample({ radius: 0.1, domainMin: [0, 0, 2] }), "domainMax");
    throws(() => azulejo.volumeSample({ count: 9, givenPositions: [0, 0, 0] }), "givenClearances");
    throws(() => azulejo.volumeSample({ radius: 0.1, givenPositions: [0, 0] }), "givenPositions");
    throws(() => azulejo.volumeSample({ radius: 0.1, order: "progressive", quotient: 2 }), "quotient");
    throws(() => azulejo.thin([0, 0], 4, { radius: 1 }), "dimensions");
    throws(() => azulejo.thin([0, 0], 2), "radius");
    assert.ok(azulejo.kdrtSample({ radius: 0.1 }).positions.length > 0);
});

test("gaps are counted", () => {
    const { positions } = azulejo.kdrtSample({ radius: 0.05, seed: 2 });
    assert.deepEqual(azulejo.planeCoverage(positions, 0.05).gaps, 0);
    // Without two samples that are far apart there are two gaps, or more where a neighbour's disk divides one.
    const [x, y] = positions;
    const isFar = (i) => Math.hypot(wrapped(positions[i] - x), wrapped(positions[i + 1] - y)) > 0.3;
    const other = Array.from({ length: positions.length / 2 }, (_, i) => 2 * i).find(isFar);
    const rest = positions.filter((_, i) => i > 1 && i !== other && i !== other + 1);
    const { gaps, coveringRadius } = azulejo.planeCoverage(rest, 0.05);
    assert.ok(gaps >= 2 && gaps < 12 && coveringRadius > 0.05 && coveringRadius <= 0.1, `${gaps} ${coveringRadius}`);
    assert.equal(azulejo.planeCoverage([0.5, 0.5], 0.6, { boundary: "bounded" }).gaps, 4);
    const mesh = torus();
    const set = azulejo.pspSample(mesh, { radius: 0.15 }).positions;
    assert.equal(azulejo.meshCoverage(mesh, set, 0.15).gaps, 0);
    assert.ok(azulejo.meshCoverage(mesh, set.subarray(3), 0.15).gaps >= 1);
    assert.equal(azulejo.spaceSmallestDistance(set), smallest(set, 3));
    assert.equal(azulejo.spaceSmallestDistance([]), Infinity);
    assert.throws(() => azulejo.planeCoverage(positions, 0), /radius: /);
    assert.throws(() => azulejo.meshCoverage(mesh, [0, 0, NaN], 1), /positions: /);
});

test("meshes are read from files", () => {
    const obj = new TextEncoder().encode("v 0 0 0\nv 2 0 0\nv 2 1 0\nv 0 1 0\nf 1 2 3 4\n");
    const mesh = azulejo.Mesh.parse("square.obj", obj);
    assert.equal(mesh.area, 2);
    const { positions, indices, origin } = mesh.arrays();
    assert.deepEqual([...positions], [0, 0, 0, 2, 0, 0, 2, 1, 0, 0, 1, 0]);
    assert.deepEqual([...indices], [0, 1, 2, 0, 2, 3]);
    assert.deepEqual([...origin], [0, 0, 0]);
    const same = new azulejo.Mesh(positions, indices);
    const options = { radius: 0.1 };
    assert.deepEqual(azulejo.pspSample(mesh, options), azulejo.pspSample(same, options));
    const off = new TextEncoder().encode("OFF\n3 1 0\n1e9 0 0\n1000000001 0 0\n1e9 1 0\n3 0 1 2\n");
    const far = azulejo.Mesh.parse("", off.buffer).arrays();
    assert.ok(Math.abs(far.origin[0] - 1e9) <= 1 && far.positions[3] - far.positions[0] === 1);
    assert.throws(() => azulejo.Mesh.parse("broken.off", new Uint8Array(9)), /broken\.off/);
    mesh.free();
    assert.throws(() => mesh.arrays(), /mesh: was freed/);
});

test("classes have the cross radii of Wei", () => {
    const radii = azulejo.classesRadii([0.1, 0.05]);
    // Of all samples of both: densities add up.
    const both = 1 / Math.sqrt(1 / 0.1 ** 2 + 1 / 0.05 ** 2);
    assert.deepEqual([radii[0], radii[3]], [0.1, 0.05]);
    assert.ok(Math.abs(radii[1] - both) < 1e-12 && radii[1] === radii[2]);
    assert.ok(Math.abs(azulejo.classesRadii([0.1, 0.05], 0.5)[1] - both / 2) < 1e-12);
    assert.throws(() => azulejo.classesRadii([0.1, 0]), /own: /);
});

test("pieces are merged without seams", () => {
    const half = (min, max, seed) => {
        const { positions } = azulejo.kdrtSample({ radius: 0.03, domainMin: min, domainMax: max, boundary: "bounded", seed });
        return { positions, min, max };
    };
    const pieces = [half([0, 0], [0.5, 1], 1), half([0.5, 0], [1, 1], 2)];
    const given = pieces[0].positions.length / 2 + pieces[1].positions.length / 2;
    const merged = azulejo.kdrtMerge(pieces, { radius: 0.03, seed: 7 }, [0.25, 0.75]);
    assert.deepEqual([...merged.positions.subarray(0, 2)], [0.25, 0.75]);
    assert.equal(merged.positions.length / 2, 1 + merged.kept + merged.inserted);
    assert.equal(merged.kept + merged.eliminated, given);
    assert.ok(merged.eliminated > 0 && merged.inserted > 0);
    assert.ok(smallest(merged.positions, 2, wrapped) >= 0.03);
    assert.equal(azulejo.planeCoverage(merged.positions, 0.03).gaps, 0);
    assert.deepEqual(azulejo.kdrtMerge(pieces, { radius: 0.03, seed: 7, maximalPieces: true }, [0.25, 0.75]), merged);
    assert.ok(azulejo.kdrtMerge([], { radius: 0.1 }).inserted > 60);
    assert.throws(() => azulejo.kdrtMerge([pieces[0], pieces[0]], { radius: 0.03 }), /pieces: /);
    assert.throws(() => azulejo.kdrtMerge([{ ...pieces[0], positions: [0.5] }], { radius: 0.03 }), /pieces: \[0\]/);
});

test("the unbiased reference is conflict-free and maximal", () => {
    for (const boundary of ["periodic", "bounded"]) {
        const { positions } = azulejo.maximalSample({ radius: 0.04, boundary, seed: 5 });
        assert.ok(smallest(positions, 2, boundary === "periodic" ? wrapped : (d) => d) >= 0.04);
        assert.equal(azulejo.planeCoverage(positions, 0.04, { boundary }).gaps, 0);
    }
    assert.throws(() => azulejo.maximalSample({}), /radius: /);
});

test("classes are relaxed together and each by itself", () => {
    const { positions, classes } = azulejo.kdrtSampleClasses({ seed: 1 }, azulejo.classesRadii([0.06, 0.04]));
    const relaxed = azulejo.dcrRelaxClasses(positions, classes, { maxIterations: 60 });
    assert.ok(Math.abs(relaxed.smallestDistance - smallest(relaxed.positions, 2, wrapped)) < 1e-9);
    for (const wanted of [0, 1]) {
        const own = relaxed.positions.filter((_, i) => classes[i >> 1] === wanted);
        const hexagonal = Math.sqrt(2 / (Math.sqrt(3) * (own.length / 2)));
        assert.ok(Math.abs(relaxed.classRho[wanted] - smallest(own, 2, wrapped) / hexagonal) < 1e-6);
        assert.ok(relaxed.classRho[wanted] > 0.5 && relaxed.classRelativeCoveringRadius[wanted] < 1.2);
    }
    assert.throws(() => azulejo.dcrRelaxClasses(positions, classes.subarray(1)), /classes: /);
});

test("uncovered shares and radial distributions", () => {
    const mesh = new azulejo.Mesh([0, 0, 0, 1, 0, 0, 0, 1, 0], [0, 1, 2]);
    const { positions } = azulejo.pspSample(mesh, { radius: 0.05 });
    assert.equal(azulejo.meshUncoveredFraction(mesh, positions, 0.05), 0);
    // A quarter of a disk around the right corner.
    const share = azulejo.meshUncoveredFraction(mesh, [0, 0, 0], 0.4, { probes: 200_000 });
    assert.ok(Math.abs(share - (1 - (Math.PI * 0.16) / 4 / 0.5)) < 0.005, `${share}`);
    const { positions: set } = azulejo.kdrtSample({ count: 3000 });
    const hexagonal = Math.sqrt(2 / (Math.sqrt(3) * 3000));
    const density = azulejo.planeRadialDistribution(set, 3, 30);
    // The share of ordered pairs in each bin over that of random points.
    const found = new Array(30).fill(0);
    for (let i = 0; i < 6000; i += 2) {
        for (let j = 0; j < 6000; j += 2) {
            const d = Math.hypot(wrapped(set[i] - set[j]), wrapped(set[i + 1] - set[j + 1])) / hexagonal;
            if (i !== j && d < 3) found[Math.floor(10 * d)]++;
        }
    }
    for (const [bin, count] of found.entries()) {
        const area = Math.PI * (((bin + 1) / 10) ** 2 - (bin / 10) ** 2) * hexagonal ** 2;
        assert.ok(Math.abs(density[bin] - count / (3000 * 2999 * area)) < 0.02, `bin ${bin}: ${density[bin]}`);
    }
    assert.throws(() => azulejo.planeRadialDistribution(set, 3, 0), /bins: /);
});

test("dots are as dense as an image is dark", () => {
    const density = { values: Float32Array.from({ length: 64 }, (_, i) => (i % 8 < 4 ? 1 : 3)), width: 8, height: 8 };
    const options = { boundary: "bounded", seed: 3 };
    const { positions } = azulejo.dcrScatter(density, 2000, options);
    assert.deepEqual(positions, azulejo.dcrScatter(density, 2000, options).positions);
    const relaxed = azulejo.dcrRelaxDensity(positions, density, { ...options, maxIterations: 50 });
    const right = (set) => set.filter((x, i) => i % 2 === 0 && x > 0.5).length / 2000;
    assert.ok(Math.abs(right(positions) - 0.75) < 0.05 && Math.abs(right(relaxed.positions) - 0.75) < 0.02);
    assert.ok(relaxed.rho > 0.5 && relaxed.positions.length === 4000);
    assert.ok(Math.abs(relaxed.smallestDistance - smallest(relaxed.positions, 2)) < 1e-9);
    assert.throws(() => azulejo.dcrScatter({ ...density, width: 9 }, 10), /density: /);
    assert.throws(() => azulejo.dcrScatter({ width: 8, height: 8 }, 10), /values: /);
    assert.throws(() => azulejo.dcrRelaxDensity([0.5, 2], density), /positions: /);
});

test("images are dithered as by the Rust calls", () => {
    const mask = { width: 16, height: 16, seed: 1 };
    const ranks = azulejo.maskCreate(mask);
    const values = new Float32Array(64 * 64).fill(0.25);
    const image = { values, width: 64, height: 64 };
    assert.equal(azulejo.maskDither(ranks, mask, image).filter((level) => level === 1).length, 64 * 64 / 4);
    for (const [name, size] of [["square", { width: 128, height: 128, channels: 2, seed: 91 }], ["of space", { width: 32, height: 24, depth: 20, seed: 94 }]]) {
        const values = Array.from({ length: 60 * 50 * 3 }, (_, i) => ((i * 37) % 1000) / 999);
        const out = azulejo.maskDither(azulejo.maskCreate(size), size, { values, width: 60, height: 50, channels: 3 }, 5);
        assert.ok(hasSum(`mask ${name}, dithered`, out), name);
    }
    const bytes = { values: new Uint8Array(300).fill(255), width: 10, height: 10, channels: 3 };
    assert.ok(azulejo.maskDither(ranks, mask, bytes, 256).every((level) => level === 255));
    assert.throws(() => azulejo.maskDither(ranks, mask, image, 1), /levels: /);
    assert.throws(() => azulejo.maskDither(ranks, { width: 8, height: 8 }, image), /ranks: /);
    assert.throws(() => azulejo.maskDither(ranks, mask, { ...image, width: 63 }), /values: /);
    assert.throws(() => azulejo.maskDither(ranks, mask, { ...image, values: values.map(() => NaN) }), /values: /);
});

test("masks are permutations, the same as everywhere, and refused by the names of their options", () => {
    const mask = azulejo.maskCreate({ width: 20, height: 12, channels: 2, seed: 4 });
    assert.equal(mask.length, 2 * 240);
    for (const channel of [mask.slice(0, 240), mask.slice(240)]) {
        assert.deepEqual([...channel].sort((a, b) => a - b), [...Array(240).keys()]);
    }
    assert.deepEqual(azulejo.maskCreate({ width: 20, height: 12, seed: 4n }), mask.slice(0, 240));
    for (const [name, value] of [["width", 1], ["depth", 65], ["channels", 0], ["sigma", NaN], ["height", 1.5]]) {
        assert.throws(() => azulejo.maskCreate({ width: 8, height: 8, [name]: value }), new RegExp(`${name}: `));
    }
    assert.throws(() => azulejo.maskCreate({ height: 8 }), /width: /);
});

test("every call of the Python package is here, by the same name in camel case", () => {
    const stubs = String(readFileSync(new URL("../../python/azulejo.pyi", import.meta.url)));
    const camel = (name) => name.replace(/_([a-z])/g, (_, letter) => letter.toUpperCase());
    const functions = [...stubs.matchAll(/^def (\w+)\(/gm)].map(([, name]) => camel(name));
    assert.ok(functions.length > 35);
    for (const name of functions) assert.equal(typeof azulejo[name], "function", name);
    // Mesh.parse takes the bytes of the file that Mesh.load opens.
    const others = { load: "parse" };
    const classes = ["KdrtPlane", "Plane", "Mesh", "Psp", "Spectrum", "Differences"];
    let methods = 0;
    for (const [, name, body] of stubs.matchAll(/^class (\w+)\b.*:\n((?:    .*\n|\n)*)/gm)) {
        // Reports, arrays of samples and protocols are plain objects here.
        if (!classes.includes(name)) continue;
        for (const [, decorator, method] of body.matchAll(/(?:    @(\w+)\n)?    def ([a-z]\w*)\(/g)) {
            if (decorator === "property") continue;
            const place = decorator === "staticmethod" ? azulejo[name] : azulejo[name].prototype;
            assert.equal(typeof place[camel(others[method] ?? method)], "function", `${name}.${method}`);
            methods++;
        }
    }
    assert.ok(methods > 25, `${methods}`);
    assert.equal(new azulejo.Cancelled().name, "Cancelled");
});
