// Samples the mesh of a file and writes the positions as floats, on two threads: dragon.mjs MESH RADIUS SEED OUT
import { readFileSync, writeFileSync } from "node:fs";
import { Mesh, init, pspSample, threads } from "azulejo";

const [path, radius, seed, out] = process.argv.slice(2);
await init({ threads: 2 });
if (threads !== 2) throw new Error("the package has no threads");
const { positions } = pspSample(Mesh.parse(path, readFileSync(path)), { radius: Number(radius), seed: Number(seed) });
writeFileSync(out, positions);
