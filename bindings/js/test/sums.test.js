// The sums of tests/few_sums.txt, and in a long run of tests/sums.txt, on WebAssembly: the same bytes as on every processor, on
// any number of threads.
import assert from "node:assert/strict";
import { existsSync } from "node:fs";
import { readFile } from "node:fs/promises";
import { test } from "node:test";
import { sharedMemory, startPool } from "../pool.js";

const here = (path) => new URL(path, import.meta.url);
const compiled = async (path) => WebAssembly.compile(await readFile(here(path)));
const THREADED = "../target/sums-threads.wasm";
const skip = !existsSync(here(THREADED));

const isLong = Boolean(process.env.AZULEJO_LONG);

async function check({ memory, sums_text, sums_bytes }) {
    const few = Number(!isLong);
    const place = sums_text(few);
    const found = new TextDecoder().decode(new Uint8Array(memory.buffer, place, sums_bytes(few)).slice());
    const expected = String(await readFile(here(`../../../tests/${isLong ? "" : "few_"}sums.txt`)));
    assert.deepEqual(found.split("\n"), expected.split("\n"));
}

test("what calls return has the sums of the file", async () => {
    await check((await WebAssembly.instantiate(await compiled("../target/sums.wasm"))).exports);
});

// Also on more threads than processors, in a long run.
for (const threads of isLong ? [2, 4] : []) {
    test(`what calls return on ${threads} threads has the sums of the file`, { skip }, async () => {
        const pool = await startPool(await compiled(THREADED), sharedMemory(), threads, {});
        try {
            await check(pool.wasm);
        } finally {
            await pool.close();
        }
    });
}
