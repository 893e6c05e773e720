// What tests of the package compare it with: naive oracles, meshes, and the sums of tests/sums.txt.
import { createHash } from "node:crypto";
import { readFileSync } from "node:fs";
import * as azulejo from "../index.js";

// Loads the module, with threads where test.sh asks for them: every test must pass with any number.
export const ready = () => azulejo.init({ threads: Number(process.env.AZULEJO_THREADS ?? 1) });

// The difference of two places of the unit torus.
export const wrapped = (d) => d - Math.round(d);

// The smallest distance of all pairs; on the unit torus where `wrap` says so.
export function smallest(positions, width, wrap = (d) => d) {
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
export function covering(positions, wrap, cells = 150) {
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
export function torus(columns = 48, rows = 24) {
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

// A distance in space.
export function apart(positions, i, j) {
    let squared = 0;
    for (let axis = 0; axis < 3; axis++) squared += (positions[3 * i + axis] - positions[3 * j + axis]) ** 2;
    return Math.sqrt(squared);
}

// The closed torus of tests/sums/surface.rs: its positions, indices and normals.
export function sumsTorus(columns = 96, rows = 64) {
    const positions = [], indices = [], normals = [];
    for (let column = 0; column < columns; column++) {
        for (let row = 0; row < rows; row++) {
            const [hole, tube] = [(2 * Math.PI * column) / columns, (2 * Math.PI * row) / rows];
            const [east, north, radius] = [Math.cos(hole), Math.sin(hole), 1 + 0.4 * Math.cos(tube)];
            positions.push(radius * east, radius * north, 0.4 * Math.sin(tube));
            normals.push(Math.cos(tube) * east, Math.cos(tube) * north, Math.sin(tube));
            const vertex = (c, r) => (c % columns) * rows + (r % rows);
            const [near, far] = [vertex(column, row), vertex(column + 1, row + 1)];
            indices.push(near, vertex(column + 1, row), far, near, far, vertex(column, row + 1));
        }
    }
    return [Float32Array.from(positions), indices, Float32Array.from(normals)];
}

// The normals of vertices at samples, as the library interpolates them.
export function interpolated({ triangles, barycentrics }, indices, normals) {
    return Float32Array.from([...triangles].flatMap((triangle, i) => {
        const [u, v] = barycentrics.subarray(2 * i, 2 * i + 2);
        const weights = [1 - u - v, u, v];
        const corner = (k, axis) => weights[k] * normals[3 * indices[3 * triangle + k] + axis];
        const [x, y, z] = [0, 1, 2].map((axis) => corner(0, axis) + corner(1, axis) + corner(2, axis));
        const shorter = 1 / Math.sqrt(x * x + y * y + z * z);
        return [x * shorter, y * shorter, z * shorter];
    }));
}

// Whether arrays of a result have the sum of a line of tests/sums.txt.
export function hasSum(name, ...arrays) {
    const sums = String(readFileSync(new URL("../../../tests/sums.txt", import.meta.url))).split("\n");
    const line = sums.find((line) => line.slice(66).startsWith(`${name} (`));
    const hash = createHash("sha256");
    for (const { buffer, byteOffset, byteLength } of arrays.filter((array) => array.length > 0)) {
        hash.update(new Uint8Array(buffer, byteOffset, byteLength));
    }
    return line.startsWith(hash.digest("hex"));
}
