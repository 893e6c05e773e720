#!/usr/bin/env bash
# Times clouds of a thousand small meshes, those of azulejo and those of others, and writes docs/learning.md. Takes some minutes,
# 5 GB of disk in target/peers, and Python packages from their registry, which need Debian's libgl1 and libegl1.
# bindings/python/test.sh has to have left a wheel of azulejo.
#
#   studies/peers/learning.sh [--quick]     --quick to see the page, in target/peers, not to believe it
set -euo pipefail
cd "$(dirname "$0")/../.."
. studies/peers/environment.sh

place=target/peers
packages=(scipy==1.17.1 open3d==0.20.0 trimesh==5.2.0 rtree==1.4.1 fpsample==1.0.2)

page=docs/learning.md
[ "${1:-}" != --quick ] || page=$place/learning.md
environment_with_azulejo $place/venv "${packages[@]}"
$place/venv/bin/python studies/peers/learning.py --page $page "$@"
