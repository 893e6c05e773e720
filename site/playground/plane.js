// Windows of a plane of 10^11 samples.
import { ask, latest } from "./library.js";
import { Panel, colours, element, fitted, milliseconds, navigable, onScheme, short, whole } from "./controls.js";

const RADIUS = 5.2e-6;
const DOMAIN = { domainMin: [-1, -1], domainMax: [1, 1] };
// Samples of maximal sets on an area of 1, times the square of the radius: MAXIMAL_DENSITY of the library.
const DENSITY = (0.5470735 * 4) / Math.PI;
const SAMPLES = (DENSITY * 4) / RADIUS ** 2;
const [CLOSEST, WIDEST] = [12 * RADIUS, 700 * RADIUS];

export function begin() {
    // The window in view: its centre, and its extent along the longer side of the canvas.
    const view = { x: 0.25, y: -0.5, extent: 160 * RADIUS };
    let drawn = null; // the last window: its samples, and its corners
    let flight = 0;

    const panel = new Panel("plane", () => look(), () => {
        const [min, max] = corners();
        return {
            call: "kdrt_window",
            options: [["radius", RADIUS], ["domain_min", DOMAIN.domainMin], ["domain_max", DOMAIN.domainMax], ["seed", panel.values.seed]],
            window: [min, max],
        };
    });
    const { canvas, form } = panel;
    const scale = () => Math.max(canvas.clientWidth, canvas.clientHeight) / view.extent;
    const limit = (x) => Math.min(Math.max(x, -1 + view.extent / 2), 1 - view.extent / 2);

    function corners() {
        const half = [canvas.clientWidth, canvas.clientHeight].map((n) => n / scale() / 2);
        const at = [view.x, view.y];
        return [at.map((x, axis) => Math.max(-1, x - half[axis])), at.map((x, axis) => Math.min(1, x + half[axis]))];
    }

    const request = latest(async () => {
        await panel.trying(async () => {
            const [min, max] = corners();
            const options = { radius: RADIUS, ...DOMAIN, seed: panel.values.seed };
            const { positions, milliseconds: spent, made } = await ask("plane", { options, min, max });
            drawn = { positions, min, max };
            const count = positions.length / 2;
            panel.figures([
                ["samples in the plane", `about ${(SAMPLES / 1e11).toFixed(2)} × 10¹¹`],
                ["radius, of a plane 2 wide", short(RADIUS)],
                ["samples in this window", whole(count)],
                ["time of this window", milliseconds(spent)],
                ["share of the plane", `1 / ${(4 / ((max[0] - min[0]) * (max[1] - min[1]))).toExponential(1)}`],
                ["window from", min.map((x) => x.toFixed(7)).join(", ")],
                ...(made > 1 ? [["the pattern, made once", milliseconds(made)]] : []),
            ]);
            panel.showCode();
        });
        draw();
    });

    function look() {
        view.extent = Math.min(Math.max(view.extent, CLOSEST), WIDEST);
        [view.x, view.y] = [limit(view.x), limit(view.y)];
        draw();
        request();
    }

    function draw() {
        if (canvas.clientWidth === 0) return;
        const { context, width, height } = fitted(canvas);
        const colour = colours();
        context.fillStyle = colour("paper");
        context.fillRect(0, 0, width, height);
        drawMap();
        if (!drawn) return;
        const { positions } = drawn;
        const by = scale();
        const radius = Math.max(0.5, 0.28 * RADIUS * by);
        context.fillStyle = colour("dot");
        context.beginPath();
        for (let i = 0; i < positions.length; i += 2) {
            const [x, y] = [width / 2 + (positions[i] - view.x) * by, height / 2 - (positions[i + 1] - view.y) * by];
            if (radius > 1.4) {
                context.moveTo(x + radius, y);
                context.arc(x, y, radius, 0, 2 * Math.PI);
            } else {
                context.rect(x - radius, y - radius, 2 * radius, 2 * radius);
            }
        }
        context.fill();
    }

    const map = element("plane-map");
    function drawMap() {
        const { context, width, height } = fitted(map);
        const colour = colours();
        context.fillStyle = colour("paper");
        context.fillRect(0, 0, width, height);
        const [x, y] = [((view.x + 1) / 2) * width, ((1 - view.y) / 2) * height];
        context.strokeStyle = colour("accent");
        context.beginPath();
        context.moveTo(x, 0);
        context.lineTo(x, height);
        context.moveTo(0, y);
        context.lineTo(width, y);
        context.stroke();
        context.fillStyle = colour("accent");
        context.fillRect(x - 2, y - 2, 4, 4);
    }

    function go(x, y) {
        [view.x, view.y] = [x, y];
        [form.elements.x.value, form.elements.y.value] = [x, y].map((value) => value.toFixed(6));
        look();
    }

    navigable(canvas, (dx, dy) => {
        view.x -= dx / scale();
        view.y += dy / scale();
        look();
    }, (factor, x, y) => {
        const before = scale();
        view.extent = Math.min(Math.max(view.extent / factor, CLOSEST), WIDEST);
        // What is under the pointer stays there.
        const [dx, dy] = [x - canvas.clientWidth / 2, y - canvas.clientHeight / 2];
        view.x += dx / before - dx / scale();
        view.y -= dy / before - dy / scale();
        look();
    });
    map.addEventListener("click", (event) => {
        const { left, top, width, height } = map.getBoundingClientRect();
        go((2 * (event.clientX - left)) / width - 1, 1 - (2 * (event.clientY - top)) / height);
    });
    form.addEventListener("change", ({ target }) => {
        if (target.dataset.only === "place" && [form.elements.x, form.elements.y].every((field) => field.value !== "")) {
            go(Number(form.elements.x.value), Number(form.elements.y.value));
        }
    });
    element("plane-random").addEventListener("click", () => go(2 * Math.random() - 1, 2 * Math.random() - 1));

    const fly = element("plane-fly");
    function step(now, before = now) {
        if (fly.getAttribute("aria-pressed") !== "true" || panel.root.hidden) {
            fly.setAttribute("aria-pressed", false);
            return;
        }
        flight += (now - before) / 1000;
        const speed = (0.25 * view.extent * (now - before)) / 1000;
        view.x += speed * Math.cos(0.2 * flight);
        view.y += speed * Math.sin(0.2 * flight);
        look();
        requestAnimationFrame((next) => step(next, now));
    }
    fly.addEventListener("click", () => {
        const isFlying = fly.getAttribute("aria-pressed") !== "true";
        fly.setAttribute("aria-pressed", isFlying);
        if (isFlying) requestAnimationFrame((now) => step(now));
    });

    onScheme(draw);
    look();
    return { draw };
}
