// Naive algorithms in a few lines each, to look at beside the library; and an obvious count of conflicts. All sets are of
// the unit torus, x y of each point.

export const wrapped = (d) => d - Math.round(d);

// Random numbers in [0, 1) (mulberry32).
export function random(seed) {
    let state = seed >>> 0;
    return () => {
        state = (state + 0x6d2b79f5) >>> 0;
        let x = Math.imul(state ^ (state >>> 15), state | 1);
        x ^= x + Math.imul(x ^ (x >>> 7), x | 61);
        return ((x ^ (x >>> 14)) >>> 0) / 2 ** 32;
    };
}

const inside = (x) => Math.fround(x - Math.floor(x)) % 1;

// Cells of the unit torus, so that near points are found without looking at all.
class Cells {
    constructor(size) {
        this.count = Math.max(1, Math.floor(1 / size));
        this.cells = Array.from({ length: this.count ** 2 }, () => []);
    }

    add(point, index) {
        const [column, row] = point.map((x) => Math.min(Math.floor(x * this.count), this.count - 1));
        this.cells[row * this.count + column].push([...point, index]);
    }

    // Whether a point of the cells within `reach` cells is nearer than a distance.
    isNear([x, y], distance, reach) {
        const [column, row] = [x, y].map((value) => Math.min(Math.floor(value * this.count), this.count - 1));
        for (let j = -reach; j <= reach; j++) {
            for (let i = -reach; i <= reach; i++) {
                const at = (n) => (n + this.count * reach) % this.count;
                for (const [a, b] of this.cells[at(row + j) * this.count + at(column + i)]) {
                    if (Math.sqrt(wrapped(x - a) ** 2 + wrapped(y - b) ** 2) < distance) return true;
                }
            }
        }
        return false;
    }
}

// R. Bridson, Fast Poisson disk sampling in arbitrary dimensions, 2007: 30 darts around each sample.
export function bridson(radius, seed, darts = 30) {
    const next = random(seed);
    const cells = new Cells(radius);
    const first = [inside(next()), inside(next())];
    const [points, active] = [[first], [first]];
    cells.add(first, 0);
    while (active.length > 0) {
        const which = Math.floor(next() * active.length);
        const from = active[which];
        let found = null;
        for (let dart = 0; dart < darts && !found; dart++) {
            const [angle, length] = [2 * Math.PI * next(), radius * Math.sqrt(1 + 3 * next())];
            const point = [inside(from[0] + length * Math.cos(angle)), inside(from[1] + length * Math.sin(angle))];
            if (!cells.isNear(point, radius, 1)) found = point;
        }
        if (found) {
            points.push(found);
            active.push(found);
            cells.add(found, points.length - 1);
        } else {
            active[which] = active.at(-1);
            active.pop();
        }
    }
    return Float32Array.from(points.flat());
}

// A random point in each square of a grid of about so many.
export function jittered(count, seed) {
    const next = random(seed);
    const side = Math.round(Math.sqrt(count));
    const out = new Float32Array(2 * side * side);
    for (let i = 0; i < side * side; i++) {
        out[2 * i] = inside(((i % side) + next()) / side);
        out[2 * i + 1] = inside((Math.floor(i / side) + next()) / side);
    }
    return out;
}

// D. P. Mitchell, Spectrally optimal sampling for distribution ray tracing, 1991: of some random points the one that is
// farthest from those before.
export function bestCandidate(count, candidates, seed) {
    const next = random(seed);
    const out = new Float32Array(2 * count);
    for (let k = 0; k < count; k++) {
        let [best, most] = [null, -1];
        for (let c = 0; c < (k === 0 ? 1 : candidates); c++) {
            const [x, y] = [inside(next()), inside(next())];
            let least = Infinity;
            for (let i = 0; i < k && least > most; i++) {
                least = Math.min(least, wrapped(x - out[2 * i]) ** 2 + wrapped(y - out[2 * i + 1]) ** 2);
            }
            if (least > most) [best, most] = [[x, y], least];
        }
        out.set(best, 2 * k);
    }
    return out;
}

// The pairs of points that are closer than a radius, in double precision from the floats as they are; on the unit torus with
// `wrap`.
export function conflictPairs(positions, width, radius, wrap = (d) => d, isPair = () => true) {
    const count = positions.length / width;
    const order = Array.from({ length: count }, (_, i) => i).sort((a, b) => positions[width * a] - positions[width * b]);
    const isTorus = wrap === wrapped;
    const pairs = [];
    for (let k = 0; k < count; k++) {
        for (let step = 1; step < count; step++) {
            if (!isTorus && k + step >= count) break;
            const [i, j] = [order[k], order[(k + step) % count]];
            const along = positions[width * j] - positions[width * i] + (k + step >= count ? 1 : 0);
            if (along >= radius || (isTorus && along > 0.5)) break;
            let squared = 0;
            for (let axis = 0; axis < width; axis++) {
                squared += wrap(positions[width * i + axis] - positions[width * j + axis]) ** 2;
            }
            if (Math.sqrt(squared) < radius && isPair(i, j)) pairs.push([i, j]);
        }
    }
    return pairs;
}

export const countConflicts = (...args) => conflictPairs(...args).length;
