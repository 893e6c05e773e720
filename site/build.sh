#!/usr/bin/env bash
# Builds the site into target/site: guides, benchmarks, interfaces and the playground, all of it static and local. What
# scripts/docs.sh has built is taken along. Look at it with `node site/serve.js target/site 8000`: modules need a server.
#
#   site/build.sh             also builds the modules of bindings/js
#   site/build.sh --built     takes those that are there
set -euo pipefail
cd "$(dirname "$0")/.."

case ${1:-} in
    "") bindings/js/build.sh ;;
    --built) [ -e bindings/js/azulejo.wasm ] || bindings/js/build.sh ;;
    *)
        sed -n '/^#   /s/^# *//p' "$0" >&2
        exit 2
        ;;
esac
[ site/node_modules/.package-lock.json -nt site/package-lock.json ] || npm ci --prefix site --silent --ignore-scripts --no-audit --no-fund

rm -rf target/site
mkdir -p target/site
node site/build.js target/site
cp -r site/playground target/site/
mkdir target/site/playground/azulejo
cp bindings/js/{index,pool,thread}.js bindings/js/*.wasm target/site/playground/azulejo/
