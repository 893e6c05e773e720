// Makes one HTML file of the page, the package's script and its module: node page/build.js OUT.
import { readFile, writeFile } from "node:fs/promises";

const base64 = async (path) => (await readFile(new URL(path, import.meta.url))).toString("base64");
const page = String(await readFile(new URL("page.html", import.meta.url)));
const parts = { INDEX_JS: await base64("../index.js"), AZULEJO_WASM: await base64("../azulejo.wasm") };
await writeFile(process.argv[2], page.replace(/INDEX_JS|AZULEJO_WASM/g, (name) => parts[name]));
