// The page: tabs, what is going on, and the panels, each of which begins when it is first shown.
import { element } from "./controls.js";
import { onWork, stop } from "./library.js";
import * as plane from "./plane.js";
import * as mesh from "./mesh.js";
import * as peers from "./peers.js";
import * as stipple from "./stipple.js";
import * as volume from "./volume.js";
import * as mask from "./mask.js";

const panels = { plane, mesh, peers, stipple, volume, mask };
const names = Object.keys(panels);
const begun = new Map();

function show(name) {
    for (const other of names) {
        const isShown = other === name;
        element(other).hidden = !isShown;
        const tab = element(`tab-${other}`);
        tab.setAttribute("aria-selected", isShown);
        tab.tabIndex = isShown ? 0 : -1;
    }
    if (!begun.has(name)) begun.set(name, panels[name].begin());
    begun.get(name).draw();
}

for (const [i, name] of names.entries()) {
    const tab = element(`tab-${name}`);
    tab.addEventListener("click", () => {
        history.replaceState(null, "", `#/${name}`);
        show(name);
    });
    tab.addEventListener("keydown", (event) => {
        const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
        const next = { Home: 0, End: names.length - 1 }[event.key] ?? (step && (i + step + names.length) % names.length);
        if (next === undefined) return;
        event.preventDefault();
        element(`tab-${names[next]}`).focus();
        element(`tab-${names[next]}`).click();
    });
}

let shownFrom = 0;
onWork((isWorking) => {
    element("stop").disabled = !isWorking;
    clearTimeout(shownFrom);
    // Short work would flicker.
    shownFrom = setTimeout(() => { element("working").textContent = isWorking ? "Working …" : "Ready."; }, isWorking ? 150 : 0);
});
element("stop").addEventListener("click", stop);

// Not the id of the panel: the browser would scroll to it.
const shown = () => names.find((name) => `#/${name}` === location.hash) ?? "plane";
addEventListener("hashchange", () => show(shown()));
new ResizeObserver(() => begun.get(shown())?.draw()).observe(element("main"));
show(shown());
