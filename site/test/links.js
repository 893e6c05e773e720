// Every local link of the site leads to a file and, where it names one, to an anchor: node test/links.js FOLDER.
import assert from "node:assert/strict";
import { readFile, readdir, stat } from "node:fs/promises";
import { join, posix } from "node:path";

const folder = process.argv[2];
const files = (await readdir(folder, { recursive: true })).map((file) => file.replaceAll("\\", "/"));
// What rustdoc and Doxygen write is theirs to check.
const pages = files.filter((file) => file.endsWith(".html") && !file.startsWith("doc/"));
assert.ok(pages.length > 50, `${pages.length} pages`);

const texts = new Map();
for (const page of pages) texts.set(page, String(await readFile(join(folder, page))));
const ids = new Map([...texts].map(([page, text]) => [page, [...text.matchAll(/\sid="([^"]*)"/g)].map(([, id]) => id)]));
const decoded = (text) => decodeURIComponent(text.replace(/&amp;/g, "&"));

const broken = [];
let count = 0;
for (const [page, text] of texts) {
    const twice = ids.get(page).filter((id, i, all) => all.indexOf(id) !== i);
    if (twice.length > 0) broken.push(`${page}: the id ${twice[0]} occurs twice`);
    if (!/<title>[^<]+<\/title>/.test(text) || !/<h1/.test(text)) broken.push(`${page}: has no title`);
    for (const [, link] of text.matchAll(/\s(?:href|src)="([^"]*)"/g)) {
        if (/^(https?|mailto|data):/.test(link)) continue;
        count++;
        const [path, anchor] = link.split("#").map(decoded);
        const target = path === "" ? page : posix.normalize(posix.join(posix.dirname(page), path));
        const info = await stat(join(folder, target)).catch(() => null);
        if (target.startsWith("..") || !info?.isFile()) broken.push(`${page}: no ${link}`);
        else if (anchor && texts.has(target) && !ids.get(target).includes(anchor)) broken.push(`${page}: no anchor ${link}`);
    }
    // Links may lead elsewhere, but nothing is loaded from there.
    for (const [, link] of text.matchAll(/<(?:script|img|link rel="stylesheet")[^>]*\s(?:src|href)="(https?:[^"]*)"/g)) {
        broken.push(`${page}: loads ${link}`);
    }
}
assert.deepEqual(broken, []);
console.log(`${pages.length} pages, ${count} local links`);
