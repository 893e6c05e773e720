// A picture in dots.
import { ask, latest } from "./library.js";
import { Panel, colours, fitted, milliseconds, onScheme, takesFiles, whole } from "./controls.js";
import { greys, picture } from "./shapes.js";

export function begin() {
    let image = picture();
    let set = null;
    const panel = new Panel("stipple", () => run(), () => {
        const { count, seed, steps } = panel.values;
        const longer = Math.max(image.width, image.height);
        return {
            call: "dcr_relax_density", count, size: [image.width, image.height],
            options: [
                ["domain_max", [image.width / longer, image.height / longer]], ["boundary", "bounded"],
                ["max_iterations", steps], ["seed", seed],
            ],
        };
    });
    const { canvas, form } = panel;

    const run = latest(async () => {
        await panel.trying(async () => {
            const { count, seed, steps } = panel.values;
            const { width, height } = image;
            // Densities from below: as much ink as the picture lacks light.
            const values = new Float32Array(width * height);
            for (let y = 0; y < height; y++) {
                for (let x = 0; x < width; x++) values[(height - 1 - y) * width + x] = 1 - image.values[y * width + x];
            }
            set = await ask("stipple", { values, width, height, count, seed, steps });
            // Dots with as much ink as the picture.
            const ink = values.reduce((sum, value) => sum + value, 0) / values.length;
            set.radius = Math.sqrt((ink * set.domainMax[0] * set.domainMax[1]) / Math.PI / count);
            panel.figures([
                ["dots", whole(set.positions.length / 2)],
                ["picture", `${width} × ${height} pixels`],
                ["steps", whole(set.iterations)],
                ["stopped by", { converged: "convergence", steps: "the number of steps" }[set.stopped]],
                ["smallest distance, of the local spacing", set.rho.toFixed(3)],
                ["time", milliseconds(set.milliseconds)],
            ]);
            panel.showCode();
        });
        draw();
    });

    function draw() {
        if (!set || canvas.clientWidth === 0) return;
        const { context, width, height } = fitted(canvas);
        // Ink is dark on light paper in both schemes: the picture would be its own negative otherwise.
        context.fillStyle = colours()("stock");
        context.fillRect(0, 0, width, height);
        const scale = Math.min(width / set.domainMax[0], height / set.domainMax[1]);
        const [left, top] = [(width - scale * set.domainMax[0]) / 2, (height + scale * set.domainMax[1]) / 2];
        context.fillStyle = colours()("print");
        context.beginPath();
        const radius = set.radius * scale;
        for (let i = 0; i < set.positions.length; i += 2) {
            const [x, y] = [left + scale * set.positions[i], top - scale * set.positions[i + 1]];
            context.moveTo(x + radius, y);
            context.arc(x, y, radius, 0, 2 * Math.PI);
        }
        context.fill();
    }

    takesFiles(panel.root.querySelector(".stage"), form.querySelector("[type=file]"), (file) => panel.trying(async () => {
        image = await greys(file).catch(() => { throw new Error(`${file.name}: is no image that this browser can read`); });
        run();
    }));
    onScheme(draw);
    run();
    return { draw };
}
