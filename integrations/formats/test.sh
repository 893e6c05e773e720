#!/usr/bin/env bash
# Scenes that the command line writes, read by those whose formats they are: USD by Pixar's library, glTF by Khronos' validator.
# Each is asked for damaged files, too, which it must refuse.
#
#   integrations/formats/test.sh    with the azulejo that the Rust tests have left in target/debug, or that AZULEJO names
set -euo pipefail
cd "$(dirname "$0")"

root=$(cd ../.. && pwd)
work=$root/target/formats
azulejo=${AZULEJO:-$root/target/debug/azulejo}
mkdir -p "$work"
[ -e "$azulejo" ] || cargo build --quiet --locked --manifest-path "$root/Cargo.toml" --package azulejo-cli --target-dir "$root/target"

write() { # NAME.EXTENSION FORMAT COMMAND ARGUMENT...: the scene, and the same samples as CSV
    "$azulejo" "${@:3}" --output "$work/$1" --format "$2" >/dev/null
    "$azulejo" "${@:3}" --output "$work/${1%.*}.csv" --format csv >/dev/null
}

rm -f "$work"/*.usda "$work"/*.glb "$work"/*.csv
printf 'v 0 0 0\nv 1 0 0\nv 1 1 .3\nv 0 1 0\nf 1 2 3\nf 1 3 4\n' >"$work/roof.obj"
write points.usda usda surface "$work/roof.obj" --radius 0.08 --order progressive
write instances.usda usda-instances plane --classes 0.05,0.1
write volume.glb glb volume --radius 0.2
write classes.glb glb surface "$work/roof.obj" --classes 0.08,0.2

[ -e "$work/tools/bin/python" ] || python3 -m venv "$work/tools"
"$work/tools/bin/pip" install --quiet --disable-pip-version-check --requirement tools.txt numpy \
    --constraint "$root/bindings/python/tools.txt"
"$work/tools/bin/python" usd.py "$work"

cp package.json package-lock.json "$work"
npm ci --silent --ignore-scripts --no-audit --no-fund --prefix "$work"
node gltf.mjs "$work"
