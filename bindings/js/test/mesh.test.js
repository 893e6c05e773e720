// Meshes with normals and masks, moved, remeshed, and what is inside them.
import assert from "node:assert/strict";
import { before, test } from "node:test";
import * as azulejo from "../index.js";
import { apart, hasSum, interpolated, ready, smallest, sumsTorus, torus } from "./oracles.js";

before(ready);

// The triangles of a mesh as three corners of three numbers each.
function cornersOf(mesh) {
    const { positions, indices } = mesh.arrays();
    const corner = (vertex) => [...positions.subarray(3 * vertex, 3 * vertex + 3)];
    return Array.from({ length: indices.length / 3 }, (_, t) => [0, 1, 2].map((k) => corner(indices[3 * t + k])));
}

const minus = (a, b) => a.map((x, axis) => x - b[axis]);
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const length = (a) => Math.sqrt(dot(a, a));

// The unit cube, wound outwards.
const CUBE = [0, 1, 2, 3, 4, 5, 6, 7].flatMap((k) => [k & 1, (k >> 1) & 1, k >> 2]);
const SQUARES = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
const OF_CUBE = SQUARES.flatMap(([a, b, c, d]) => [a, b, c, a, c, d]);

// A square of 8 by 8 quads: triangles 0 to 63 are its lower half.
function square() {
    const positions = [], indices = [];
    for (let i = 0; i < 81; i++) positions.push((i % 9) / 8, Math.floor(i / 9) / 8, 0);
    for (let i = 0; i < 72; i++) if (i % 9 < 8) indices.push(i, i + 1, i + 10, i, i + 10, i + 9);
    return new azulejo.Mesh(positions, indices);
}

// Points of a box, spread by a lattice of rank 1.
function spread(count, low, high) {
    return Float32Array.from({ length: 3 * count }, (_, i) => {
        const share = ((Math.floor(i / 3) + 0.5) * [0.8191725133961645, 0.6710436067037893, 0.5497004779019703][i % 3]) % 1;
        return low + (high - low) * share;
    });
}

// The parts of all samples, the interpolated normals where the sums have them.
const parts = (set) => [set.positions, set.normals, set.interpolatedNormals, set.triangles, set.barycentrics];

test("samples have the normals of their mesh, by vertex and by corner", () => {
    const [positions, indices, normals] = sumsTorus(24, 16);
    const bare = new azulejo.Mesh(positions, indices);
    const mesh = new azulejo.Mesh(positions, indices, { normals });
    const options = { radius: 0.15, seed: 5 };
    const plain = azulejo.pspSample(bare, options);
    const { interpolatedNormals, ...rest } = azulejo.pspSample(mesh, options);
    assert.equal(plain.interpolatedNormals, undefined);
    assert.deepEqual(rest, plain);
    assert.deepEqual(interpolatedNormals, interpolated(plain, indices, normals));
    assert.deepEqual(azulejo.pspSample(bare.withNormals(normals), options).interpolatedNormals, interpolatedNormals);
    // The same normals in reverse, by the corners.
    const reversed = Float32Array.from({ length: normals.length }, (_, i) => normals[normals.length - 3 - i + 2 * (i % 3)]);
    const normalIndices = indices.map((vertex) => normals.length / 3 - 1 - vertex);
    const byCorner = mesh.withNormals(reversed, normalIndices);
    assert.deepEqual(azulejo.pspSample(byCorner, options).interpolatedNormals, interpolatedNormals);
    const arrays = byCorner.arrays();
    assert.deepEqual([arrays.normals, arrays.normalIndices, arrays.mask], [reversed, Uint32Array.from(normalIndices), undefined]);
    assert.deepEqual(Object.keys(bare.arrays()), ["positions", "indices", "origin"]);
    const grown = new azulejo.Psp(mesh, options);
    grown.fill();
    const set = grown.points();
    assert.deepEqual(set.interpolatedNormals, interpolated(set, indices, normals));
    const throws = (body, name) => assert.throws(body, (error) => error.message.startsWith(`${name}: `));
    throws(() => new azulejo.Mesh(positions, indices, { normalIndices }), "normalIndices");
    throws(() => mesh.withNormals(normals.subarray(3)), "normals");
    throws(() => mesh.withNormals(normals, [0, 1]), "normalIndices");
    throws(() => mesh.withNormals(normals, indices.map(() => 1e6)), "normalIndices");
    throws(() => new azulejo.Mesh(positions, indices, { colours: normals }), "colours");
});

test("masks leave triangles out", () => {
    const whole = square();
    const mask = Array.from({ length: 128 }, (_, t) => t < 64);
    const mesh = whole.withMask(mask);
    assert.ok(Math.abs(mesh.area - 0.5) < 1e-12 && Math.abs(whole.area - 1) < 1e-12);
    const { positions, triangles } = azulejo.pspSample(mesh, { radius: 0.05, seed: 1 });
    assert.ok(triangles.length > 100 && triangles.every((triangle) => triangle < 64));
    assert.ok(smallest(positions, 3) >= 0.05);
    for (let place = 0; place < 5000; place++) {
        const [x, y] = [((place % 100) + 0.5) / 100, (Math.floor(place / 100) + 0.5) / 100];
        const distance = (_, i) => Math.hypot(positions[3 * i] - x, positions[3 * i + 1] - y);
        assert.ok(Math.min(...Array.from(triangles, distance)) <= 0.05 + 1e-6);
    }
    assert.equal(azulejo.meshCoverage(mesh, positions, 0.05).gaps, 0);
    assert.ok(azulejo.meshCoverage(whole, positions, 0.05).gaps >= 1);
    assert.deepEqual(mesh.arrays().mask, Uint8Array.from(mask, Number));
    const all = azulejo.pspSample(mesh.withMask(mask.map(() => 1)), { radius: 0.1 });
    assert.deepEqual(all, azulejo.pspSample(whole, { radius: 0.1 }));
    assert.throws(() => whole.withMask([true]), /^Error: mask: /);
    assert.throws(() => whole.withMask(), /^TypeError: mask: /);
    assert.throws(() => whole.withNormals(null), /^TypeError: normals: /);
});

test("sets with normals, masks, projectors and priorities have the bytes of the Rust calls", () => {
    const [positions, indices, normals] = sumsTorus(40, 24);
    const mask = Array.from({ length: indices.length / 3 }, (_, i) => i % 7 !== 0);
    // The open torus lacks the quads of the first row.
    const isOpen = (t) => Math.floor(t / 2) % 24 !== 0;
    const open = new azulejo.Mesh(positions, indices.filter((_, i) => isOpen(Math.floor(i / 3))), { normals });
    const masked = open.withMask(mask.slice(0, open.arrays().indices.length / 3));
    const options = { projectors: "global", iterations: 1 };
    assert.ok(hasSum("masked", ...parts(azulejo.pspSample(masked, { ...options, radius: 0.03, seed: 33 }))));
    const thrice = { radius: 0.02, seed: 29, iterations: 3, priority: "projector" };
    const set = azulejo.pspSample(open, thrice);
    assert.ok(hasSum("local 3, projector", ...parts(set)));
    assert.equal(set.iterations, 3);
    for (const others of [{ priority: "squareness" }, { projectors: "global" }]) {
        const other = azulejo.pspSample(open, { ...thrice, ...others });
        assert.ok(!hasSum("local 3, projector", ...parts(other)) && smallest(other.positions.subarray(0, 6000), 3) >= 0.02);
    }
    assert.throws(() => azulejo.pspSample(open, { radius: 0.1, projectors: "none" }), /^TypeError: projectors: /);
});

test("reports of sets on meshes", () => {
    const mesh = torus();
    const { radius, rho, triangles, darts, iterations, uncoveredBefore, uncoveredAfter } =
        azulejo.pspSample(mesh, { radius: 0.15, iterations: 1 });
    const hexagonal = Math.sqrt((2 * mesh.area) / (Math.sqrt(3) * triangles.length));
    assert.ok(Math.abs(rho - radius / hexagonal) < 1e-12 && iterations === 1 && darts > 0);
    assert.ok(uncoveredBefore > 0 && uncoveredBefore < 0.5 && uncoveredAfter >= 0 && uncoveredAfter < 1e-4);
    const some = azulejo.pspSample(mesh, { radius: 0.15, iterations: 2, maximal: false });
    assert.deepEqual([some.iterations, some.darts, some.uncoveredBefore], [2, 0, undefined]);
    const classes = azulejo.pspSampleClasses(mesh, { seed: 1 }, [0.25, 0.15, 0.15, 0.2]);
    const adaptive = azulejo.pspAdaptiveSample(mesh, { seed: 1 }, new Float32Array(mesh.vertexCount).fill(0.2));
    for (const set of [classes, adaptive]) assert.ok(set.rho === 0 && set.darts >= set.triangles.length);
    assert.deepEqual([classes.radius, adaptive.radius], [0.2, 0]);
    const ordered = azulejo.pspAdaptiveSample(mesh, { order: "progressive" }, new Float32Array(mesh.vertexCount).fill(0.2));
    assert.equal(ordered.radius, 1);
    const global = new azulejo.Psp(mesh, { radius: 0.15, projectors: "global", priority: "projector" });
    global.advance(1);
    const same = { radius: 0.15, iterations: 1, maximal: false, projectors: "global", priority: "projector" };
    assert.deepEqual(global.points().positions, azulejo.pspSample(mesh, same).positions);
});

test("samples go with a mesh that is deformed", () => {
    const mesh = torus(24, 16);
    const set = azulejo.pspSample(mesh, { radius: 0.2 });
    const again = mesh.points(set);
    for (const name of ["positions", "normals", "triangles", "barycentrics"]) assert.deepEqual(again[name], set[name]);
    const moved = mesh.deform(mesh.arrays().positions.map((x, i) => [2 * x, 2 * x + 1, 2 * x][i % 3]));
    assert.ok(Math.abs(moved.area / mesh.area - 4) < 1e-6);
    const corners = cornersOf(moved);
    const { positions } = moved.points(set);
    set.triangles.forEach((triangle, i) => {
        const [u, v] = set.barycentrics.subarray(2 * i, 2 * i + 2);
        const [a, b, c] = corners[triangle];
        const place = a.map((x, axis) => (1 - u - v) * x + u * b[axis] + v * c[axis]);
        assert.ok(length(minus(place, [...positions.subarray(3 * i, 3 * i + 3)])) < 1e-6);
    });
    assert.throws(() => mesh.deform([0, 0, 0]), /^Error: positions: /);
    assert.throws(() => mesh.points({ triangles: [0, 1], barycentrics: [0, 0] }), /^Error: barycentrics: /);
    assert.throws(() => mesh.points({ triangles: [1e6], barycentrics: [0, 0] }), /^Error: triangles: /);
});

// Whether a ray in a direction that meets no edge crosses an odd number of triangles.
function isInside(corners, place) {
    const along = [0.9128709, 0.3651484, 0.1825742];
    return corners.filter(([a, b, c]) => {
        const [ab, ac, from] = [minus(b, a), minus(c, a), minus(place, a)];
        const side = cross(along, ac);
        const scale = dot(ab, side);
        const u = dot(from, side) / scale;
        const v = dot(along, cross(from, ab)) / scale;
        return u >= 0 && v >= 0 && u + v <= 1 && dot(ac, cross(from, ab)) / scale > 0;
    }).length % 2 === 1;
}

// The winding number by the solid angles of Van Oosterom and Strackee (1983).
function winding(corners, place) {
    return corners.reduce((sum, of) => {
        const [a, b, c] = of.map((corner) => minus(corner, place));
        const [la, lb, lc] = [a, b, c].map(length);
        const below = la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb;
        return sum + Math.atan2(dot(a, cross(b, c)), below) / (2 * Math.PI);
    }, 0);
}

test("what is inside a mesh", () => {
    const mesh = torus(24, 16);
    assert.equal(mesh.isClosed(), true);
    const places = spread(2000, -1.5, 1.5);
    const corners = cornersOf(mesh);
    const inside = mesh.contains(places);
    assert.deepEqual(inside, Uint8Array.from(inside, (_, i) => Number(isInside(corners, [...places.subarray(3 * i, 3 * i + 3)]))));
    const share = inside.reduce((sum, one) => sum + one, 0) / 2000;
    assert.ok(Math.abs(share - (2 * Math.PI ** 2 * 0.16) / 27) < 0.02, `${share}`);
    const open = new azulejo.Mesh(CUBE, OF_CUBE.slice(3));
    assert.equal(open.isClosed(), false);
    const near = spread(2000, -0.2, 1.2);
    const around = cornersOf(open);
    let certain = 0;
    open.contains(near).forEach((one, i) => {
        const place = [...near.subarray(3 * i, 3 * i + 3)];
        const number = Math.abs(winding(around, place));
        if (Math.abs(number - 0.5) < 0.02 || place.some((x) => x < 0 || x > 1)) return;
        certain++;
        assert.equal(one, Number(number > 0.5), `${place}`);
    });
    assert.ok(certain > 500);
    assert.throws(() => mesh.contains([0, 0, NaN]), /^Error: positions: /);
});

test("samples are relaxed to a density", () => {
    const mesh = torus();
    const { positions, indices } = mesh.arrays();
    const values = Float32Array.from({ length: positions.length / 3 }, (_, vertex) => Number(positions[3 * vertex] > 0));
    const samples = azulejo.pspSample(mesh, { radius: 0.1 });
    const relaxed = azulejo.dcrSurfaceRelax(mesh, samples, { density: { values } });
    assert.ok(relaxed.positions.length === samples.positions.length && relaxed.rho > 0);
    const even = azulejo.dcrSurfaceRelax(mesh, samples, { density: { values: values.map(() => 1) } });
    assert.ok(even.rho > 0.8);
    // Triangles of which no vertex has a density have no samples.
    const isWanted = (triangle) => [0, 1, 2].some((corner) => values[indices[3 * triangle + corner]] > 0);
    assert.ok(relaxed.triangles.every(isWanted));
    assert.throws(() => azulejo.dcrSurfaceRelax(mesh, samples, { density: { values, radius: 1 } }), /^TypeError: radius: /);
    assert.throws(() => azulejo.dcrSurfaceRelax(mesh, samples, { density: { values: [1] } }), /^Error: density: /);
});

test("samples of a closed mesh become a closed mesh", () => {
    const mesh = torus();
    const relaxed = azulejo.dcrSurfaceRelax(mesh, azulejo.pspSample(mesh, { radius: 0.12 }));
    const { mesh: made, ...report } = azulejo.dcrRemesh(mesh, relaxed);
    const { positions, indices } = made.arrays();
    assert.deepEqual(positions, relaxed.positions);
    const [sides, angles] = [new Map(), []];
    for (const [t, corners] of cornersOf(made).entries()) {
        const of = [0, 1, 2].map((k) => {
            const [a, b] = [indices[3 * t + k], indices[3 * t + ((k + 1) % 3)]];
            const side = `${Math.min(a, b)} ${Math.max(a, b)}`;
            // Triangles at an edge are wound alike: they run along it in both directions.
            sides.set(side, [...(sides.get(side) ?? []), a < b]);
            const [to, from] = [minus(corners[(k + 1) % 3], corners[k]), minus(corners[(k + 2) % 3], corners[k])];
            return (Math.acos(dot(to, from) / (length(to) * length(from))) * 180) / Math.PI;
        });
        angles.push(of);
    }
    assert.ok([...sides.values()].every((runs) => runs.length === 2 && runs[0] !== runs[1]));
    assert.deepEqual([made.vertexCount, made.triangleCount], [positions.length / 3, angles.length]);
    assert.deepEqual([report.triangles, report.innerEdges, report.boundaryEdges], [angles.length, sides.size, 0]);
    assert.equal(report.euler, positions.length / 3 - sides.size + angles.length);
    assert.deepEqual([report.euler, report.nonManifoldEdges, report.nonManifoldVertices, report.unusedVertices], [0, 0, 0, 0]);
    const least = angles.map((of) => Math.min(...of));
    const near = (found, wanted) => assert.ok(Math.abs(found - wanted) < 1e-3, `${found} ${wanted}`);
    near(report.smallestAngle, Math.min(...least));
    near(report.largestAngle, Math.max(...angles.flat()));
    near(report.meanSmallestAngle, least.reduce((sum, angle) => sum + angle, 0) / least.length);
    assert.ok(Math.abs(made.area / mesh.area - 1) < 0.02 && made.isClosed());
    made.free();
    assert.throws(() => azulejo.dcrRemesh(mesh, { triangles: [0], barycentrics: [0, 0] }), Error);
});

test("differences of samples on meshes", () => {
    const mesh = torus();
    const sets = [1, 2].map((seed) => azulejo.pspSample(mesh, { radius: 0.08, seed }));
    const [one, other] = sets.map((set) => new azulejo.Differences(mesh, set, { seed: 3 }));
    const radial = one.radial();
    assert.deepEqual([radial.length, one.density().length], [512, 128 * 128]);
    // No two samples are nearer than the radius; far from each other they are as frequent as random ones.
    const spacing = Math.sqrt(mesh.area / sets[0].triangles.length);
    const nearest = smallest(sets[0].positions, 3) / spacing;
    for (let shell = 0; (shell + 1) / 64 < 0.9 * nearest; shell++) assert.equal(radial[shell], 0);
    const far = radial.subarray(300);
    assert.ok(Math.abs(far.reduce((sum, density) => sum + density, 0) / far.length - 1) < 0.05);
    const [low, high] = one.power([0.3, 6]);
    assert.ok(low < 0.2 && Math.abs(high - 1) < 0.3, `${low} ${high}`);
    // Together each shell has a density between both, for they have about as many samples.
    const mean = azulejo.Differences.mean([one, other]);
    const [a, b, both] = [one, other, mean].map((of) => of.radial());
    assert.ok(both.every((density, i) => density >= Math.min(a[i], b[i]) - 0.02 && density <= Math.max(a[i], b[i]) + 0.02));
    assert.deepEqual(azulejo.Differences.mean([one]).density(), one.density());
    const turned = new azulejo.Differences(mesh, sets[0], { direction: [0, 0, 1], seed: 3 });
    assert.notDeepEqual(turned.density(), one.density());
    const throws = (body, name) => assert.throws(body, (error) => error.message.startsWith(`${name}: `));
    throws(() => new azulejo.Differences(mesh, { ...sets[0], normals: [0, 0, 1] }), "normals");
    throws(() => new azulejo.Differences(mesh, sets[0], { direction: [0, 0, 0] }), "direction");
    throws(() => one.power([33]), "frequencies");
    throws(() => azulejo.Differences.mean([]), "differences");
    throws(() => azulejo.Differences.mean([mesh]), "differences");
    for (const differences of [one, other, mean, turned]) differences.free();
    throws(() => one.radial(), "differences");
});
