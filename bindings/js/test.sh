#!/usr/bin/env bash
# The package for npm: built, tested in Node and in headless Chromium; its types, and what is packed.
set -euo pipefail
cd "$(dirname "$0")"

./build.sh
npm ci --silent --ignore-scripts --no-audit --no-fund
node --test test/*.test.js
npx tsc -p .

packed=$(npm pack --dry-run --json --silent | node -p 'JSON.parse(require("fs").readFileSync(0))[0].files.map((file) => file.path).sort().join(" ")')
[ "$packed" = "README.md azulejo.wasm index.d.ts index.js package.json" ] || {
    echo "npm would pack: $packed" >&2
    exit 1
}

if command -v chromium >/dev/null; then
    node page/build.js target/page.html
    node test/page.js "$PWD/target/page.html"
else
    echo "SKIPPED: the page in a browser (no chromium)"
fi
