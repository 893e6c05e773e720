// The package against naive oracles: all pairs, and points of a fine grid; and the sums of tests/sums.txt.
import assert from "node:assert/strict";
import { createHash } from "node:crypto";
import { readFileSync } from "node:fs";
import { before, test } from "node:test";
import * as azulejo from "../index.js";

before(() => azulejo.init());

const wrapped = (d) => d - Math.round(d);

// The smallest distance of all pairs; on the unit torus where `wrap` says so.
function smallest(positions, width, wrap = (d) => d) {
    let least = Infinity;
    for (let i = 0; i < positions.length; i += width) {
        for (let j = 0; j < i; j += width) {
            let squared = 0;
            for (let axis = 0; axis < width; axis++) squared += wrap(positions[i + axis] - positions[j + axis]) ** 2;
            least = Math.min(least, squared);
        }
    }
    return Math.sqrt(least);
}

// The largest distance of a point of a grid of the unit square from the set.
function covering(positions, wrap, cells = 150) {
    let most = 0;
    for (let x = 0.5 / cells; x < 1; x += 1 / cells) {
        for (let y = 0.5 / cells; y < 1; y += 1 / cells) {
            let least = Infinity;
            for (let i = 0; i < positions.length; i += 2) {
                least = Math.min(least, wrap(x - positions[i]) ** 2 + wrap(y - positions[i + 1]) ** 2);
            }
            most = Math.max(most, least);
        }
    }
    return Math.sqrt(most);
}

// A torus of radii 1 and 0.4.
function torus(columns = 48, rows = 24) {
    const positions = [], indices = [];
    const vertex = (column, row) => (column % columns) * rows + (row % rows);
    for (let column = 0; column < columns; column++) {
        for (let row = 0; row < rows; row++) {
            const [a, b] = [(2 * Math.PI * column) / columns, (2 * Math.PI * row) / rows];
            const radius = 1 + 0.4 * Math.cos(b);
            positions.push(radius * Math.cos(a), radius * Math.sin(a), 0.4 * Math.sin(b));
            const [near, far] = [vertex(column, row), vertex(column + 1, row + 1)];
            indices.push(near, vertex(column + 1, row), far, near, far, vertex(column, row + 1));
        }
    }
    return new azulejo.Mesh(positions, indices);
}

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
    const plane = new azulejo.Plane(options);
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
        const at = [along(0, place % cells), along(1, Math.floor(place / cells) % cells), along(2, Math.floor(place / cells ** 2))];
        let least = Infinity;
        for (let i = 0; i < positions.length; i += 3) {
            const squared = at.reduce((sum, x, axis) => sum + wrap(x - positions[i + axis]) ** 2, 0);
            least = Math.min(least, squared);
        }
        most = Math.max(most, least);
    }
    return Math.sqrt(most);
}

// Whether arrays of a result have the sum of a line of tests/sums.txt.
function hasSum(name, ...arrays) {
    const sums = String(readFileSync(new URL("../../../tests/sums.txt", import.meta.url))).split("\n");
    const line = sums.find((line) => line.slice(66).startsWith(`${name} (`));
    const hash = createHash("sha256");
    for (const array of arrays) hash.update(new Uint8Array(array.buffer, array.byteOffset, array.byteLength));
    return line.startsWith(hash.digest("hex"));
}

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
