// The programs that the playground offers: node test/code.js FOLDER INCLUDE. Programs in C and C++ compile against the headers,
// those in JavaScript run, those in Python are parsed and their calls compared with the package's types, and run where
// the package is installed. Those in Rust are written into FOLDER, for site/test.sh to check.
import assert from "node:assert/strict";
import { execFileSync, spawnSync } from "node:child_process";
import { copyFileSync, existsSync, mkdirSync, writeFileSync } from "node:fs";
import { join, resolve } from "node:path";
import { LANGUAGES, write } from "../playground/code.js";

const [folder, include] = process.argv.slice(2);
const mesh = "mesh.off";
// Settings of each call, with and without what panels leave out.
const SETTINGS = [
    {
        call: "kdrt_window", window: [[0.25, -0.5], [0.2501, -0.4999]],
        options: [["radius", 5.2e-6], ["domain_min", [-1, -1]], ["domain_max", [1, 1]], ["seed", 7]],
    },
    { call: "kdrt_sample", options: [["radius", 0.035], ["seed", 1]] },
    { call: "psp_sample", file: mesh, options: [["radius", 0.2], ["order", "progressive"], ["seed", 1]] },
    { call: "psp_sample", file: mesh, options: [["count", 100], ["order", "progressive"], ["seed", 1]] },
    { call: "psp_sample_classes", file: mesh, options: [["seed", 1]], own: [0.3, 0.24, 0.2], factor: 1 },
    {
        call: "volume_sample",
        options: [["radius", 0.2], ["domain_min", [0, 0, 0]], ["domain_max", [2, 1, 1]], ["boundary", "bounded"], ["seed", 1]],
    },
    { call: "volume_sample_inside", file: mesh, options: [["radius", 0.2], ["surface", "first"], ["seed", 1]] },
    { call: "volume_sample_inside", file: mesh, options: [["count", 50], ["seed", 1]] },
    {
        call: "dcr_relax_density", count: 500, size: [40, 30],
        options: [["domain_max", [1, 0.75]], ["boundary", "bounded"], ["max_iterations", 5], ["seed", 1]],
    },
    { call: "mask_create", levels: 3, size: [40, 30], options: [["width", 16], ["height", 16], ["seed", 1], ["sigma", 1.5]] },
];
const ENDS = { C: "c", "C++": "cpp", Python: "py", Rust: "rs", JavaScript: "mjs" };

mkdirSync(join(folder, "node_modules/azulejo"), { recursive: true });
for (const file of ["index.js", "package.json", "azulejo.wasm"]) {
    copyFileSync(new URL(`../../bindings/js/${file}`, import.meta.url), join(folder, "node_modules/azulejo", file));
}
const corners = [0, 1, 2, 3, 4, 5, 6, 7].map((k) => `${k & 1} ${(k >> 1) & 1} ${k >> 2}`);
const squares = ["0 2 3 1", "4 5 7 6", "0 1 5 4", "2 6 7 3", "0 4 6 2", "1 3 7 5"];
writeFileSync(join(folder, mesh), `OFF\n8 6 0\n${corners.join("\n")}\n${squares.map((square) => `4 ${square}`).join("\n")}\n`);

// The environment that bindings/python/test.sh has made, or the machine's own.
const made = resolve("target/python/clean/bin/python");
const python = process.env.PYTHON ?? (existsSync(made) ? made : "python3");
const hasPackage = spawnSync(python, ["-c", "import azulejo, numpy"]).status === 0;
const counts = {};
for (const [i, settings] of SETTINGS.entries()) {
    for (const language of LANGUAGES) {
        const file = `${settings.call}_${i}.${ENDS[language]}`;
        writeFileSync(join(folder, file), write(language, settings));
        const run = (...command) => execFileSync(command[0], command.slice(1), { cwd: folder, encoding: "utf8" });
        const strict = ["-Wall", "-Wextra", "-Wpedantic", "-Werror", `-I${resolve(include)}`, "-fsyntax-only", file];
        if (language === "C") run("cc", "-std=c99", ...strict);
        if (language === "C++") run("c++", "-std=c++17", ...strict);
        if (language === "JavaScript") assert.match(run("node", file), /^\d+ samples|^the first level is [012]\n/);
        if (language === "Python") {
            run("python3", resolve("site/test/calls.py"), file, resolve("bindings/python/azulejo.pyi"));
            if (hasPackage) assert.match(run(python, file), /^\d+ samples|^the first level is [012]\n/);
        }
        counts[language] = (counts[language] ?? 0) + 1;
    }
}
console.log(`programs: ${Object.entries(counts).map(([language, count]) => `${count} in ${language}`).join(", ")}`);
if (!hasPackage) console.log("SKIPPED: the playground's Python programs run (no package azulejo): parsed and compared with its types");
