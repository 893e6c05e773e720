// Checked by `tsc --noEmit`: the types of a whole program.
import {
    Cancelled, Differences, KdrtPlane, Mesh, Plane, Psp, Spectrum, close, dcrRelax, dcrRemesh, init, kdrtSample, kdrtStream,
    planeMeasure, pspClassesWithDensity, pspSample, spectrum, threads, volumeSample, type SurfaceSamples,
} from "azulejo";

await init(new URL("azulejo.wasm", import.meta.url));
await close();
await init({ threads: 4 });
const many: number = threads;
const set = kdrtSample({ radius: 0.01, boundary: "bounded", seed: 7n });
const relaxed: Float32Array = dcrRelax(set.positions, { boundary: "bounded" }).positions;
const low: number = spectrum(relaxed, { size: 128 }).annuli[1].power;
const mesh = new Mesh([0, 0, 0, 1, 0, 0, 0, 1, 0], [0, 1, 2]);
const samples: SurfaceSamples = pspSample(mesh, { count: 100, order: "progressive" });
const values = new Float32Array([1, 1, 4]);
const local: Float64Array = pspClassesWithDensity(mesh, { masks: [3] }, [1, 1, 1, 1], { values, radius: 0.1 }).radii;
const brushed = new Psp(mesh, { radius: 0.05 });
brushed.fill();
const stroke: SurfaceSamples = brushed.erase({ centre: [0, 0, 0], radius: 0.2 });
brushed.free();
const flat = mesh.withNormals([0, 0, 1, 0, 0, 1, 0, 0, 1]).withMask([true]);
const normals: Float32Array | undefined = pspSample(flat, { radius: 0.1, projectors: "global" }).interpolatedNormals;
const angle: number = dcrRemesh(flat, samples, { progress: (done) => done < 1 }).smallestAngle;
const decay: Float64Array = new Differences(flat, samples, { direction: [0, 1, 0] }).power([0.5]);
flat.free();
mesh.free();
const plane = new KdrtPlane({ radius: 0.01 });
const part = plane.window([0, 0], [0.5, 0.5]).positions.length;
plane.free();
const edited = new Plane({ radius: 0.01 });
edited.restore(edited.erase({ min: [0, 0], max: [0.5, 0.5] }));
edited.free();
const inBox: number = volumeSample({ count: 50, domainMax: [2, 1, 1], order: "progressive" }).coveringRadius;
const nyquist: number | undefined = Spectrum.mean([new Spectrum(relaxed, 64)]).measure(0, 1, 0.05).effectiveNyquist;
const order: number = planeMeasure(dcrRelax(relaxed, { method: "thesis", visits: "one_end", step: 0.1 }).positions).bondOrder;
let streamed = 0;
try {
    kdrtStream((part) => (streamed += part.length) < 1e6, { radius: 0.001 });
} catch (error) {
    if (!(error instanceof Cancelled)) throw error;
}
// @ts-expect-error: corners of boxes have three numbers
volumeSample({ radius: 0.1, domainMin: [0, 0] });
// @ts-expect-error: there is no such boundary
kdrtSample({ radius: 0.01, boundary: "open" });
// @ts-expect-error: progress is a function
kdrtSample({ radius: 0.01, progress: true });
console.log(normals, angle, decay, nyquist, order, streamed);
console.log(set.radius, inBox, local.length, stroke.normals, low, samples.triangles.length, part);
