#!/usr/bin/env bash
# Measures azulejo's blue-noise masks beside published ones and those of other generators, and writes docs/masks.md with its picture.
# Takes about 10 minutes and 1 GB of disk in target/peers, cargo, node and npm, and packages of the registries of Python, Rust and npm.
# bindings/python/test.sh has to have left a wheel of azulejo.
#
#   studies/peers/masks.sh [--quick]     --quick to see the page, in target/peers, not to believe it
set -euo pipefail
cd "$(dirname "$0")/../.."
. studies/peers/environment.sh

place=target/peers
packages=(numpy==2.4.6 pillow==12.0.0)

page=docs/masks.md
[ "${1:-}" != --quick ] || page=$place/masks.md
environment_with_azulejo $place/mask-python "${packages[@]}"
cargo install --quiet --locked --root $place/cargo blue-noise@0.2.2
npm install --silent --no-save --prefix $place/npm --legacy-peer-deps n8ao@2.1.0 three-gpu-pathtracer@0.0.26
# Its source alone, for the texture in it: to ask for its description leaves that in cargo's folder.
cargo info --quiet bevy_pbr@0.20.1 >/dev/null
find "${CARGO_HOME:-$HOME/.cargo}/registry/cache" -name bevy_pbr-0.20.1.crate -exec tar xzf {} -C $place \;
$place/mask-python/bin/python studies/peers/masks.py --page $page --place $place "$@"
