// The site in headless Chromium, wide and narrow: node test/site.js SITE PICTURES. Each panel does its job, by the numbers that
// the page shows; nothing is written to the console, nothing is loaded from elsewhere, and no page is wider than the window.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { existsSync, mkdirSync, readFileSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { join, resolve } from "node:path";
import puppeteer from "puppeteer-core";
import { serve } from "../serve.js";

const [site, pictures] = process.argv.slice(2).map((path) => resolve(path));
const scratch = resolve("target/site-code");
mkdirSync(pictures, { recursive: true });
mkdirSync(scratch, { recursive: true });

const corners = [0, 1, 2, 3, 4, 5, 6, 7].map((k) => `${k & 1} ${(k >> 1) & 1} ${k >> 2}`).join("\n");
const squares = ["0 2 3 1", "4 5 7 6", "0 1 5 4", "2 6 7 3", "0 4 6 2", "1 3 7 5"].map((square) => `4 ${square}`);
const file = (name, text) => {
    writeFileSync(join(scratch, name), text);
    return join(scratch, name);
};
const CUBE = file("cube.off", `OFF\n8 6 0\n${corners}\n${squares.join("\n")}\n`);
const FLAT = file("flat.off", `OFF\n8 1 0\n${corners}\n${squares[0]}\n`);
const BROKEN = file("broken.ply", "ply\nformat ascii 1.0\nelement vertex 3\n");

const { server, address } = await serve(site);
const browser = await puppeteer.launch({
    executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
    // Software rendering: WebGL, too.
    args: ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist"],
});
const page = await browser.newPage();
rmSync(join(scratch, "knot.obj"), { force: true });
const session = await page.createCDPSession();
await session.send("Browser.setDownloadBehavior", { behavior: "allow", downloadPath: scratch });
const complaints = [];
page.on("console", (message) => complaints.push(message.text()));
page.on("pageerror", (error) => complaints.push(String(error)));
page.on("requestfailed", (request) => complaints.push(`not loaded: ${request.url()}`));
page.on("request", (request) => {
    const url = request.url();
    if (!url.startsWith(address) && !/^(data|blob):/.test(url)) complaints.push(`loaded from elsewhere: ${url}`);
});

let panel;
const number = (text) => Number(String(text).replace(/,/g, ""));
const find = (selector) => page.$(`#${panel} ${selector}`);
const figures = () => page.$eval(`#${panel} .figures`, (list) => (
    Object.fromEntries([...list.querySelectorAll("dd")].map((value) => [value.dataset.name, value.textContent]))
));
const message = () => page.$eval(`#${panel} .message`, (element) => element.textContent);
const runs = () => page.$eval(`#${panel}`, (element) => Number(element.dataset.runs ?? 0));

// Waits until a panel has made its job once more than `before`, and rests.
async function settled(before) {
    await page.waitForFunction((name, count) => (
        Number(document.getElementById(name).dataset.runs ?? 0) > count && document.getElementById("stop").disabled
    ), { timeout: 60_000, polling: 30 }, panel, before);
}

async function open(name, scheme = "light") {
    panel = name;
    await page.emulateMediaFeatures([{ name: "prefers-color-scheme", value: scheme }]);
    await page.goto(`${address}/playground/index.html?${Math.random()}#/${name}`);
    await settled(0);
    assert.equal(await message(), "");
}

// Sets fields as a reader does, one after the other.
async function set(values) {
    for (const [name, value] of Object.entries(values)) {
        const before = await runs();
        await page.$eval(`#${panel} [name="${name}"]`, (field, value) => {
            if (field.type === "checkbox") field.checked = value;
            else field.value = value;
            field.dispatchEvent(new Event(field.type === "range" ? "input" : "change", { bubbles: true }));
        }, value);
        if (!["cut", "share", "prefix"].includes(name)) await settled(before);
    }
}

async function upload(path) {
    const before = await runs();
    await (await find("[type=file]")).uploadFile(path);
    await settled(before);
}

// The shares of pixels of a canvas by a test of their red, green and blue; in a part of it, in fractions.
const share = (test, [left, top, width, height] = [0, 0, 1, 1]) => page.$eval(`#${panel} .stage canvas`, (canvas, test, part) => {
    const copy = new OffscreenCanvas(canvas.width, canvas.height);
    const context = copy.getContext("2d");
    context.drawImage(canvas, 0, 0);
    const [x, y, w, h] = [part[0] * canvas.width, part[1] * canvas.height, part[2] * canvas.width, part[3] * canvas.height].map(Math.floor);
    const { data } = context.getImageData(x, y, w, h);
    const says = new Function("r", "g", "b", `return ${test}`);
    let count = 0;
    for (let i = 0; i < data.length; i += 4) if (says(data[i], data[i + 1], data[i + 2])) count++;
    return count / (w * h);
}, test, [left, top, width, height]);

// The number of samples that the program on the page makes, by running it in Node.
async function programMakes() {
    await page.$eval(`#${panel} details`, (details) => { details.open = true; });
    await page.select(`#${panel} .code select`, "JavaScript");
    const text = await page.$eval(`#${panel} pre`, (pre) => pre.textContent);
    return number(execFileSync("node", [file(`${panel}.mjs`, text)], { cwd: scratch, encoding: "utf8" }).split(" ")[0]);
}

const isNarrowEnough = async (where) => {
    const [content, width] = await page.evaluate(() => [document.documentElement.scrollWidth, innerWidth]);
    assert.ok(content <= width, `${where}: ${content} pixels wide in a window of ${width}`);
};

const isClean = (found, conflicts = "conflicts") => {
    assert.equal(found[conflicts], "0");
    const gaps = Object.entries(found).filter(([name]) => name.startsWith("gaps"));
    assert.deepEqual(gaps.map(([, value]) => value), ["0"]);
};

const JOBS = {
    async plane() {
        const before = await figures();
        assert.match(before["samples in the plane"], /1\.03 × 10¹¹/);
        assert.match(before["time of this window"], /^[\d.]+ m?s$/);
        const count = number(before["samples in this window"]);
        assert.ok(count > 3000, `${count} samples`);
        assert.equal(await programMakes(), count);
        assert.ok(await share("b > r + 60") > 0.05, "no dots");
        await page.$eval("#plane .stage canvas", (canvas) => canvas.scrollIntoView({ block: "center" }));
        const { x, y, width, height } = await (await find(".stage canvas")).boundingBox();
        const middle = [x + width / 2, y + height / 2];
        let made = await runs();
        await page.mouse.move(...middle);
        await page.mouse.down();
        await page.mouse.move(middle[0] - 80, middle[1] + 40, { steps: 4 });
        await page.mouse.up();
        await settled(made);
        const moved = await figures();
        assert.ok(number(moved["window from"].split(", ")[0]) > number(before["window from"].split(", ")[0]), "dragged to the right");
        made = await runs();
        await page.mouse.wheel({ deltaY: 400 });
        await settled(made);
        assert.ok(number((await figures())["samples in this window"]) > 1.8 * count, "zoomed out");
        // Pinching: two pointers that part zoom in.
        made = await runs();
        const wide = number((await figures())["samples in this window"]);
        await page.$eval("#plane .stage canvas", (canvas) => {
            const { left, top } = canvas.getBoundingClientRect();
            canvas.setPointerCapture = () => {};
            const send = (kind, pointerId, x) => canvas.dispatchEvent(new PointerEvent(kind, { pointerId, clientX: left + x, clientY: top + 100 }));
            send("pointerdown", 1, 100);
            send("pointerdown", 2, 160);
            send("pointermove", 2, 280);
            send("pointerup", 1, 100);
            send("pointerup", 2, 280);
        });
        await settled(made);
        assert.ok(number((await figures())["samples in this window"]) < 0.5 * wide, "pinched");
        // Keys move the focused canvas.
        made = await runs();
        const from = (await figures())["window from"];
        await (await find(".stage canvas")).focus();
        await page.keyboard.press("ArrowUp");
        await settled(made);
        assert.notEqual((await figures())["window from"], from);
        made = await runs();
        await page.click("#plane-fly");
        await page.waitForFunction((count) => Number(document.getElementById("plane").dataset.runs) > count + 2, { timeout: 20_000 }, made);
        await page.click("#plane-fly");
        await settled(made);
        await set({ seed: -1 });
        assert.match(await message(), /^seed: -1 is not a whole number/);
        await set({ seed: 7, x: 0.25, y: -0.5 });
        assert.equal(await message(), "");
    },

    async mesh() {
        isClean(await figures());
        assert.ok(await share("b > r + 60") > 0.01, "no samples are drawn");
        assert.ok(await share("Math.abs(b - r) < 40 && r < 230 && r > 40") > 0.05, "no mesh is drawn");
        const all = number((await figures()).samples);
        // The program reads the mesh that the page has saved.
        await page.click("#mesh .save");
        for (let wait = 0; !existsSync(join(scratch, "knot.obj")) && wait < 200; wait++) await new Promise((resolve) => setTimeout(resolve, 50));
        assert.equal(await programMakes(), all);
        await set({ prefix: 700 });
        await page.waitForFunction(() => [...document.querySelectorAll("#mesh dt")].some((term) => term.textContent === "samples of the prefix"));
        await page.waitForFunction(() => document.getElementById("stop").disabled);
        const prefix = await figures();
        assert.ok(number(prefix["samples of the prefix"]) < all / 4);
        isClean(prefix);
        await set({ by: "count", count: 777 });
        assert.equal((await figures()).samples, "777");
        isClean(await figures());
        await set({ by: "radius", classes: "3" });
        isClean(await figures(), "conflicts, all pairs of classes");
        assert.ok(await share("r > b + 60") > 0.002, "no second class");
        await set({ classes: "1", radius: -1 });
        assert.match(await message(), /^radius: /);
        await upload(CUBE);
        await page.waitForFunction(() => document.querySelector('#mesh [data-name="triangles"]')?.textContent === "12");
        await settled(0);
        isClean(await figures());
        assert.equal(await programMakes(), number((await figures()).samples));
        await upload(BROKEN);
        assert.match(await message(), /broken\.ply/);
        // Long work leaves the page responsive, and is stopped.
        await page.select('#mesh [name="shape"]', "knot");
        await settled(await runs() - 1);
        await page.evaluate(() => {
            const field = document.querySelector('#mesh [name="radius"]');
            field.value = 0.0015;
            field.dispatchEvent(new Event("change", { bubbles: true }));
        });
        // The longest pause of the page within two seconds of work; the machine may be busy with more than this.
        const pause = await page.evaluate(() => new Promise((resolve) => {
            const start = performance.now();
            let [last, longest] = [start, 0];
            const timer = setInterval(() => {
                const now = performance.now();
                [last, longest] = [now, Math.max(longest, now - last)];
                if (now - start > 2000) resolve(longest, clearInterval(timer));
            }, 5);
        }));
        assert.ok(pause < 1000, `a pause of ${pause} ms`);
        assert.equal(await page.$eval("#stop", (button) => button.disabled), false);
        await page.click("#stop");
        await page.waitForFunction(() => document.querySelector("#mesh .message").textContent === "Stopped.");
        await set({ radius: 0.08 });
        assert.equal(await message(), "");
        isClean(await figures());
    },

    async peers() {
        const rows = await page.$$eval("#peers tbody tr", (rows) => rows.map((row) => [...row.cells].map((cell) => cell.textContent)));
        const judged = Object.fromEntries(rows.map(([name, ...rest]) => [name, rest.map(number)]));
        assert.deepEqual(Object.keys(judged), ["azulejo", "Bridson's dart throwing", "Jittered grid", "Best candidate"]);
        const { azulejo, "Bridson's dart throwing": bridson, "Jittered grid": jittered, "Best candidate": best } = judged;
        assert.deepEqual(azulejo.slice(1, 3), [0, 0]);
        assert.ok(bridson[1] === 0 && bridson[2] > 10 && bridson[0] < azulejo[0]);
        assert.ok(jittered[1] > 50 && jittered[2] > 10 && best[1] > 50 && best[2] > 10);
        assert.equal(await programMakes(), azulejo[0]);
        // Gaps are red and conflicts orange, in the pictures of those that have some.
        const isRow = (await page.viewport()).width > 800;
        const place = (k) => (isRow ? [k / 4, 0.15, 0.25, 0.85] : [(k % 2) / 2, Math.floor(k / 2) / 2 + 0.06, 0.5, 0.43]);
        const [red, orange] = ["r > 180 && g < 110 && b < 110", "r > 200 && g > 110 && g < 180 && b < 60"];
        assert.equal(await share(red, place(0)), 0);
        assert.equal(await share(orange, place(0)), 0);
        assert.ok(await share(red, place(1)) > 0 && await share(orange, place(1)) === 0);
        assert.ok(await share(red, place(2)) > 0.002 && await share(orange, place(2)) > 0.01);
        await set({ radius: 0.001 });
        assert.match(await message(), /^radius: /);
        await set({ radius: 0.035 });
    },

    async stipple() {
        assert.equal((await figures()).dots, "6,000");
        assert.ok(await share("r < 100") > 0.1);
        await set({ count: 2500 });
        assert.equal((await figures()).dots, "2,500");
        assert.equal(await programMakes(), 2500);
        await set({ steps: -3 });
        assert.match(await message(), /^maxIterations: -3/);
        await set({ steps: 40 });
        await upload(join(site, "docs/dcr/corners.png"));
        assert.notEqual((await figures()).picture, "360 × 270 pixels");
        await upload(BROKEN);
        assert.match(await message(), /broken\.ply: is no image/);
        await open("stipple");
    },

    async volume() {
        const box = await figures();
        assert.equal(box.conflicts, "0");
        assert.ok(number(box["farthest place, at most"]) <= number(box.radius));
        assert.equal(await programMakes(), number(box.samples));
        const cut = () => page.$eval("#volume", (element) => [element.dataset.cut, element.querySelector("canvas").toDataURL()]);
        const before = await cut();
        await set({ cut: 300 });
        assert.notDeepEqual(await cut(), before);
        await set({ by: "count", count: 500 });
        assert.equal((await figures()).samples, "500");
        await set({ by: "radius", shape: "knot", first: true });
        const knot = await figures();
        assert.equal(knot.conflicts, "0");
        assert.ok(number(knot["of these on the surface"]) > 500 && number(knot.samples) > number(knot["of these on the surface"]));
        assert.ok(await share("r > b + 60") > 0.002, "no samples of the surface");
        await upload(FLAT);
        assert.match(await message(), /^mesh: encloses nothing/);
        // A file that is dropped, instead of chosen.
        const made = await runs();
        await page.$eval("#volume .stage", (stage, text) => {
            const dataTransfer = new DataTransfer();
            dataTransfer.items.add(new File([text], "dropped.off"));
            stage.dispatchEvent(new DragEvent("drop", { dataTransfer, bubbles: true, cancelable: true }));
        }, String(readFileSync(CUBE)));
        await settled(made + 1);
        assert.equal(await message(), "");
        assert.equal((await figures()).conflicts, "0");
        assert.equal(await page.$eval('#volume [name="shape"]', (field) => field.value), "file");
        await set({ shape: "knot" });
    },

    async mask() {
        const found = await figures();
        assert.equal(found["ranks, each once"], "4,096");
        assert.ok(Math.abs(found["mean light of the picture"] - found["mean light, dithered"]) < 0.004);
        assert.ok(await share("r < 20") > 0.03 && await share("r > 235") > 0.2);
        await set({ levels: 4, side: "32" });
        assert.equal((await figures())["ranks, each once"], "1,024");
        const before = await share("r > 15 && r < 25");
        await set({ share: 70 });
        assert.ok(await share("r > 15 && r < 25") > before + 0.01);
        await set({ levels: 1 });
        assert.match(await message(), /^levels: 1 /);
        await set({ levels: 2, side: "64" });
    },
};

try {
    const began = Date.now();
    for (const [size, width, height] of [["wide", 1280, 800], ["narrow", 390, 844]]) {
        await page.setViewport({ width, height });
        for (const [name, job] of Object.entries(JOBS)) {
            await open(name);
            await job();
            await isNarrowEnough(`${size}, ${name}`);
            await page.screenshot({ path: join(pictures, `${size}-${name}.png`), fullPage: true });
        }
        await open("mesh", "dark");
        const ground = await page.evaluate(() => getComputedStyle(document.body).backgroundColor);
        assert.ok(ground.match(/\d+/g).slice(0, 3).every((part) => part < 60), `dark: ${ground}`);
        assert.ok(await share("r < 60 && g < 60 && b < 60") > 0.3, "the drawing is dark, too");
        await page.screenshot({ path: join(pictures, `${size}-dark.png`), fullPage: true });
        await page.emulateMediaFeatures([{ name: "prefers-color-scheme", value: "light" }]);
        for (const name of ["index", "docs/peers", "api", "api/include/azulejo/kdrt.h"]) {
            await page.goto(`${address}/${name}.html`);
            await page.screenshot({ path: join(pictures, `${size}-${name.replaceAll("/", "-")}.png`) });
        }
    }
    // Content that is too wide for a page is so in the narrow window, too.
    for (const path of readdirSync(site, { recursive: true }).filter((path) => /^(?!doc\/).*\.html$/.test(path))) {
        if (path.startsWith("playground")) continue;
        await page.goto(`${address}/${path}`);
        await isNarrowEnough(path);
    }
    // Tabs by keyboard.
    await open("plane");
    await page.focus("#tab-plane");
    await page.keyboard.press("ArrowRight");
    assert.equal(await page.evaluate(() => document.activeElement.id), "tab-mesh");
    assert.equal(await page.$eval("#plane", (element) => element.hidden), true);
    panel = "mesh";
    await settled(0);
    assert.deepEqual(complaints, []);
    console.log(`the site in ${await browser.version()}: ${Object.keys(JOBS).length} panels, wide and narrow, ${Math.round((Date.now() - began) / 1000)} s`);
} catch (error) {
    await page.screenshot({ path: join(pictures, "failure.png"), fullPage: true });
    console.error("console:", complaints);
    throw error;
} finally {
    await browser.close();
    server.close();
}
