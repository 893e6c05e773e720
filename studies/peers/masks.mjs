// The masks of packages of npm, written as bytes: node masks.mjs FOLDER texture OUT writes the texture of n8ao, four channels of
// 128 × 128 in turns; node masks.mjs FOLDER SIZE OUT those that three-gpu-pathtracer makes, ranks of 32 bits, and prints the
// milliseconds of the processor. FOLDER is the one with node_modules.
import { writeFileSync } from "node:fs";
import { pathToFileURL } from "node:url";

const [folder, what, out] = process.argv.slice(2);
const load = (path) => import(pathToFileURL(`${folder}/node_modules/${path}`));

if (what === "texture") {
    const { default: bytes } = await load("n8ao/src/BlueNoise.js");
    writeFileSync(out, bytes);
} else {
    const { BlueNoiseGenerator } = await load("three-gpu-pathtracer/src/textures/blueNoise/BlueNoiseGenerator.js");
    const generator = new BlueNoiseGenerator();
    generator.size = Number(what);
    const start = process.cpuUsage();
    const { data } = generator.generate();
    const { user, system } = process.cpuUsage(start);
    writeFileSync(out, data);
    console.log((user + system) / 1000);
}
