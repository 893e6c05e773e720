#!/usr/bin/env bash
# The package for npm: built, tested in Node, on threads, and in headless Chromium; its types, and what is packed.
#
#   bindings/js/test.sh           without the module with threads, and what npm packs with it; the sums of small sets
#   bindings/js/test.sh --long    as it is published; all sums, also on threads
set -euo pipefail
cd "$(dirname "$0")"

case ${1:-} in
    "") ./build.sh --brief ;;
    --long)
        ./build.sh
        export AZULEJO_LONG=1
        ;;
    *)
        sed -n '/^#   /s/^# *//p' "$0" >&2
        exit 2
        ;;
esac
npm ci --silent --ignore-scripts --no-audit --no-fund
node --test test/*.test.js
npx tsc -p .

if [ ! -e azulejo-threads.wasm ]; then
    echo "SKIPPED: calls on threads, and what npm packs (no azulejo-threads.wasm)"
else
    AZULEJO_THREADS=2 node --test test/{analysis,callbacks,mesh,package}.test.js
    packed=$(npm pack --dry-run --json --silent | node -p 'JSON.parse(require("fs").readFileSync(0))[0].files.map((file) => file.path).sort().join(" ")')
    [ "$packed" = "README.md azulejo-threads.wasm azulejo.wasm index.d.ts index.js package.json pool.js thread.js" ] || {
        echo "npm would pack: $packed" >&2
        exit 1
    }
fi

if command -v chromium >/dev/null; then
    node page/build.js target/page.html
    node test/page.js "$PWD/target/page.html"
else
    echo "SKIPPED: the page in a browser (no chromium)"
fi
