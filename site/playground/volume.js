// The inside of a box or of a mesh, and a cut through it.
import { ask, latest } from "./library.js";
import { Panel, colours, fitted, milliseconds, onScheme, short, takesFiles, whole } from "./controls.js";
import { builtIn, fileOf, fromFile, saveMesh, showByAmount } from "./mesh.js";

const BOX = [[0, 0, 0], [2, 1, 1]];

export function begin() {
    let mesh = null, set = null, outline = null;
    const panel = new Panel("volume", () => run(), () => {
        const { by, radius, count, seed, first } = panel.values;
        const amount = by === "count" ? ["count", count] : ["radius", radius];
        if (!mesh) {
            const options = [amount, ["domain_min", BOX[0]], ["domain_max", BOX[1]], ["boundary", "bounded"], ["seed", seed]];
            return { call: "volume_sample", options };
        }
        const options = [amount, ...(first ? [["surface", "first"]] : []), ["seed", seed]];
        return { call: "volume_sample_inside", file: fileOf(mesh), options };
    });
    const { canvas, form } = panel;

    const run = latest(async () => {
        await panel.trying(async () => {
            showByAmount(form);
            const { by, radius, count, seed, first } = panel.values;
            form.elements.first.closest("label").hidden = form.querySelector(".save").hidden = !mesh;
            const amount = by === "count" ? { count } : { radius };
            const options = mesh ? { ...amount, seed, surface: first ? "first" : "open" }
                : { ...amount, seed, domainMin: BOX[0], domainMax: BOX[1], boundary: "bounded" };
            if (mesh && !outline) outline = await ask("mesh", { mesh });
            set = await ask("volume", { mesh, options });
            panel.figures([
                ["samples", whole(set.positions.length / 3)],
                ...(mesh ? [["of these on the surface", whole(set.surfaceSamples)]] : []),
                ["radius", short(set.radius)],
                ["smallest distance", short(set.smallest)],
                ["conflicts", whole(set.conflicts), set.conflicts === 0],
                ["farthest place, at most", short(set.coveringRadius)],
                ...(mesh ? [["places may be open to a depth of", short(set.depth)]] : []),
                ["time", milliseconds(set.milliseconds)],
            ]);
            panel.showCode();
        });
        draw();
    });

    function draw() {
        if (!set || canvas.clientWidth === 0) return;
        const { context, width, height } = fitted(canvas);
        const colour = colours();
        context.fillStyle = colour("paper");
        context.fillRect(0, 0, width, height);
        const { positions } = set;
        let [low, high] = BOX;
        if (mesh && outline) {
            [low, high] = [[Infinity, Infinity, Infinity], [-Infinity, -Infinity, -Infinity]];
            outline.positions.forEach((x, i) => {
                low[i % 3] = Math.min(low[i % 3], x);
                high[i % 3] = Math.max(high[i % 3], x);
            });
        }
        const cut = low[2] + (high[2] - low[2]) * (form.elements.cut.value / 1000);
        const margin = 16;
        const scale = Math.min((width - 2 * margin) / (high[0] - low[0]), (height - 2 * margin) / (high[1] - low[1]));
        const place = (x, y) => [
            width / 2 + (x - (low[0] + high[0]) / 2) * scale, height / 2 - (y - (low[1] + high[1]) / 2) * scale,
        ];
        const reach = set.radius / 2;
        let count = 0;
        for (let i = 0; i < positions.length; i += 3) {
            const off = positions[i + 2] - cut;
            if (Math.abs(off) >= reach) continue;
            count++;
            const radius = Math.sqrt(reach * reach - off * off) * scale;
            const [x, y] = place(positions[i], positions[i + 1]);
            context.fillStyle = colour(i / 3 < (set.surfaceSamples ?? 0) ? "class-2" : "dot");
            context.globalAlpha = 0.35 + 0.65 * (1 - Math.abs(off) / reach);
            context.beginPath();
            context.arc(x, y, Math.max(radius, 0.5), 0, 2 * Math.PI);
            context.fill();
        }
        context.globalAlpha = 1;
        panel.root.dataset.cut = count;
        context.strokeStyle = colour("ink");
        context.lineWidth = 1.5;
        context.beginPath();
        if (!mesh) {
            const [[x, y], [u, v]] = [place(low[0], high[1]), place(high[0], low[1])];
            context.rect(x, y, u - x, v - y);
        } else if (outline) {
            for (const [a, b] of crossing(outline, cut)) {
                context.moveTo(...place(...a));
                context.lineTo(...place(...b));
            }
        }
        context.stroke();
    }

    async function take(wanted) {
        [mesh, outline, set] = [wanted, null, null];
        // About 4,000 samples of a mesh that nothing is known about: a twelfth of its shortest side.
        if (wanted?.bytes) {
            await panel.trying(async () => {
                outline = await ask("mesh", { mesh });
                const sides = [0, 1, 2].map((axis) => {
                    let [least, most] = [Infinity, -Infinity];
                    for (let i = axis; i < outline.positions.length; i += 3) {
                        least = Math.min(least, outline.positions[i]);
                        most = Math.max(most, outline.positions[i]);
                    }
                    return most - least;
                });
                form.elements.radius.value = (Math.min(...sides) / 12).toPrecision(3);
                form.elements.shape.querySelector("[value=file]").hidden = false;
                form.elements.shape.value = "file";
            });
            if (!outline) return;
        }
        run();
    }

    form.elements.shape.addEventListener("change", (event) => {
        event.stopPropagation();
        if (event.target.value !== "file") take(event.target.value === "box" ? null : builtIn(event.target.value));
    });
    form.querySelector(".save").addEventListener("click", () => panel.trying(() => saveMesh(mesh)));
    form.elements.cut.addEventListener("input", draw);
    takesFiles(panel.root.querySelector(".stage"), form.querySelector("[type=file]"), async (file) => take(await fromFile(file)));
    onScheme(draw);
    run();
    return { draw };
}

// The segments in which triangles meet the plane z = `cut`.
function* crossing({ positions, indices }, cut) {
    for (let t = 0; t < indices.length; t += 3) {
        const ends = [];
        for (let k = 0; k < 3; k++) {
            const [a, b] = [3 * indices[t + k], 3 * indices[t + ((k + 1) % 3)]];
            const [za, zb] = [positions[a + 2] - cut, positions[b + 2] - cut];
            if (za < 0 === zb < 0) continue;
            const share = za / (za - zb);
            ends.push([0, 1].map((axis) => positions[a + axis] + share * (positions[b + axis] - positions[a + axis])));
        }
        if (ends.length === 2) yield ends;
    }
}
