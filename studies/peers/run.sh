#!/usr/bin/env bash
# Measures azulejo beside what users would pick instead, and writes docs/peers.md. Takes about 30 minutes, 5 GB of disk in
# target/peers, and crates and Python packages from their registries; the Python packages need Debian's libusb-1.0-0,
# libgl1 and libegl1.
#
#   studies/peers/run.sh [MESH]      the mesh to sample; by default the dragon that scripts/demo.sh leaves in out/
set -euo pipefail
cd "$(dirname "$0")/../.."
. studies/peers/environment.sh

mesh=${1:-out/dragon.ply}
place=target/peers
packages=(scipy==1.17.1 open3d==0.20.0 pymeshlab==2025.7.post1 point-cloud-utils==0.34.0 libigl==2.6.3 trimesh==5.2.0 \
    fpsample==1.0.2 blue-sampler==3.0.0)
# By itself, since it needs an older numpy.
blender=bpy==5.0.1

[ -f "$mesh" ] || { echo "run.sh: there is no $mesh: run scripts/demo.sh or name a mesh" >&2; exit 1; }
for library in libusb-1.0.so.0 libGL.so.1 libEGL.so.1; do
    /sbin/ldconfig -p | grep "$library" >/dev/null || {
        echo "run.sh: there is no $library: install libusb-1.0-0, libgl1 and libegl1" >&2
        exit 1
    }
done
environment $place/venv "${packages[@]}"
# A Python that Blender is not made for has no such package: its rows then say so.
environment $place/blender $blender || echo "run.sh: no Blender for this Python" >&2
cargo run --quiet --release --locked --manifest-path studies/peers/Cargo.toml --target-dir $place -- \
    all --python $place/venv/bin/python --blender $place/blender/bin/python --mesh "$mesh" --page docs/peers.md \
    --packages "${packages[*]} $blender"
