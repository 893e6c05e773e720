// Samples of a mesh, with the count of their conflicts and gaps.
import { ask, latest } from "./library.js";
import { Panel, colours, element, milliseconds, navigable, onScheme, rgb, short, takesFiles, whole } from "./controls.js";
import { SHAPES } from "./shapes.js";
import { Renderer } from "./webgl.js";

const QUOTIENT = 2 ** (1 / 8);
// Own radii of the classes, relative to the radius.
const OWN = [1, 0.8, 0.65, 0.5];

let files = 0;

// A mesh of the page: the key by which the worker keeps it, and what it is made of.
export function builtIn(name) {
    return { id: name, ...SHAPES[name]() };
}

export async function fromFile(file) {
    return { id: `file ${++files}`, name: file.name, bytes: await file.arrayBuffer() };
}

// The file that programs read a mesh from; a built-in one has to be saved before.
export const fileOf = (mesh) => mesh.name ?? `${mesh.id}.obj`;

// Saves a mesh as an OBJ file, with the very floats that it has here.
export async function saveMesh(mesh) {
    const { positions, indices } = await ask("mesh", { mesh });
    const lines = [];
    for (let i = 0; i < positions.length; i += 3) lines.push(`v ${positions[i]} ${positions[i + 1]} ${positions[i + 2]}`);
    for (let i = 0; i < indices.length; i += 3) lines.push(`f ${indices[i] + 1} ${indices[i + 1] + 1} ${indices[i + 2] + 1}`);
    const link = document.createElement("a");
    link.href = URL.createObjectURL(new Blob([lines.join("\n"), "\n"], { type: "text/plain" }));
    link.download = fileOf(mesh).replace(/\.\w+$/, ".obj");
    link.click();
    URL.revokeObjectURL(link.href);
}

// Fields that have no meaning are not shown.
export function showByAmount(form, hasClasses = false) {
    const isCount = form.elements.by.value === "count" && !hasClasses;
    form.elements.radius.closest("label").hidden = isCount;
    form.elements.count.closest("label").hidden = !isCount;
    form.elements.by.disabled = hasClasses;
}

export function begin() {
    let mesh = builtIn("knot");
    let set = null;
    let renderer = null;

    const panel = new Panel("mesh", () => sample(), () => {
        const { by, radius, count, seed, classes } = panel.values;
        const file = fileOf(mesh);
        if (classes > 1) {
            return { call: "psp_sample_classes", file, options: [["seed", seed]], own: own(), factor: 1 };
        }
        const amount = by === "count" ? ["count", count] : ["radius", radius];
        return { call: "psp_sample", file, options: [amount, ["order", "progressive"], ["seed", seed]] };
    });
    const { canvas, form } = panel;
    const own = () => OWN.slice(0, Number(panel.values.classes)).map((x) => Number((x * panel.values.radius).toPrecision(6)));
    try {
        renderer = new Renderer(canvas);
    } catch (error) {
        canvas.replaceWith(Object.assign(document.createElement("p"), { textContent: error.message, className: "message" }));
    }

    const load = latest(async (wanted) => {
        await panel.trying(async () => {
            const { positions, indices, area } = await ask("mesh", { mesh: wanted });
            mesh = wanted;
            mesh.triangles = indices.length / 3;
            mesh.area = area;
            set = null;
            if (wanted.bytes) {
                // About 3,000 samples of a mesh that nothing is known about.
                form.elements.radius.value = Math.sqrt((0.697 * area) / 3000).toPrecision(3);
                form.elements.shape.querySelector("[value=file]").hidden = false;
                form.elements.shape.value = "file";
            }
            renderer?.setMesh(positions, indices);
            draw();
            sample();
        });
    });

    const sample = latest(async () => {
        await panel.trying(async () => {
            const { by, radius, count, seed, classes } = panel.values;
            const hasClasses = classes > 1;
            showByAmount(form, hasClasses);
            const amount = by === "count" ? { count } : { radius };
            const made = hasClasses
                ? await ask("surface", { mesh, options: { seed }, own: own(), factor: 1 })
                : await ask("surface", { mesh, options: { ...amount, seed, order: "progressive" } });
            set = { ...made, hasClasses };
            const smallest = hasClasses ? own().at(-1) : made.radius;
            renderer?.setDisks(made.positions, made.normals, made.classes, 0.42 * smallest);
            form.elements.prefix.closest("label").hidden = hasClasses;
            form.elements.prefix.value = 1000;
            draw();
            await certify();
            panel.showCode();
        });
    });

    // The number of samples of the prefix in view; on a logarithmic scale.
    function prefix() {
        const all = set.positions.length / 3;
        if (set.hasClasses) return all;
        return Math.max(1, Math.round(all ** (form.elements.prefix.value / 1000)));
    }

    const certify = latest(async () => {
        if (!set) return;
        const { positions, classes, radii, ranks, hasClasses } = set;
        const all = positions.length / 3, count = prefix();
        const rows = [
            ["triangles", whole(mesh.triangles)],
            ["samples", whole(all)],
            ["time of the sampling", milliseconds(set.milliseconds)],
        ];
        if (hasClasses) {
            const found = await ask("classCertificate", { mesh, positions, classes, radii, count: Math.sqrt(radii.length) });
            found.sizes.forEach((size, k) => rows.push([`class ${k + 1}, radius ${short(radii[k * (found.sizes.length + 1)])}`, whole(size)]));
            rows.push(["conflicts, all pairs of classes", whole(found.conflicts), found.conflicts === 0]);
            rows.push(["gaps of class 1", whole(found.gaps), found.gaps === 0]);
            rows.push(["time of the analysis", milliseconds(found.milliseconds)]);
        } else {
            const rank = count < all ? ranks[count - 1] : set.radius;
            // A prefix of less than 100 samples covers within twice its rank.
            const bound = count < all ? (count < 100 ? 2 : QUOTIENT) * rank : set.coveringRadius ?? set.radius;
            const shown = positions.slice(0, 3 * count);
            const found = await ask("certificate", { mesh, positions: shown, radius: rank, cover: bound });
            rows.push([count < all ? "samples of the prefix" : "the whole set", whole(count)]);
            rows.push([count < all ? "rank of its last sample" : "radius", short(rank)]);
            rows.push(["smallest distance", short(found.smallest)]);
            rows.push(["farthest place", short(found.coveringRadius)]);
            rows.push(["conflicts", whole(found.conflicts), found.conflicts === 0]);
            rows.push([`gaps at ${short(bound)}`, whole(found.gaps), found.gaps === 0]);
            rows.push(["time of the analysis", milliseconds(found.milliseconds)]);
        }
        panel.figures(rows);
    });

    function draw() {
        if (set) {
            const [count, all] = [prefix(), set.positions.length / 3];
            element("mesh-prefix-says").textContent = count === all ? "all" : whole(count);
            if (renderer) renderer.shown = count;
        }
        if (!renderer || canvas.clientWidth === 0) return;
        const colour = colours();
        renderer.draw({
            ground: rgb(colour("paper")), mesh: rgb(colour("mesh")),
            classes: ["dot", "class-2", "class-3", "class-4"].map((name) => rgb(colour(name))),
        });
    }

    form.querySelector(".save").addEventListener("click", () => panel.trying(() => saveMesh(mesh)));
    form.elements.prefix.addEventListener("input", () => {
        draw();
        certify();
    });
    form.elements.shape.addEventListener("change", (event) => {
        event.stopPropagation();
        if (event.target.value !== "file") {
            form.elements.radius.value = { knot: 0.08, torus: 0.08, cube: 0.04 }[event.target.value];
            load(builtIn(event.target.value));
        }
    });
    takesFiles(panel.root.querySelector(".stage"), form.querySelector("[type=file]"), async (file) => load(await fromFile(file)));
    navigable(canvas, (dx, dy) => {
        if (!renderer) return;
        renderer.turn[0] += 0.008 * dx;
        renderer.turn[1] += 0.008 * dy;
        draw();
    }, (factor) => {
        if (!renderer) return;
        renderer.zoom = Math.min(Math.max(renderer.zoom * factor, 0.3), 20);
        draw();
    });
    onScheme(draw);
    load(mesh);
    return { draw };
}
