// Threads: when they come, how they end, and what is refused. That results are the same is tested by all other tests, which test.sh
// also runs on threads, and by the sums.
import assert from "node:assert/strict";
import { execFile } from "node:child_process";
import { existsSync } from "node:fs";
import { afterEach, mock, test } from "node:test";
import { promisify } from "node:util";
import * as azulejo from "../index.js";
import { torus } from "./oracles.js";

const skip = !existsSync(new URL("../azulejo-threads.wasm", import.meta.url));
const OPTIONS = { radius: 0.004, seed: 3 };

afterEach(async () => {
    mock.restoreAll();
    await azulejo.close();
});

async function sampled(options) {
    await azulejo.init(options);
    const { positions } = azulejo.kdrtSample(OPTIONS);
    await azulejo.close();
    return positions;
}

test("a set has the same bytes on any number of threads, in memory that others cannot change", { skip }, async () => {
    const expected = await sampled();
    assert.ok(expected.length > 80_000);
    for (const threads of [2, 3, 4]) {
        await azulejo.init({ threads });
        assert.equal(azulejo.threads, threads);
        const { positions } = azulejo.kdrtSample(OPTIONS);
        assert.deepEqual(positions, expected);
        assert.ok(positions.buffer instanceof ArrayBuffer);
        await azulejo.close();
        assert.equal(azulejo.threads, 1);
    }
});

test("0 threads are one for each processor", { skip }, async () => {
    await azulejo.init({ threads: 0 });
    const os = await import("node:os");
    assert.equal(azulejo.threads, Math.min(256, globalThis.navigator?.hardwareConcurrency ?? os.availableParallelism()));
});

test("a closed module is forgotten, with all that its memory held", { skip }, async () => {
    for (const threads of [1, 2]) {
        await azulejo.init({ threads });
        const mesh = torus();
        await azulejo.close();
        assert.throws(() => azulejo.kdrtSample(OPTIONS), /^Error: init: /);
        await azulejo.init({ threads });
        assert.throws(() => azulejo.pspSample(mesh, { radius: 0.2 }), /^Error: mesh: was freed/);
        mesh.free();
        assert.ok(azulejo.pspSample(torus(), { radius: 0.2 }).triangles.length > 50);
        const refusals = [];
        const progress = () => void refusals.push(azulejo.close().catch(({ message }) => message));
        azulejo.kdrtSample({ radius: 0.05, progress });
        for (const refusal of await Promise.all(refusals)) assert.match(refusal, /^close: another call runs/);
        await azulejo.close();
        await azulejo.close();
    }
});

test("the program ends while threads wait", { skip }, async () => {
    const program = `
        import { init, kdrtSample, threads } from "azulejo";
        await init({ threads: 2 });
        console.log(threads, kdrtSample({ radius: 0.02 }).positions.length > 3000);`;
    const options = { cwd: new URL("..", import.meta.url), timeout: 60_000 };
    const { stdout, stderr } = await promisify(execFile)(process.execPath, ["--input-type=module", "-e", program], options);
    assert.deepEqual([stdout, stderr], ["2 true\n", ""]);
});

test("without memory that threads can share calls run on one", async () => {
    const expected = await sampled();
    const withoutIt = async () => {
        await azulejo.init({ threads: 4 });
        assert.equal(azulejo.threads, 1);
        assert.deepEqual(azulejo.kdrtSample(OPTIONS).positions, expected);
        await azulejo.close();
    };
    const { SharedArrayBuffer } = globalThis;
    try {
        delete globalThis.SharedArrayBuffer;
        await withoutIt();
        globalThis.SharedArrayBuffer = SharedArrayBuffer;
        // As in a page that is not isolated.
        globalThis.crossOriginIsolated = false;
        await withoutIt();
    } finally {
        Object.assign(globalThis, { SharedArrayBuffer });
        delete globalThis.crossOriginIsolated;
    }
    mock.method(WebAssembly, "Memory", function () {
        throw new RangeError("could not allocate memory");
    });
    await withoutIt();
});

test("what cannot wait is refused threads, and may be loaded again", async () => {
    mock.method(Atomics, "wait", () => {
        throw new TypeError("Atomics.wait cannot be called in this context");
    });
    await assert.rejects(azulejo.init({ threads: 2 }), /^Error: threads: the main thread of a page may not wait/);
    await azulejo.init();
    assert.ok(azulejo.kdrtSample({ radius: 0.1 }).positions.length > 0);
});

test("wrong options are named", async () => {
    for (const threads of [-1, 1.5, 257, NaN, "2"]) await assert.rejects(azulejo.init({ threads }), /Error: threads: /);
    await assert.rejects(azulejo.init({ thread: 2 }), /^TypeError: thread: no such option/);
    await assert.rejects(azulejo.init("none://here"));
    await assert.rejects(azulejo.init({ threads: 2, threadedSource: new Uint8Array(8) }), WebAssembly.CompileError);
    await azulejo.init();
    assert.equal(azulejo.threads, 1);
});

test("a call ends when memory is used up in one of its threads", { skip }, async () => {
    const { Memory, instantiate } = WebAssembly;
    mock.method(WebAssembly, "Memory", function (description) {
        return new Memory({ ...description, maximum: 1024 });
    });
    let take;
    mock.method(WebAssembly, "instantiate", async (...args) => {
        const instance = await instantiate(...args);
        take = instance.exports.azulejo_take;
        return instance;
    });
    await azulejo.init({ threads: 2 });
    // Others take what is left when the threads work.
    let told = 0;
    const takeAll = () => {
        if (told++ > 0) for (let bytes = 2 ** 26; bytes >= 8;) if (take(bytes) === 0) bytes /= 2;
    };
    const call = () => azulejo.kdrtSample({ radius: 0.002, progress: takeAll });
    assert.throws(call, /^RuntimeError: a thread has ended/);
    assert.throws(call, /^RuntimeError: a thread has ended/);
    mock.restoreAll();
    await azulejo.close();
    assert.equal((await sampled({ threads: 2 })).length, (await sampled()).length);
});
