// Renders the site: node site/build.js OUT, from the root of the repository. Guides and design documents become pages, headers and
// types pages with an anchor for each declaration, and every other file of the repository that a page links to a page with
// its text. site/build.sh adds the playground.
import { execFileSync } from "node:child_process";
import { cp, mkdir, readFile, stat, writeFile } from "node:fs/promises";
import { existsSync } from "node:fs";
import { dirname, extname, join, posix } from "node:path";
import markdown from "markdown-it";

const out = process.argv[2];
const tracked = new Set(execFileSync("git", ["ls-files"], { encoding: "utf8", maxBuffer: 1 << 26 }).split("\n").filter(Boolean));
const isFolder = (path) => [...tracked].some((file) => file.startsWith(`${path}/`));

const GUIDES = [
    ["README.md", "Overview"], ["docs/integrating.md", "Integrating azulejo into a program"],
    ["docs/porting.md", "Porting from other libraries"], ["docs/options.md", "All options"],
    ["bindings/python/README.md", "The Python package"], ["bindings/js/README.md", "The JavaScript package"],
];
const MEASURED = [
    "docs/peers.md", "docs/kdrt.md", "docs/psp.md", "docs/dcr.md", "docs/classes.md", "docs/order.md",
    "docs/gallery.md", "docs/pixels.md", "docs/goals.md", "docs/volume.md",
    "docs/rendering.md", "docs/masks.md", "docs/learning.md",
];
const HEADERS = [...tracked].filter((file) => /^include\/.*\.(h|hpp)$/.test(file)).sort();
const TYPES = ["bindings/python/azulejo.pyi", "bindings/js/index.d.ts"];

// The page of a file of the repository. Markdown and interfaces have the path of the file, other texts one below source/.
function pageOf(path) {
    if (path.endsWith(".md")) return path.replace(/\.md$/, ".html");
    if (HEADERS.includes(path) || TYPES.includes(path)) return `api/${path}.html`;
    return `source/${path}.html`;
}

const escape = (text) => text.replace(/[&<>"]/g, (c) => ({ "&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;" })[c]);
const written = new Set();
const wanted = []; // files of the repository that pages link to

function shell(path, title, body, section) {
    const up = posix.relative(posix.dirname(path), ".") || ".";
    const link = (to, name) => `<a href="${up}/${to}"${section === name ? ' aria-current="page"' : ""}>${name}</a>`;
    return `<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>${escape(title)} · azulejo</title>
<link rel="icon" href="data:,">
<link rel="stylesheet" href="${up}/style.css">
</head>
<body>
<a class="skip" href="#main">To the text</a>
<header>
    <a class="brand" href="${up}/index.html">azulejo</a>
    <nav aria-label="Site">
        ${link("docs/peers.html", "Benchmarks")}
        ${link("playground/index.html", "Playground")}
        ${link("guides.html", "Guides")}
        ${link("api.html", "API")}
    </nav>
</header>
<main id="main" tabindex="-1">
${body}
</main>
</body>
</html>
`;
}

async function put(path, text) {
    written.add(path);
    await mkdir(dirname(join(out, path)), { recursive: true });
    await writeFile(join(out, path), text);
}

// The anchor of a heading, as GitHub makes it.
function slugs() {
    const taken = new Map();
    return (text) => {
        const slug = text.trim().toLowerCase().replace(/[^\p{L}\p{N}\p{M} _-]/gu, "").replace(/ /g, "-");
        const count = taken.get(slug) ?? 0;
        taken.set(slug, count + 1);
        return count === 0 ? slug : `${slug}-${count}`;
    };
}

// Where a link of a file leads on the site.
function resolve(from, href) {
    if (/^[a-z]+:/.test(href) || href.startsWith("#")) return href;
    const [target, anchor] = href.split("#");
    const path = posix.normalize(posix.join(posix.dirname(from), decodeURI(target))).replace(/\/$/, "");
    if (/\.(png|svg|jpg)$/.test(path)) {
        wanted.push(path);
        return posix.relative(posix.dirname(pageOf(from)), path);
    }
    const page = isFolder(path) ? `source/${path}/index.html` : pageOf(path);
    if (tracked.has(path) || isFolder(path)) wanted.push(path);
    const here = posix.relative(posix.dirname(pageOf(from)), page);
    return anchor ? `${here}#${anchor}` : here;
}

function render(from, text) {
    const md = markdown({ html: true, linkify: false });
    const slug = slugs();
    const headings = [];
    md.core.ruler.push("site", ({ tokens }) => {
        for (const [i, token] of tokens.entries()) {
            if (token.type === "heading_open") {
                const text = tokens[i + 1].children.filter(({ type }) => type !== "link_open").map(({ content }) => content).join("");
                const id = slug(text);
                token.attrSet("id", id);
                headings.push({ level: Number(token.tag[1]), id, text });
            }
            for (const child of token.children ?? []) {
                for (const name of ["href", "src"]) {
                    const value = child.attrGet(name);
                    if (value !== null) child.attrSet(name, resolve(from, value));
                }
                if (child.type === "image") child.attrSet("loading", "lazy");
            }
        }
    });
    const { rules } = md.renderer;
    rules.table_open = () => '<div class="scroll" tabindex="0" role="region" aria-label="Table"><table>';
    rules.table_close = () => "</table></div>";
    rules.heading_close = (tokens, i) => {
        const id = tokens[i - 2].attrGet("id");
        if (tokens[i].tag === "h1") return "</h1>\n";
        return `<a class="anchor" href="#${id}" aria-label="Link to this section">#</a></${tokens[i].tag}>\n`;
    };
    // Lines of Rust programs that begin with # are hidden, as rustdoc does.
    const fence = rules.fence;
    rules.fence = (tokens, i, ...rest) => {
        if (tokens[i].info.startsWith("rust")) tokens[i].content = tokens[i].content.replace(/^# .*\n/gm, "");
        return fence(tokens, i, ...rest).replace("<pre>", '<pre tabindex="0">');
    };
    return { html: md.render(text), headings };
}

async function markdownPage(path) {
    const text = String(await readFile(path));
    const { html, headings } = render(path, text);
    const title = headings.find(({ level }) => level === 1)?.text ?? path;
    const parts = headings.filter(({ level }) => level === 2);
    const within = parts.length < 4 ? "" : `<nav class="within" aria-label="On this page"><ul>${parts
        .map(({ id, text }) => `<li><a href="#${id}">${escape(text)}</a></li>`).join("")}</ul></nav>`;
    const body = within ? html.replace("</h1>\n", `</h1>\n${within}\n`) : html;
    await put(pageOf(path), shell(pageOf(path), title, body, path === "docs/peers.md" ? "Benchmarks" : "Guides"));
    return title;
}

// The names that a line of an interface declares.
const DECLARES = {
    ".h": [/^(?:typedef .*|[a-z_][\w *]*)\b(azulejo_\w+)\(/, /^} (azulejo_\w+);/, /^typedef [^({]*\b(azulejo_\w+);/, /^#define (AZULEJO_(?!\w+_H$)\w+)/, /^typedef .*\(\*(azulejo_\w+)\)/],
    ".hpp": [/^(?:class|struct) (\w+)(?! *;)/, /^using (\w+) =/, /^(?:inline|template).*?\b(\w+)\(/],
    ".pyi": [/^class (\w+)/, /^def (\w+)/],
    ".ts": [/^(?:export |declare )+(?:function|class|interface|type) (\w+)/],
};

// Interfaces: an anchor for each declaration, an index of them, and C names linked to where they are declared.
async function interfaces() {
    const places = new Map();
    const found = new Map();
    for (const path of [...HEADERS, ...TYPES]) {
        const lines = String(await readFile(path)).split("\n");
        const names = lines.map((line) => {
            for (const pattern of DECLARES[extname(path)]) {
                const name = pattern.exec(line)?.[1];
                if (name) return name;
            }
            return null;
        });
        // The first of several declarations of a name, such as overloads, has the anchor.
        const first = names.map((name, i) => (name && names.indexOf(name) === i ? name : null));
        found.set(path, { lines, names: first });
        if (path.endsWith(".h")) for (const name of first) if (name) places.set(name, `${pageOf(path)}#${name}`);
    }
    for (const [path, { lines, names }] of found) {
        const page = pageOf(path);
        const linked = (text, own) => escape(text).replace(/\b(?:azulejo_|AZULEJO_)\w+/g, (name) => (
            places.has(name) && name !== own ? `<a href="${posix.relative(posix.dirname(page), places.get(name))}">${name}</a>` : name
        ));
        const rows = lines.map((line, i) => {
            const isComment = /^\s*(\/\/|\/?\*|#(?!define|include|if|endif))/.test(line) && !line.includes("#define");
            let text = linked(line, names[i]);
            if (names[i]) text = text.replace(names[i], `<span id="${names[i]}">${names[i]}</span>`);
            return isComment ? `<span class="c">${text}</span>` : text;
        });
        const index = names.filter(Boolean).map((name) => `<li><a href="#${name}"><code>${name}</code></a></li>`).join("\n");
        const body = `<h1><code>${path}</code></h1>\n${index ? `<h2>Declarations</h2>\n<ul class="index">\n${index}\n</ul>` : ""}\n`
            + `<h2>Text</h2>\n<pre tabindex="0">${rows.join("\n")}</pre>`;
        await put(page, shell(page, path, body, "API"));
    }
}

async function sourcePage(path) {
    if (isFolder(path)) {
        const page = `source/${path}/index.html`;
        const files = [...tracked].filter((file) => file.startsWith(`${path}/`));
        const items = files.map((file) => {
            const isText = /\.(rs|c|cpp|h|hpp|py|pyi|js|ts|sh|toml|txt|md|cmake|in|yml|html|css|json)$/.test(file);
            if (!isText) return `<li><code>${file}</code></li>`;
            wanted.push(file);
            return `<li><a href="${posix.relative(posix.dirname(page), pageOf(file))}"><code>${file}</code></a></li>`;
        });
        await put(page, shell(page, path, `<h1><code>${path}/</code></h1>\n<ul>${items.join("\n")}</ul>`, "Guides"));
    } else {
        const text = escape(String(await readFile(path)));
        await put(pageOf(path), shell(pageOf(path), path, `<h1><code>${path}</code></h1>\n<pre tabindex="0">${text}</pre>`, "Guides"));
    }
}

const titles = new Map();
for (const path of [...tracked].filter((file) => /^(docs\/.*|bindings\/\w+\/README|[A-Z]+)\.md$/.test(file))) {
    titles.set(path, await markdownPage(path));
}
await interfaces();

const link = (path, name = titles.get(path)) => `<li><a href="${pageOf(path)}">${escape(name)}</a></li>`;
const design = [...titles.keys()].filter((path) => path.startsWith("docs/design/"));
await put("guides.html", shell("guides.html", "Guides", `<h1>Guides</h1>
<h2>Using it</h2><ul>${GUIDES.map(([path, name]) => link(path, name)).join("")}</ul>
<h2>Measured</h2><ul>${MEASURED.map((path) => link(path)).join("")}</ul>
<h2>How it works</h2><ul>${link("ARCHITECTURE.md")}${design.map((path) => link(path)).join("")}</ul>
<h2>The project</h2><ul>${["CHANGELOG.md", "CONTRIBUTING.md", "SECURITY.md"].map((path) => link(path)).join("")}</ul>`, "Guides"));

// What scripts/docs.sh has built, if it has.
const built = [["doc/azulejo", "The Rust crate: rustdoc"], ["doc/c", "The C interface: Doxygen"]]
    .map(([folder, name]) => [[`${folder}/index.html`, `${folder}/html/index.html`].find((page) => existsSync(join("target", page))), name])
    .filter(([page]) => page);
if (built.length > 0) await cp("target/doc", join(out, "doc"), { recursive: true });
const api = `<h1>API</h1>
<p>All languages have the same calls with the same options: <a href="docs/options.html">all options</a>.</p>
<h2>C</h2><ul>${HEADERS.filter((path) => path.endsWith(".h")).map((path) => link(path, path)).join("")}</ul>
<h2>C++</h2><ul>${HEADERS.filter((path) => path.endsWith(".hpp")).map((path) => link(path, path)).join("")}</ul>
<h2>Python</h2><ul>${link(TYPES[0], "azulejo.pyi")}${link("bindings/python/README.md", "The package")}</ul>
<h2>JavaScript</h2><ul>${link(TYPES[1], "index.d.ts")}${link("bindings/js/README.md", "The package")}</ul>
<h2>Rust</h2>
${built.length > 0 ? `<ul>${built.map(([page, name]) => `<li><a href="${page}">${name}</a></li>`).join("")}</ul>`
        : "<p>Built by <code>scripts/docs.sh</code>, before the site; this site was built without.</p>"}`;
await put("api.html", shell("api.html", "API", api, "API"));

// The front page: where to go, and the README.
const readme = render("README.md", String(await readFile("README.md"))).html;
const cards = `<ul class="cards">
<li><a href="docs/peers.html">Benchmarks</a><p>Times, memory, conflicts and gaps beside other libraries, and where a peer is better.</p></li>
<li><a href="playground/index.html">Playground</a><p>A plane of 10<sup>11</sup> samples, meshes, volumes, stipples and masks in this browser, with their proof.</p></li>
<li><a href="docs/integrating.html">Integrating</a><p>Building azulejo into a program, a plug-in or a job.</p></li>
<li><a href="api.html">API</a><p>C, C++, Python, JavaScript and Rust; <a href="docs/options.html">all options</a>.</p></li>
</ul>`;
await put("index.html", shell("index.html", "Blue-noise sampling", readme.replace("</h1>\n", `</h1>\n${cards}\n`), "Overview"));

// What pages link to, and what that links to.
const done = new Set();
for (let i = 0; i < wanted.length; i++) {
    const path = wanted[i];
    if (done.has(path)) continue;
    done.add(path);
    if (/\.(png|svg|jpg)$/.test(path)) {
        await mkdir(dirname(join(out, path)), { recursive: true });
        await cp(path, join(out, path));
    } else if (isFolder(path)) {
        await sourcePage(path);
    } else if (!written.has(pageOf(path))) {
        await (path.endsWith(".md") ? markdownPage(path) : sourcePage(path));
    }
}
await cp("site/style.css", join(out, "style.css"));
const bytes = await Promise.all([...written].map(async (page) => (await stat(join(out, page))).size));
console.log(`${written.size} pages, ${Math.round(bytes.reduce((sum, n) => sum + n, 0) / 1024)} KB`);
