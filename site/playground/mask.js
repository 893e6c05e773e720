// A blue-noise mask, and a picture that is dithered with it.
import { ask, latest } from "./library.js";
import { Panel, colours, element, fitted, milliseconds, onScheme, takesFiles, whole } from "./controls.js";
import { greys, picture } from "./shapes.js";

export function begin() {
    let image = picture(250, 188);
    let made = null;
    const panel = new Panel("mask", () => run(), () => {
        const { side, levels, sigma, seed } = panel.values;
        return {
            call: "mask_create", levels, size: [image.width, image.height],
            options: [["width", Number(side)], ["height", Number(side)], ["seed", seed], ["sigma", sigma]],
        };
    });
    const { canvas, form } = panel;

    const run = latest(async () => {
        await panel.trying(async () => {
            const { side, levels, sigma, seed } = panel.values;
            const options = { width: Number(side), height: Number(side), seed, sigma };
            const result = await ask("mask", { options, image, levels });
            made = { ...result, side: Number(side), levels, width: image.width, height: image.height };
            const mean = (array, most) => array.reduce((sum, x) => sum + x, 0) / array.length / most;
            panel.figures([
                ["mask", `${side} × ${side} pixels`],
                ["ranks, each once", whole(made.ranks.length)],
                ["time of the mask", milliseconds(made.milliseconds)],
                ["picture", `${image.width} × ${image.height} pixels`],
                ["mean light of the picture", mean(image.values, 1).toFixed(4)],
                ["mean light, dithered", mean(made.dithered, levels - 1).toFixed(4)],
                ["time of the dithering", milliseconds(made.ditherMilliseconds)],
            ]);
            panel.showCode();
        });
        draw();
    });

    // Draws pixels of grey, 0 to 255, enlarged by a whole number of the screen's pixels where there is room.
    function pixels(context, columns, rows, grey, left, top, width) {
        const data = new ImageData(columns, rows);
        for (let i = 0; i < columns * rows; i++) data.data.set([...grey(i), 255], 4 * i);
        const canvas = new OffscreenCanvas(columns, rows);
        canvas.getContext("2d").putImageData(data, 0, 0);
        context.imageSmoothingEnabled = width < columns;
        context.drawImage(canvas, left, top, width, (width * rows) / columns);
    }

    function draw() {
        if (!made || canvas.clientWidth === 0) return;
        const { context, width, height } = fitted(canvas);
        context.fillStyle = colours()("paper");
        context.fillRect(0, 0, width, height);
        const { side, levels, ranks, dithered } = made;
        const isWide = width > height * 1.1;
        const most = Math.min(isWide ? width * 0.62 : width, ((isWide ? height : height * 0.55) * made.width) / made.height) - 8;
        // Levels are equal steps of light; a screen wants sRGB.
        const screen = (light) => 255 * (light <= 0.0031308 ? light * 12.92 : 1.055 * light ** (1 / 2.4) - 0.055);
        const wide = snapped(most, made.width);
        pixels(context, made.width, made.height, (i) => Array(3).fill(screen(dithered[i] / (levels - 1))), 4, 4, wide);
        const room = isWide ? width - wide - 20 : height - (wide * made.height) / made.width - 20;
        const [left, top] = isWide ? [wide + 14, 4] : [4, (wide * made.height) / made.width + 12];
        const square = snapped(Math.min(isWide ? (height - 16) / 2 : room, room), side);
        const dark = (form.elements.share.value / 100) * ranks.length;
        element("mask-share-says").textContent = `${form.elements.share.value} %`;
        pixels(context, side, side, (i) => Array(3).fill((255 * ranks[i]) / ranks.length), left, top, square);
        const [x, y] = isWide ? [left, top + square + 8] : [left + square + 8, top];
        if (x + square <= width) pixels(context, side, side, (i) => Array(3).fill(ranks[i] < dark ? 20 : 240), x, y, square);
    }

    const snapped = (width, columns) => (width > columns ? Math.floor(width / columns) * columns : width);

    form.elements.share.addEventListener("input", draw);
    takesFiles(panel.root.querySelector(".stage"), form.querySelector("[type=file]"), (file) => panel.trying(async () => {
        image = await greys(file).catch(() => { throw new Error(`${file.name}: is no image that this browser can read`); });
        run();
    }));
    onScheme(draw);
    run();
    return { draw };
}
