// Built-in meshes and pictures, made here: nothing is loaded.

// A closed tube of a radius around a closed curve in space.
function tube(curve, radius, along, around) {
    const positions = new Float32Array(3 * along * around);
    const indices = new Uint32Array(6 * along * around);
    const minus = (a, b) => a.map((x, i) => x - b[i]);
    const unit = (a) => a.map((x) => x / Math.hypot(...a));
    const cross = ([a, b, c], [d, e, f]) => [b * f - c * e, c * d - a * f, a * e - b * d];
    for (let i = 0; i < along; i++) {
        const [before, at, after] = [i - 0.5, i, i + 0.5].map((k) => curve((2 * Math.PI * k) / along));
        const tangent = unit(minus(after, before));
        // The curves here never run along the axis z for long; the frame is that of the axis, and so closes.
        const side = unit(cross(tangent, [0, 0, 1]));
        const up = cross(side, tangent);
        for (let j = 0; j < around; j++) {
            const angle = (2 * Math.PI * j) / around;
            const [c, s] = [radius * Math.cos(angle), radius * Math.sin(angle)];
            positions.set(at.map((x, axis) => x + c * side[axis] + s * up[axis]), 3 * (i * around + j));
            const corner = (a, b) => ((i + a) % along) * around + ((j + b) % around);
            indices.set([corner(0, 0), corner(0, 1), corner(1, 1), corner(0, 0), corner(1, 1), corner(1, 0)], 6 * (i * around + j));
        }
    }
    return { positions, indices };
}

function box() {
    const positions = Float32Array.from([0, 1, 2, 3, 4, 5, 6, 7].flatMap((k) => [k & 1, (k >> 1) & 1, k >> 2]));
    const squares = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    return { positions, indices: Uint32Array.from(squares.flatMap(([a, b, c, d]) => [a, b, c, a, c, d])) };
}

export const SHAPES = {
    knot: () => tube((t) => {
        const r = 2 + Math.cos(3 * t);
        return [0.5 * r * Math.cos(2 * t), 0.5 * r * Math.sin(2 * t), 0.5 * Math.sin(3 * t)];
    }, 0.28, 240, 32),
    torus: () => tube((t) => [Math.cos(t), Math.sin(t), 0], 0.4, 120, 48),
    cube: box,
};

// A grey picture: a lit ball on a ground that fades, 0 for black to 1 for white.
export function picture(width = 360, height = 270) {
    const values = new Float32Array(width * height);
    const [cx, cy, radius] = [0.5 * width, 0.47 * height, 0.36 * height];
    for (let y = 0; y < height; y++) {
        for (let x = 0; x < width; x++) {
            const [u, v] = [(x + 0.5 - cx) / radius, (y + 0.5 - cy) / radius];
            const squared = u * u + v * v;
            let grey = 0.72 + 0.26 * (1 - y / height);
            // The shadow on the ground.
            const [p, q] = [(u - 0.5) / 1.25, (v - 1.05) / 0.22];
            grey -= 0.5 * Math.exp(-1.5 * (p * p + q * q));
            if (squared < 1) {
                const w = Math.sqrt(1 - squared);
                grey = 0.06 + 0.9 * Math.max(0, (-0.55 * u - 0.6 * v + 0.58 * w)) ** 0.9;
            }
            values[y * width + x] = Math.min(Math.max(grey, 0), 1);
        }
    }
    return { values, width, height };
}

// The grey values of an image file, linear in light, at most so many pixels wide and high.
export async function greys(file, most = 400) {
    const bitmap = await createImageBitmap(file);
    const scale = Math.min(1, most / Math.max(bitmap.width, bitmap.height));
    const [width, height] = [bitmap.width, bitmap.height].map((n) => Math.max(2, Math.round(n * scale)));
    const canvas = new OffscreenCanvas(width, height);
    const context = canvas.getContext("2d");
    context.fillStyle = "white";
    context.fillRect(0, 0, width, height);
    context.drawImage(bitmap, 0, 0, width, height);
    const { data } = context.getImageData(0, 0, width, height);
    const linear = (byte) => (byte <= 10 ? byte / 255 / 12.92 : ((byte / 255 + 0.055) / 1.055) ** 2.4);
    const values = new Float32Array(width * height);
    for (let i = 0; i < values.length; i++) {
        values[i] = 0.2126 * linear(data[4 * i]) + 0.7152 * linear(data[4 * i + 1]) + 0.0722 * linear(data[4 * i + 2]);
    }
    return { values, width, height };
}
