// The threads of azulejo-threads.wasm: workers, each with an instance of the module on one shared memory. A worker runs
// thread.js, which enters the pool of the Rust code and stays there.

// The stack of a thread, as large as the standard library makes it elsewhere.
const STACK = 2 ** 21;

// Its first pages are those that build.sh has the module ask for.
const MEMORY = { initial: 64, maximum: 65_536, shared: true };

// A memory that threads may share, or null where there is none: pages that are not isolated, browsers without such memory.
export function sharedMemory() {
    if (typeof SharedArrayBuffer === "undefined" || globalThis.crossOriginIsolated === false) return null;
    try {
        return new WebAssembly.Memory(MEMORY);
    } catch {
        return null;
    }
}

// Whether this thread may wait for others, as the main thread of a page may not.
export function mayWait() {
    try {
        Atomics.wait(new Int32Array(new SharedArrayBuffer(4)), 0, 1);
        return true;
    } catch {
        return false;
    }
}

// The number of processors.
export async function processors() {
    if (globalThis.navigator?.hardwareConcurrency) return navigator.hardwareConcurrency;
    const os = await import("node:os");
    return os.availableParallelism?.() ?? os.cpus().length;
}

// A worker of a browser, or of Node, where workers are of another kind.
async function newWorker() {
    if (typeof Worker === "undefined") {
        const { Worker } = await import("node:worker_threads");
        return new Worker(new URL("thread.js", import.meta.url), { execArgv: [] });
    }
    return new Worker(new URL("thread.js", import.meta.url), { type: "module" });
}

// Resolves when the worker has said that its thread runs; what it says otherwise is what went wrong.
function running(worker) {
    return new Promise((resolve, reject) => {
        const fail = (reason) => reject(new Error(`threads: a worker cannot be started: ${reason}`));
        const hear = (said) => (said === null ? resolve() : fail(said));
        if (worker.on) {
            worker.on("message", hear);
            worker.on("error", (error) => fail(error.message));
        } else {
            worker.onmessage = ({ data }) => hear(data);
            worker.onerror = ({ message }) => fail(message ?? "its script was not loaded");
        }
    });
}

// Starts a pool of threads on a compiled module. `wasm`: its exports, on this thread.
export async function startPool(module, memory, threads, imports) {
    const { exports: wasm } = await WebAssembly.instantiate(module, { ...imports, env: { memory } });
    if (wasm.azulejo_pool(threads) === 0) throw new RangeError(`threads: there is no memory for ${threads}`);
    const workers = [];
    // Not 0 when one of the threads has ended, which only an error makes them do.
    const ended = new Int32Array(new SharedArrayBuffer(4));
    const close = () => Promise.all(workers.map((worker) => worker.terminate()));

    async function startThread() {
        const alignment = Math.max(16, wasm.__tls_align.value);
        const stack = wasm.azulejo_thread_memory(STACK + wasm.__tls_size.value, alignment) >>> 0;
        if (stack === 0) throw new RangeError(`threads: there is no memory for the stacks of ${threads}`);
        const worker = await newWorker();
        workers.push(worker);
        worker.postMessage({ module, memory, ended, stackEnd: stack + STACK });
        await running(worker);
        // Node does not wait for the thread when the program has come to its end.
        worker.unref?.();
    }

    try {
        await Promise.all(Array.from({ length: threads }, startThread));
    } catch (error) {
        await close();
        throw error;
    }
    return { wasm, close, hasEnded: () => Atomics.load(ended, 0) !== 0 };
}
