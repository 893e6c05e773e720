// The page in headless Chromium: node test/page.js PAGE. What it measures, what it draws, and that the console is silent; and
// threads in a page that is isolated (isolated.html).
import assert from "node:assert/strict";
import { existsSync } from "node:fs";
import { fileURLToPath, pathToFileURL } from "node:url";
import puppeteer from "puppeteer-core";
import { serve } from "../../../site/serve.js";

const browser = await puppeteer.launch({
    executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
    args: ["--no-sandbox", "--disable-gpu"],
});
try {
    const page = await browser.newPage();
    const complaints = [];
    page.on("console", (message) => complaints.push(message.text()));
    page.on("pageerror", (error) => complaints.push(String(error)));
    // What the page leaves in window.finished, which it gets to without complaints.
    const shown = async (address) => {
        complaints.length = 0;
        await page.goto(address);
        const finished = page.waitForFunction("window.finished", { timeout: 60_000 });
        await finished.catch((error) => complaints.push(String(error)));
        assert.deepEqual(complaints, []);
        return page.evaluate("window.finished");
    };
    const { radius, smallestDistance, rho, low } = await shown(pathToFileURL(process.argv[2]).href);
    assert.ok(smallestDistance > 1.05 * radius, `smallest distance ${smallestDistance} of radius ${radius}`);
    assert.ok(rho > 0.8 && rho <= 1, `rho ${rho}`);
    assert.ok(low < 0.05, `power of low frequencies ${low}`);
    // The share of dark pixels, and how bright the middle and a corner of the spectrum are.
    const [dark, middle, corner] = await page.evaluate(() => {
        const mean = (id, x, y, size) => {
            const { data } = document.getElementById(id).getContext("2d").getImageData(x, y, size, size);
            return data.filter((_, i) => i % 4 === 0).reduce((sum, value) => sum + value, 0) / (size * size * 255);
        };
        return [1 - mean("set", 0, 0, 800), mean("power", 118, 118, 20), mean("power", 0, 0, 40)];
    });
    assert.ok(dark > 0.04 && dark < 0.12, `dark ${dark}`);
    assert.ok(middle < 0.05 && corner > 0.2, `spectrum ${middle} ${corner}`);
    if (existsSync(new URL("../azulejo-threads.wasm", import.meta.url))) {
        const { server, address } = await serve(fileURLToPath(new URL("..", import.meta.url)));
        const { refusal, ...others } = await shown(`${address}/test/isolated.html`);
        assert.match(refusal, /^threads: the main thread of a page may not wait/);
        assert.deepEqual(others, { isIsolated: true, threads: 2, isEqual: true });
        server.close();
        server.closeAllConnections();
    }
    console.log(`the page: rho ${rho.toFixed(3)}, low frequencies ${low.toFixed(4)}, in ${await browser.version()}`);
} finally {
    await browser.close();
}
