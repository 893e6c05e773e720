#!/usr/bin/env bash
# Runs the examples with the packages that they are about; downloads some 1 GB. An example whose package cannot be had, or
# not be loaded here, is left out, and so is that in JavaScript where bindings/js/test.sh has left no azulejo.wasm.
set -euo pipefail
cd "$(dirname "$0")"

root=$(cd ../.. && pwd)
work=$root/target/examples
python=$work/bin/python
mkdir -p "$work"

run_python() { # PACKAGE EXAMPLE
    if "$work/bin/pip" install --quiet --disable-pip-version-check "$1" --constraint tools.txt >"$work/said" 2>&1 &&
        "$python" -c "import $1" >"$work/said" 2>&1; then
        "$python" "$2"
    else
        echo "SKIPPED: $2 ($1 cannot be had: $(tail -n 1 "$work/said"))"
    fi
}

[ -e "$python" ] || python3 -m venv "$work"
own=$(../wheel.sh)
if [ -n "$own" ]; then
    "$work/bin/pip" install --quiet --disable-pip-version-check --force-reinstall --no-deps "$own"
    "$work/bin/pip" install --quiet --disable-pip-version-check numpy
    # What trimesh finds neighbours with.
    "$work/bin/pip" install --quiet --disable-pip-version-check scipy --constraint tools.txt
    run_python trimesh trimesh_surface.py
    run_python open3d open3d_cloud.py
    run_python pyvista pyvista_glyphs.py
    run_python mitsuba mitsuba_instances.py
else
    echo "SKIPPED: the examples in Python (bindings/python/test.sh has left no wheel)"
fi

three=three@0.187.0
if [ ! -e "$root/bindings/js/azulejo.wasm" ]; then
    echo "SKIPPED: three_instances.mjs (bindings/js/build.sh has made no azulejo.wasm)"
elif npm install --silent --ignore-scripts --no-audit --no-fund --no-save --prefix "$work" "$three" "$root/bindings/js" >"$work/said" 2>&1; then
    cp three_instances.mjs "$work"
    node "$work/three_instances.mjs"
else
    echo "SKIPPED: three_instances.mjs (three cannot be had: $(tail -n 1 "$work/said"))"
fi
