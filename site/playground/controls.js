// What the panels share: fields, figures, messages, dragging and pinching, and the code for the present settings.
import { LANGUAGES, write } from "./code.js";

export const element = (id) => document.getElementById(id);

const isDark = matchMedia("(prefers-color-scheme: dark)");

// The colours of drawings, of the light or the dark scheme, as CSS and as numbers.
export function colours() {
    const style = getComputedStyle(document.documentElement);
    return (name) => style.getPropertyValue(`--${name}`).trim();
}
export const rgb = (hex) => [1, 3, 5].map((i) => parseInt(hex.slice(i, i + 2), 16) / 255);
export const onScheme = (draw) => isDark.addEventListener("change", draw);

export const whole = (n) => Number(n).toLocaleString("en");
export const short = (x) => (Number.isFinite(x) ? String(Number(x.toPrecision(5))) : String(x));
export const milliseconds = (ms) => (ms < 10 ? `${ms.toFixed(1)} ms` : ms < 1000 ? `${Math.round(ms)} ms` : `${(ms / 1000).toFixed(2)} s`);

// The numbers of a form's fields by their names, and the text of its choices.
export function fields(form) {
    const out = {};
    for (const field of form.elements) {
        if (!field.name) continue;
        if (field.type === "checkbox") out[field.name] = field.checked;
        else if (field.type === "number" || field.type === "range") out[field.name] = field.value === "" ? NaN : Number(field.value);
        else if (field.type !== "file") out[field.name] = field.value;
    }
    return out;
}

// A panel: its form, drawing, figures, message and code. `changed` is called with the fields when one of them changes.
export class Panel {
    constructor(name, changed, settings) {
        this.root = element(name);
        this.form = this.root.querySelector("form");
        this.canvas = this.root.querySelector("canvas");
        this.list = this.root.querySelector(".figures");
        this.message = this.root.querySelector(".message");
        this.settings = settings;
        this.form.addEventListener("submit", (event) => event.preventDefault());
        this.form.addEventListener("change", (event) => {
            if (event.target.type !== "file" && !event.target.dataset.only) changed();
        });
        this.#makeCode();
    }

    get values() {
        return fields(this.form);
    }

    // Rows of a name, a value and, where it says how good the set is, whether that is as promised.
    figures(rows) {
        this.list.replaceChildren(...rows.map(([name, value, verdict]) => {
            const row = document.createElement("div");
            const term = document.createElement("dt"), says = document.createElement("dd");
            term.textContent = name;
            says.textContent = value;
            says.dataset.name = name;
            if (verdict !== undefined) says.className = verdict ? "good" : "bad";
            row.append(term, says);
            return row;
        }));
    }

    // Runs a job; what the library refuses is shown in its words.
    async trying(job) {
        try {
            await job();
            this.message.textContent = "";
        } catch (error) {
            this.message.textContent = error.message;
        }
        this.root.dataset.runs = Number(this.root.dataset.runs ?? 0) + 1;
    }

    #makeCode() {
        const box = document.createElement("details");
        box.className = "code";
        box.innerHTML = `<summary>Copy as code</summary>
            <div class="row"><label>Language <select data-only="code">${LANGUAGES.map((l) => `<option>${l}</option>`).join("")}</select></label>
            <button type="button">Copy</button> <span role="status"></span></div><pre tabindex="0"></pre>`;
        this.root.append(box);
        const [select, button, status, pre] = ["select", "button", "span", "pre"].map((tag) => box.querySelector(tag));
        this.showCode = () => {
            pre.textContent = write(select.value, this.settings());
            status.textContent = "";
        };
        select.value = "Python";
        select.addEventListener("change", this.showCode);
        box.addEventListener("toggle", this.showCode);
        button.addEventListener("click", async () => {
            try {
                await navigator.clipboard.writeText(pre.textContent);
                status.textContent = "Copied.";
            } catch {
                getSelection().selectAllChildren(pre);
                status.textContent = "Selected: press Ctrl+C.";
            }
        });
    }
}

// A canvas of as many pixels as the screen shows, and its context in units of CSS pixels.
export function fitted(canvas) {
    const [width, height] = [canvas.clientWidth, canvas.clientHeight];
    const ratio = devicePixelRatio || 1;
    const [w, h] = [Math.max(1, Math.round(width * ratio)), Math.max(1, Math.round(height * ratio))];
    if (canvas.width !== w || canvas.height !== h) [canvas.width, canvas.height] = [w, h];
    const context = canvas.getContext("2d");
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    return { context, width, height };
}

// Dragging, wheel, pinching and keys on a canvas: `pan(dx, dy)` in CSS pixels, `zoom(factor, x, y)` about a place.
export function navigable(canvas, pan, zoom) {
    const pointers = new Map();
    const place = ({ clientX, clientY }) => {
        const { left, top } = canvas.getBoundingClientRect();
        return [clientX - left, clientY - top];
    };
    canvas.addEventListener("pointerdown", (event) => {
        canvas.setPointerCapture(event.pointerId);
        pointers.set(event.pointerId, place(event));
    });
    canvas.addEventListener("pointermove", (event) => {
        const before = pointers.get(event.pointerId);
        if (!before) return;
        const now = place(event);
        const other = [...pointers].find(([id]) => id !== event.pointerId)?.[1];
        if (!other) {
            pan(now[0] - before[0], now[1] - before[1]);
        } else {
            const length = ([x, y]) => Math.hypot(x - other[0], y - other[1]) || 1;
            pan((now[0] - before[0]) / 2, (now[1] - before[1]) / 2);
            zoom(length(now) / length(before), (now[0] + other[0]) / 2, (now[1] + other[1]) / 2);
        }
        pointers.set(event.pointerId, now);
    });
    for (const kind of ["pointerup", "pointercancel"]) {
        canvas.addEventListener(kind, (event) => pointers.delete(event.pointerId));
    }
    canvas.addEventListener("wheel", (event) => {
        event.preventDefault();
        zoom(Math.exp(-event.deltaY * (event.deltaMode === 1 ? 0.03 : 0.0015)), ...place(event));
    }, { passive: false });
    canvas.addEventListener("keydown", (event) => {
        const middle = [canvas.clientWidth / 2, canvas.clientHeight / 2];
        const keys = {
            ArrowLeft: () => pan(40, 0), ArrowRight: () => pan(-40, 0), ArrowUp: () => pan(0, 40), ArrowDown: () => pan(0, -40),
            "+": () => zoom(1.25, ...middle), "=": () => zoom(1.25, ...middle), "-": () => zoom(0.8, ...middle),
        };
        if (!keys[event.key] || event.ctrlKey || event.metaKey) return;
        event.preventDefault();
        keys[event.key]();
    });
}

// Files that are dropped on an element or chosen in an input.
export function takesFiles(target, input, take) {
    for (const kind of ["dragenter", "dragover"]) {
        target.addEventListener(kind, (event) => {
            event.preventDefault();
            target.classList.add("over");
        });
    }
    for (const kind of ["dragleave", "drop"]) target.addEventListener(kind, () => target.classList.remove("over"));
    target.addEventListener("drop", (event) => {
        event.preventDefault();
        if (event.dataTransfer.files[0]) take(event.dataTransfer.files[0]);
    });
    input.addEventListener("change", () => {
        if (input.files[0]) take(input.files[0]);
    });
}
