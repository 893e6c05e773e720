#!/usr/bin/env bash
# Measures azulejo beside what users would pick instead, and writes docs/peers.md. Takes about 20 minutes, 2 GB of disk in
# target/peers, and crates and Python packages from their registries; the Python packages need Debian's libusb-1.0-0,
# libgl1 and libegl1.
#
#   studies/peers/run.sh [MESH]      the mesh to sample; by default the dragon that scripts/demo.sh leaves in out/
set -euo pipefail
cd "$(dirname "$0")/../.."

mesh=${1:-out/dragon.ply}
place=target/peers
packages=(scipy==1.17.1 open3d==0.20.0 pymeshlab==2025.7.post1 point-cloud-utils==0.34.0 libigl==2.6.3 trimesh==5.2.0 fpsample==0.3.3)

[ -f "$mesh" ] || { echo "run.sh: there is no $mesh: run scripts/demo.sh or name a mesh" >&2; exit 1; }
if [ ! -x $place/venv/bin/python ]; then
    python3 -m venv $place/venv
fi
$place/venv/bin/pip install --quiet --disable-pip-version-check "${packages[@]}"
cargo run --quiet --release --locked --manifest-path studies/peers/Cargo.toml --target-dir $place -- \
    all --python $place/venv/bin/python --mesh "$mesh" --page docs/peers.md --packages "${packages[*]}"
