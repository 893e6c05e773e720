// The sums of tests/sums.txt on WebAssembly: the same bytes as on every processor.
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { test } from "node:test";

test("what calls return has the sums of the file", async () => {
    const here = (path) => readFile(new URL(path, import.meta.url));
    const { instance } = await WebAssembly.instantiate(await here("../target/sums.wasm"), {});
    const { memory, sums_text, sums_bytes } = instance.exports;
    const place = sums_text();
    const found = new TextDecoder().decode(new Uint8Array(memory.buffer, place, sums_bytes()));
    const expected = String(await here("../../../tests/sums.txt"));
    assert.deepEqual(found.split("\n"), expected.split("\n"));
});
