#!/usr/bin/env bash
# Renders depth of field, soft shadows and motion blur in Mitsuba by azulejo's sets and by what renderers sample with, and
# writes docs/rendering.md with its picture. Takes about 15 minutes, 1 GB of disk in target/peers, and Python packages from
# their registry. bindings/python/test.sh has to have left a wheel of azulejo.
#
#   studies/peers/render.sh [--quick]     --quick to see the page, in target/peers, not to believe it
set -euo pipefail
cd "$(dirname "$0")/../.."
. studies/peers/environment.sh

place=target/peers
packages=(mitsuba==3.9.1 scipy==1.17.1 pillow==12.0.0)

page=docs/rendering.md
[ "${1:-}" != --quick ] || page=$place/rendering.md
environment_with_azulejo $place/mitsuba "${packages[@]}"
# LLVM 15 does not compile Mitsuba's kernels; that of Rust does, and is there.
export DRJIT_LIBLLVM_PATH=${DRJIT_LIBLLVM_PATH:-$(find "$(rustc --print sysroot)/lib" -name 'libLLVM.so.*' -print -quit)}
$place/mitsuba/bin/python studies/peers/check_render.py
$place/mitsuba/bin/python studies/peers/render.py --page $page "$@"
