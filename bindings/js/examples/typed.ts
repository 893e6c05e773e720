// Checked by `tsc --noEmit`: the types of a whole program.
import { KdrtPlane, Mesh, Plane, Psp, dcrRelax, init, kdrtSample, pspClassesWithDensity, pspSample, spectrum, volumeSample, type SurfaceSamples } from "azulejo";

await init();
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
mesh.free();
const plane = new KdrtPlane({ radius: 0.01 });
const part = plane.window([0, 0], [0.5, 0.5]).positions.length;
plane.free();
const edited = new Plane({ radius: 0.01 });
edited.restore(edited.erase({ min: [0, 0], max: [0.5, 0.5] }));
edited.free();
const inBox: number = volumeSample({ count: 50, domainMax: [2, 1, 1], order: "progressive" }).coveringRadius;
// @ts-expect-error: corners of boxes have three numbers
volumeSample({ radius: 0.1, domainMin: [0, 0] });
// @ts-expect-error: there is no such boundary
kdrtSample({ radius: 0.01, boundary: "open" });
console.log(set.radius, inBox, local.length, stroke.normals, low, samples.triangles.length, part);
