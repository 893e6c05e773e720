// Reads GLB files of samples by Khronos' validator, and compares instances with the same samples as CSV.
//
// node gltf.mjs FOLDER: volume.glb and classes.glb beside volume.csv and classes.csv.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join, resolve } from "node:path";

const folder = process.argv[2];
// The packages are installed there.
const { validateBytes, version } = createRequire(resolve(folder, "gltf.mjs"))("gltf-validator");

// What is no error: the validator does not know the extension, and so not what its numbers are for.
const EXPECTED = new Set(["UNSUPPORTED_EXTENSION", "UNUSED_OBJECT"]);

async function complaints(bytes) {
    let report;
    try {
        report = await validateBytes(new Uint8Array(bytes), { maxIssues: 0 });
    } catch (error) {
        return [String(error)];
    }
    return report.issues.messages.filter(({ code }) => !EXPECTED.has(code)).map(({ code, pointer }) => `${code} ${pointer}`);
}

// The parts of a file: its JSON, and its numbers by accessor.
function parts(bytes) {
    const length = bytes.readUInt32LE(12);
    const json = JSON.parse(bytes.toString("utf8", 20, 20 + length));
    const binary = bytes.subarray(28 + length);
    const numbers = (accessor) => {
        const { bufferView, byteOffset = 0, count, type, componentType } = json.accessors[accessor];
        assert.equal(componentType, 5126);
        const start = (json.bufferViews[bufferView].byteOffset ?? 0) + byteOffset;
        const width = { SCALAR: 1, VEC3: 3, VEC4: 4 }[type];
        return Array.from({ length: count }, (_, row) =>
            Array.from({ length: width }, (_, column) => binary.readFloatLE(start + 4 * (width * row + column))));
    };
    return { json, numbers };
}

// Positions of the CSV file by class; one class if it has none.
function classes(name) {
    const [header, ...rows] = readFileSync(join(folder, name), "utf8").trim().split("\n").map((line) => line.split(","));
    const found = [];
    for (const row of rows) {
        const of = header.includes("class") ? Number(row[header.indexOf("class")]) : 0;
        (found[of] ??= []).push(["x", "y", "z"].map((axis) => Math.fround(Number(row[header.indexOf(axis)]))));
    }
    return found;
}

async function check(name) {
    const bytes = readFileSync(join(folder, `${name}.glb`));
    assert.deepEqual(await complaints(bytes), []);
    const { json, numbers } = parts(bytes);
    const expected = classes(`${name}.csv`);
    const instanced = json.nodes.filter((node) => node.extensions?.EXT_mesh_gpu_instancing);
    assert.equal(instanced.length, expected.length);
    instanced.forEach((node, of) => {
        const { TRANSLATION, ...others } = node.extensions.EXT_mesh_gpu_instancing.attributes;
        const origin = node.translation ?? [0, 0, 0];
        const at = numbers(TRANSLATION).map((position) => position.map((x, axis) => Math.fround(x + origin[axis])));
        assert.deepEqual(at, expected[of]);
        for (const accessor of Object.values(others)) assert.equal(json.accessors[accessor].count, at.length);
        if (others.ROTATION !== undefined) {
            for (const rotation of numbers(others.ROTATION)) assert(Math.abs(Math.hypot(...rotation) - 1) < 1e-6);
        }
    });
    return expected.map((samples) => samples.length).join(" + ");
}

// A file that is cut, one whose mesh has an index too many, one whose numbers are of a kind that there is not.
async function checkThatDamageIsFound() {
    const bytes = readFileSync(join(folder, "volume.glb"));
    const changed = (from, to) => {
        const at = bytes.indexOf(from);
        assert(at > 0 && from.length === to.length, from);
        const damaged = Buffer.from(bytes);
        damaged.write(to, at, "utf8");
        return damaged;
    };
    const half = bytes.subarray(0, bytes.length / 2);
    for (const damaged of [half, changed('"count":24', '"count":25'), changed("5123", "5199")]) {
        assert.notDeepEqual(await complaints(damaged), []);
    }
}

console.log(`gltf-validator ${version()}: ${await check("volume")} and ${await check("classes")} instances`);
await checkThatDamageIsFound();
