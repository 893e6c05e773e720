// Calls of the library in its worker.

let worker, next = 0;
const waiting = new Map();
const watchers = new Set();

function tell() {
    for (const watcher of watchers) watcher(waiting.size > 0);
}

function begin() {
    worker = new Worker(new URL("worker.js", import.meta.url), { type: "module" });
    worker.onmessage = ({ data: { id, result, error, isLost } }) => {
        const { resolve, reject } = waiting.get(id);
        waiting.delete(id);
        if (isLost) restart(`The module has ended (${error}), as it does when 32 bits of memory are used up, and was loaded anew.`);
        if (error === undefined) resolve(result);
        else reject(new Error(isLost ? "memory: used up" : error));
        tell();
    };
    worker.onerror = (event) => restart(event.message ?? "The worker could not be started.");
}

function restart(reason) {
    worker.terminate();
    const lost = [...waiting.values()];
    waiting.clear();
    begin();
    for (const { reject } of lost) reject(new Error(reason));
    tell();
}

begin();

// Calls `watcher` with whether work is going on, whenever that may have changed.
export const onWork = (watcher) => watchers.add(watcher);

// Ends what is going on.
export const stop = () => restart("Stopped.");

// A task of the worker.
export function ask(task, args) {
    return new Promise((resolve, reject) => {
        const id = next++;
        waiting.set(id, { resolve, reject });
        tell();
        worker.postMessage({ id, task, args });
    });
}

// Runs one job at a time. Of those that come meanwhile only the last is run: the others would be out of date.
export function latest(job) {
    let isRunning = false, pending = null;
    return async function request(...args) {
        if (isRunning) {
            pending = args;
            return;
        }
        isRunning = true;
        try {
            await job(...args);
        } finally {
            isRunning = false;
            if (pending) {
                const again = pending;
                pending = null;
                request(...again);
            }
        }
    };
}
