#!/usr/bin/env bash
# Copies what cargo has compiled of packages of the registry into another target folder, where the same compiler need not
# compile them again: scripts/share-packages.sh FROM TO, two folders of a profile, such as target/debug.
#
# What belongs to the workspace is left out: it depends on the Embree that is installed where it is built. Nothing is
# copied over what is there, nor where the C library is too old for what was linked with the other one.
set -euo pipefail

[ $# = 2 ] || { sed -n '3s/.*\(scripts[^,]*\),.*/\1/p' "$0" >&2 && exit 2; }
from=$1
to=$2
[ -d "$from/deps" ] && [ ! -e "$to/deps" ] || exit 0
for macro in "$from"/deps/lib*.so; do
    ! ldd "$macro" 2>&1 | grep -q "version .GLIBC.* not found" || exit 0
done

workspace=(! -name '*azulejo*' ! -name '*embree4*')
copy() { # FOLDER FIND-TEST...
    mkdir -p "$to/$1"
    find "$from/$1" -mindepth 1 -maxdepth 1 "${workspace[@]}" "${@:2}" -exec cp -a --reflink=auto -t "$to/$1" {} +
}
copy .fingerprint
copy build
copy deps -name 'lib*'
