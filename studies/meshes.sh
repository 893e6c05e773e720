#!/usr/bin/env bash
# Fetches scanned meshes for the pages of docs/ from Debian's package libcgal-demo, and writes them to out/ as OBJ files:
# the Stanford armadillo (52,000 triangles) and an elephant (88,928). scripts/demo.sh leaves the Stanford dragon there.
#
#   studies/meshes.sh
#   cargo run --release -p azulejo-studies -- psp --dragon out/dragon.ply --mesh out/armadillo.obj --mesh out/elephant.obj
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
mkdir -p "$root/out"
cd "$scratch"

apt-get -qq download libcgal-demo 2>log || {
    cat log >&2
    exit 1
}
dpkg-deb -x libcgal-demo_*.deb .
tar -xzf usr/share/doc/libcgal-dev/data.tar.gz

# An OFF file as an OBJ file: its vertices are numbered from one.
convert() { # OFF OBJ
    awk '/^#/ || NF == 0 || /OFF/ { next }
        !vertices { vertices = $1; next }
        vertex < vertices { print "v", $1, $2, $3; vertex++; next }
        { printf "f"; for (i = 2; i <= $1 + 1; i++) printf " %d", $i + 1; print "" }' "data/meshes/$1" >"$root/out/$2"
}
convert armadillo.off armadillo.obj
convert refined_elephant.off elephant.obj
