// A thread of azulejo-threads.wasm, in a worker that pool.js has started.

const port = typeof WorkerGlobalScope === "undefined" ? (await import("node:worker_threads")).parentPort : globalThis;

// Callbacks are called on the thread that made the call, never on this one.
const CALLBACKS = { progress: () => 1, visit: () => 1 };

port.onmessage = async ({ data: { module, memory, ended, stackEnd } }) => {
    try {
        const { exports } = await WebAssembly.instantiate(module, { azulejo: CALLBACKS, env: { memory } });
        // The stack grows downwards; above it lies what is local to the thread.
        exports.__stack_pointer.value = stackEnd;
        exports.__wasm_init_tls(stackEnd);
        port.postMessage(null);
        exports.azulejo_thread_run();
    } catch (error) {
        // Before the thread runs pool.js hears this; later the call that runs looks at the mark.
        port.postMessage(String(error));
    }
    Atomics.store(ended, 0, 1);
};
