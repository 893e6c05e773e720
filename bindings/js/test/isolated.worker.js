// The worker of isolated.html: the same calls as in the page, on threads.
import * as azulejo from "../index.js";

export function results(azulejo) {
    const mesh = new azulejo.Mesh([0, 0, 0, 1, 0, 0, 0, 1, 0], [0, 1, 2]);
    const { positions } = azulejo.kdrtSample({ radius: 0.01, seed: 5 });
    return [positions, azulejo.dcrRelax(positions, { maxIterations: 5 }).positions, azulejo.pspSample(mesh, { radius: 0.01 }).positions];
}

if (typeof WorkerGlobalScope !== "undefined") {
    await azulejo.init({ threads: 2 });
    const { threads } = azulejo;
    const arrays = results(azulejo);
    await azulejo.close();
    postMessage([threads, arrays]);
}
