#!/usr/bin/env bash
# Tests the Blender extension: packed, checked and installed as by a user, in Blender as a Python module, without a window.
#
#   integrations/blender/test.sh           all of it; downloads the package bpy, some 350 MB
#   integrations/blender/test.sh --brief   the manifest and that the files compile, in no time
set -euo pipefail
cd "$(dirname "$0")"

root=$(cd ../.. && pwd)
work=$root/target/blender
python=$work/bpy/bin/python

if [ "${1:-}" = --brief ]; then
    python3 pack.py --check azulejo_scatter "$root"
    exit
fi

mkdir -p "$work"
[ -e "$python" ] || python3 -m venv "$work/bpy"
"$work/bpy/bin/pip" install --quiet --disable-pip-version-check --requirement tools.txt >"$work/installed" 2>&1 || {
    cat "$work/installed" >&2
    echo "SKIPPED: the Blender extension in Blender (the package bpy cannot be had for $(python3 --version))"
    exit
}

rm -f "$work"/*.zip
# That of bindings/python/test.sh, or a new one.
./build.sh $(../wheel.sh)
export AZULEJO_EXTENSION=$work/azulejo_scatter-$(sed -n 's/^version = "\(.*\)"/\1/p' azulejo_scatter/blender_manifest.toml).zip
# What `blender --command extension validate` runs.
"$python" "$work"/bpy/lib/python*/site-packages/bpy/*/scripts/addons_core/bl_pkg/cli/blender_ext.py validate "$AZULEJO_EXTENSION"

export BLENDER_USER_RESOURCES=$work/home
rm -rf "$BLENDER_USER_RESOURCES"
mkdir "$BLENDER_USER_RESOURCES"
"$python" -m pytest --quiet --no-header -p no:cacheprovider tests
