#!/usr/bin/env bash
# Compiles and runs the C and C++ code blocks of README.md against an installed prefix.
#
#   tests/c/readme.sh PREFIX
set -euo pipefail
cd "$(dirname "$0")/../.."

prefix=$(cd "${1:?usage: tests/c/readme.sh PREFIX}" && pwd)
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
export PKG_CONFIG_PATH="$prefix/lib/pkgconfig"
read -ra flags <<<"$(pkg-config --cflags --libs azulejo)"

# run LANGUAGE COMPILER.. : the only block of that language becomes a program.
run() {
    local language=$1 source="$scratch/readme.$1"
    shift
    awk -v fence='```'"$language" '$0 == fence { inside = 1; next } $0 == "```" { inside = 0 } inside' README.md >"$source"
    [[ -s $source ]] || { echo "README.md has no $language block" >&2; exit 1; }
    "$@" -Wall -Wextra -Wpedantic -Werror "$source" -o "$scratch/readme" "${flags[@]}" -Wl,-rpath,"$prefix/lib"
    "$scratch/readme"
}

run c cc -std=c11
run cpp c++ -std=c++17
echo "2 passed, 0 failed"
