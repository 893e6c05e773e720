// A small renderer: a shaded mesh, and a disk for each sample, which lies on the surface.

const MESH_VERTEX = `#version 300 es
in vec3 position; in vec3 normal;
uniform mat4 view; uniform mat3 turn;
out vec3 facing;
void main() { facing = turn * normal; gl_Position = view * vec4(position, 1.0); }`;
const MESH_FRAGMENT = `#version 300 es
precision highp float;
in vec3 facing; uniform vec3 colour; out vec4 shade;
void main() {
    vec3 n = normalize(facing);
    if (n.z < 0.0) n = -n;
    float light = 0.35 + 0.65 * max(dot(n, normalize(vec3(-0.4, 0.5, 0.8))), 0.0);
    shade = vec4(colour * light, 1.0);
}`;
const DISK_VERTEX = `#version 300 es
in vec2 corner; in vec3 centre; in vec3 axis; in float kind;
uniform mat4 view; uniform mat3 turn; uniform float size, lift; uniform vec3 colours[4];
out vec2 place; out vec3 colour;
void main() {
    vec3 side = normalize(abs(axis.z) < 0.9 ? cross(axis, vec3(0, 0, 1)) : cross(axis, vec3(1, 0, 0)));
    vec3 up = cross(axis, side);
    vec3 towards = transpose(turn) * vec3(0, 0, 1);
    place = corner;
    colour = colours[int(kind)] * (0.55 + 0.45 * abs(dot(axis, towards)));
    gl_Position = view * vec4(centre + size * (corner.x * side + corner.y * up) + lift * towards, 1.0);
}`;
const DISK_FRAGMENT = `#version 300 es
precision highp float;
in vec2 place; in vec3 colour; out vec4 shade;
void main() { if (dot(place, place) > 1.0) discard; shade = vec4(colour, 1.0); }`;

export class Renderer {
    #gl;
    #mesh = null;
    #disks = null;

    // Throws where there is no WebGL 2.
    constructor(canvas) {
        this.canvas = canvas;
        this.turn = [0.55, -0.5]; // radians about the vertical axis of the screen, and the horizontal one
        this.zoom = 1;
        const gl = canvas.getContext("webgl2", { antialias: true, preserveDrawingBuffer: true });
        if (!gl) throw new Error("This browser has no WebGL 2: the mesh is sampled, but not drawn.");
        this.#gl = gl;
        this.meshProgram = this.#program(MESH_VERTEX, MESH_FRAGMENT);
        this.diskProgram = this.#program(DISK_VERTEX, DISK_FRAGMENT);
        gl.enable(gl.DEPTH_TEST);
    }

    #program(...sources) {
        const gl = this.#gl;
        const program = gl.createProgram();
        for (const [i, source] of sources.entries()) {
            const shader = gl.createShader(i === 0 ? gl.VERTEX_SHADER : gl.FRAGMENT_SHADER);
            gl.shaderSource(shader, source);
            gl.compileShader(shader);
            if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader));
            gl.attachShader(program, shader);
        }
        gl.linkProgram(program);
        if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(program));
        return program;
    }

    #attribute(program, name, data, size, divisor = 0) {
        const gl = this.#gl;
        const place = gl.getAttribLocation(program, name);
        const buffer = gl.createBuffer();
        gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
        gl.bufferData(gl.ARRAY_BUFFER, data, gl.STATIC_DRAW);
        gl.enableVertexAttribArray(place);
        gl.vertexAttribPointer(place, size, gl.FLOAT, false, 0, 0);
        gl.vertexAttribDivisor(place, divisor);
        return buffer;
    }

    #free(drawn) {
        if (!drawn) return;
        this.#gl.deleteVertexArray(drawn.array);
        for (const buffer of drawn.buffers) this.#gl.deleteBuffer(buffer);
    }

    setMesh(positions, indices) {
        const gl = this.#gl;
        this.#free(this.#mesh);
        // Flat where edges are sharp: corners of their own for each triangle, with the mean normal of the vertex only where
        // that is near to the triangle's.
        const count = indices.length / 3;
        const faces = new Float32Array(3 * count), vertices = new Float32Array(positions.length);
        const [low, high] = [[Infinity, Infinity, Infinity], [-Infinity, -Infinity, -Infinity]];
        positions.forEach((x, i) => {
            low[i % 3] = Math.min(low[i % 3], x);
            high[i % 3] = Math.max(high[i % 3], x);
        });
        for (let t = 0; t < count; t++) {
            const [a, b, c] = [0, 1, 2].map((k) => 3 * indices[3 * t + k]);
            const [u, v] = [b, c].map((k) => [0, 1, 2].map((axis) => positions[k + axis] - positions[a + axis]));
            const n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
            for (let axis = 0; axis < 3; axis++) for (const k of [a, b, c]) vertices[k + axis] += n[axis];
            const length = Math.hypot(...n) || 1;
            faces.set(n.map((x) => x / length), 3 * t);
        }
        const corners = new Float32Array(9 * count), normals = new Float32Array(9 * count);
        for (let i = 0; i < indices.length; i++) {
            const [k, t] = [3 * indices[i], 3 * Math.floor(i / 3)];
            const mean = vertices.subarray(k, k + 3), face = faces.subarray(t, t + 3);
            const length = Math.hypot(...mean) || 1;
            const cosine = (mean[0] * face[0] + mean[1] * face[1] + mean[2] * face[2]) / length;
            corners.set(positions.subarray(k, k + 3), 3 * i);
            normals.set(cosine > 0.8 ? mean.map((x) => x / length) : face, 3 * i);
        }
        const array = gl.createVertexArray();
        gl.bindVertexArray(array);
        const buffers = [
            this.#attribute(this.meshProgram, "position", corners, 3), this.#attribute(this.meshProgram, "normal", normals, 3),
        ];
        this.centre = low.map((x, axis) => (x + high[axis]) / 2);
        this.extent = Math.hypot(...low.map((x, axis) => high[axis] - x)) / 2 || 1;
        this.#mesh = { array, buffers, count: indices.length };
        this.#free(this.#disks);
        this.#disks = null;
    }

    // Disks of a radius; the first `shown` of them are drawn.
    setDisks(positions, normals, classes, radius) {
        const gl = this.#gl;
        this.#free(this.#disks);
        const count = positions.length / 3;
        const kinds = classes ? Float32Array.from(classes) : new Float32Array(count);
        const array = gl.createVertexArray();
        gl.bindVertexArray(array);
        const buffers = [
            this.#attribute(this.diskProgram, "corner", Float32Array.of(-1, -1, 1, -1, -1, 1, 1, 1), 2),
            this.#attribute(this.diskProgram, "centre", positions, 3, 1),
            this.#attribute(this.diskProgram, "axis", normals, 3, 1),
            this.#attribute(this.diskProgram, "kind", kinds, 1, 1),
        ];
        this.#disks = { array, buffers, count, radius };
        this.shown = count;
    }

    draw(colours) {
        const gl = this.#gl, { canvas } = this;
        const [width, height] = [canvas.clientWidth, canvas.clientHeight].map((n) => Math.max(1, Math.round(n * devicePixelRatio)));
        if (canvas.width !== width || canvas.height !== height) [canvas.width, canvas.height] = [width, height];
        gl.viewport(0, 0, width, height);
        gl.clearColor(...colours.ground, 1);
        gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
        if (!this.#mesh) return;
        const [a, b] = this.turn;
        const [ca, sa, cb, sb] = [Math.cos(a), Math.sin(a), Math.cos(b), Math.sin(b)];
        // The rotation, row by row: about the screen's vertical axis, then its horizontal one.
        const rows = [[ca, 0, sa], [sb * sa, cb, -sb * ca], [-cb * sa, sb, cb * ca]];
        const scale = (1.3 * this.zoom) / this.extent;
        const wide = [scale * Math.min(1, height / width), scale * Math.min(1, width / height), -0.3 * scale / this.zoom];
        const view = new Float32Array(16);
        rows.forEach((row, r) => {
            row.forEach((x, c) => { view[4 * c + r] = wide[r] * x; });
            view[12 + r] = -wide[r] * row.reduce((sum, x, c) => sum + x * this.centre[c], 0);
        });
        view[15] = 1;
        const turn = new Float32Array(9);
        rows.forEach((row, r) => row.forEach((x, c) => { turn[3 * c + r] = x; }));
        const uniforms = (program) => {
            gl.useProgram(program);
            gl.uniformMatrix4fv(gl.getUniformLocation(program, "view"), false, view);
            gl.uniformMatrix3fv(gl.getUniformLocation(program, "turn"), false, turn);
            return (name) => gl.getUniformLocation(program, name);
        };
        const ofMesh = uniforms(this.meshProgram);
        gl.uniform3fv(ofMesh("colour"), colours.mesh);
        gl.bindVertexArray(this.#mesh.array);
        gl.drawArrays(gl.TRIANGLES, 0, this.#mesh.count);
        if (!this.#disks || this.shown === 0) return;
        const ofDisk = uniforms(this.diskProgram);
        gl.uniform3fv(ofDisk("colours"), colours.classes.flat());
        gl.uniform1f(ofDisk("size"), this.#disks.radius);
        gl.uniform1f(ofDisk("lift"), 0.5 * this.#disks.radius);
        gl.bindVertexArray(this.#disks.array);
        gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, Math.min(this.shown, this.#disks.count));
    }
}
