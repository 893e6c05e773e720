#!/usr/bin/env bash
# Measures sets in space, those of azulejo and those of others, and writes docs/volume.md with its picture. Takes about 20
# minutes, 5 GB of disk in target/peers, and crates and Python packages from their registries; the Python packages need
# Debian's libgl1, libegl1 and libx11-6. bindings/python/test.sh has to have left a wheel of azulejo.
#
#   studies/peers/volume.sh BUNNY [OPTION...]     a mesh, and options of `azulejo-studies volume`
#
# tph_poisson is in no registry: it is left out unless TPH names a folder with its header, thinks/tph_poisson.h.
set -euo pipefail
cd "$(dirname "$0")/../.."
. studies/peers/environment.sh

place=target/peers
packages=(scipy==1.17.1 open3d==0.20.0 point-cloud-utils==0.34.0 trimesh==5.2.0 rtree==1.4.1 pysplishsplash==2.19.0)

[ $# -gt 0 ] && [ -f "$1" ] || { echo "volume.sh: name a mesh, the Stanford bunny" >&2; exit 1; }
mesh=$1
shift
environment_with_azulejo $place/venv "${packages[@]}"
cargo build --quiet --release --locked --manifest-path studies/peers/Cargo.toml --target-dir $place
options=(--peers $place/release/peers --python $place/venv/bin/python --bunny "$mesh")
if [ -n "${TPH:-}" ]; then
    cc -O3 -march=native -DNDEBUG -I "$TPH" studies/peers/tph.c -o $place/tph -lm
    options+=(--tph $place/tph)
fi
cargo run --quiet --release --locked -p azulejo-studies -- volume "${options[@]}" "$@"
