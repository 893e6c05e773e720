// A geometry of three.js, sampled by azulejo.wasm; an instance on each sample. No WebGL is needed to check it.
import assert from "node:assert/strict";
import { Mesh as Surface, init, pspSample } from "azulejo";
import * as THREE from "three";

await init();
const geometry = new THREE.TorusKnotGeometry(1, 0.35, 160, 24);
const surface = new Surface(geometry.getAttribute("position").array, geometry.getIndex().array);
const samples = pspSample(surface, { radius: 0.1, order: "progressive" });
surface.free();

const count = samples.positions.length / 3;
const instances = new THREE.InstancedMesh(new THREE.ConeGeometry(0.03, 0.1), new THREE.MeshBasicMaterial(), count);
const [place, normal, up] = [new THREE.Vector3(), new THREE.Vector3(), new THREE.Vector3(0, 1, 0)];
const [turn, size, matrix] = [new THREE.Quaternion(), new THREE.Vector3(1, 1, 1), new THREE.Matrix4()];
for (let i = 0; i < count; i++) {
    place.fromArray(samples.positions, 3 * i);
    normal.fromArray(samples.normals, 3 * i);
    instances.setMatrixAt(i, matrix.compose(place, turn.setFromUnitVectors(up, normal), size));
}
// Coarse to fine: a level of detail is a number.
instances.count = Math.floor(count / 4);

// The instances, as three.js has them: no two nearer than the radius, the first quarter no nearer than its rank.
const places = Array.from({ length: count }, (_, i) => {
    instances.getMatrixAt(i, matrix);
    return new THREE.Vector3().setFromMatrixPosition(matrix);
});
const nearest = (some) => Math.min(...some.map((a, i) => Math.min(...some.slice(0, i).map((b) => a.distanceTo(b)))));
assert(nearest(places) >= 0.1);
assert(nearest(places.slice(0, instances.count)) >= samples.ranks[instances.count - 1]);

// A ray from outside along each normal meets the surface at the sample.
const target = new THREE.Mesh(geometry, new THREE.MeshBasicMaterial());
const ray = new THREE.Raycaster();
for (let i = 0; i < count; i += 7) {
    normal.fromArray(samples.normals, 3 * i);
    ray.set(places[i].clone().addScaledVector(normal, 0.01), normal.clone().negate());
    const [hit] = ray.intersectObject(target);
    assert(hit && Math.abs(hit.distance - 0.01) < 1e-4);
}
console.log(`three.js: ${count} instances, ${nearest(places).toFixed(4)} apart; ${instances.count} of them ${nearest(places.slice(0, instances.count)).toFixed(4)}`);
