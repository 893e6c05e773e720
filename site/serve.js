// A server of static files, for looking at the site and for its test: node site/serve.js FOLDER PORT.
import { createReadStream } from "node:fs";
import { stat } from "node:fs/promises";
import { createServer } from "node:http";
import { extname, join, normalize } from "node:path";
import { fileURLToPath } from "node:url";

const TYPES = {
    ".html": "text/html", ".css": "text/css", ".js": "text/javascript", ".wasm": "application/wasm", ".png": "image/png",
    ".svg": "image/svg+xml", ".woff2": "font/woff2",
};

// Pages are isolated, so that the playground has threads.
const ISOLATED = { "cross-origin-opener-policy": "same-origin", "cross-origin-embedder-policy": "require-corp" };

// Serves a folder to this machine; resolves to the server and its address.
export function serve(folder, port = 0) {
    const server = createServer(async (request, response) => {
        const path = join(folder, normalize(decodeURIComponent(new URL(request.url, "http://here").pathname)));
        const info = await stat(path).catch(() => null);
        const file = info?.isDirectory() ? join(path, "index.html") : path;
        if (!info || !(await stat(file).catch(() => null))?.isFile()) return response.writeHead(404).end();
        response.writeHead(200, { "content-type": TYPES[extname(file)] ?? "application/octet-stream", ...ISOLATED });
        createReadStream(file).pipe(response);
    });
    return new Promise((resolve) => {
        server.listen(port, "127.0.0.1", () => resolve({ server, address: `http://127.0.0.1:${server.address().port}` }));
    });
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
    const { address } = await serve(process.argv[2], Number(process.argv[3] ?? 8000));
    console.log(address);
}
