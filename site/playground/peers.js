// Naive algorithms beside the library, in the plane.
import { ask, latest } from "./library.js";
import { Panel, colours, fitted, milliseconds, onScheme, whole } from "./controls.js";
import { conflictPairs, wrapped } from "./naive.js";

export function begin() {
    let result = null;
    const panel = new Panel("peers", () => run(), () => {
        const { radius, seed } = panel.values;
        return { call: "kdrt_sample", options: [["radius", radius], ["seed", seed]] };
    });
    const { canvas } = panel;
    const body = panel.root.querySelector("tbody");

    const run = latest(async () => {
        await panel.trying(async () => {
            const { radius, seed, candidates } = panel.values;
            if (!(radius >= 0.012)) throw new Error(`radius: ${radius} is less than 0.012, from which on naive algorithms take long`);
            if (!(candidates >= 1 && candidates <= 100)) throw new Error(`candidates: ${candidates} is not from 1 to 100`);
            result = await ask("peers", { radius, seed, candidates });
            body.replaceChildren(...result.sets.map(row));
            panel.showCode();
        });
        draw();
    });

    function row(set) {
        const out = document.createElement("tr");
        const inRadii = (x) => (x / result.radius).toFixed(4);
        const cells = [
            [set.name], [whole(set.count)], [whole(set.conflicts), set.conflicts === 0], [whole(set.gaps), set.gaps === 0],
            [inRadii(set.smallest)], [inRadii(set.coveringRadius)], [milliseconds(set.milliseconds)],
        ];
        for (const [text, verdict] of cells) {
            const cell = out.insertCell();
            cell.textContent = text;
            if (verdict !== undefined) cell.className = verdict ? "good" : "bad";
        }
        return out;
    }

    function draw() {
        if (!result || canvas.clientWidth === 0) return;
        const { context, width, height } = fitted(canvas);
        const colour = colours();
        context.fillStyle = colour("raised");
        context.fillRect(0, 0, width, height);
        const columns = width > 1.5 * height ? 4 : 2;
        const cell = Math.floor(width / columns);
        const [title, margin] = [18, 6];
        const side = Math.floor(Math.min(cell - 2 * margin, height / (4 / columns) - title - margin));
        for (const [k, set] of result.sets.entries()) {
            const [left, top] = [(k % columns) * cell + margin, Math.floor(k / columns) * (side + title + margin) + title];
            context.fillStyle = colour("ink");
            context.font = "12px system-ui, sans-serif";
            context.fillText(set.name, left, top - 5);
            context.save();
            context.beginPath();
            context.rect(left, top, side, side);
            context.clip();
            // What no disk of the radius covers stays red.
            context.fillStyle = colour("gap");
            context.fillRect(left, top, side, side);
            const disks = (radius, style) => {
                context.fillStyle = style;
                context.beginPath();
                for (let i = 0; i < set.positions.length; i += 2) {
                    const [u, v] = [set.positions[i], set.positions[i + 1]];
                    for (const du of [-1, 0, 1]) {
                        for (const dv of [-1, 0, 1]) {
                            if (u + du < -radius || u + du > 1 + radius || v + dv < -radius || v + dv > 1 + radius) continue;
                            const [x, y] = [left + (u + du) * side, top + (1 - v - dv) * side];
                            context.moveTo(x + radius * side, y);
                            context.arc(x, y, radius * side, 0, 2 * Math.PI);
                        }
                    }
                }
                context.fill();
            };
            disks(result.radius, colour("paper"));
            disks(Math.max(1.2 / side, 0.13 * result.radius), colour("dot"));
            context.strokeStyle = colour("conflict");
            context.lineWidth = 2.5;
            context.lineCap = "round";
            context.beginPath();
            for (const [i, j] of conflictPairs(set.positions, 2, result.radius, wrapped)) {
                const [x, y] = [set.positions[2 * i], set.positions[2 * i + 1]];
                const [dx, dy] = [wrapped(set.positions[2 * j] - x), wrapped(set.positions[2 * j + 1] - y)];
                context.moveTo(left + x * side, top + (1 - y) * side);
                context.lineTo(left + (x + dx) * side, top + (1 - y - dy) * side);
            }
            context.stroke();
            context.restore();
        }
    }

    onScheme(draw);
    run();
    return { draw };
}
