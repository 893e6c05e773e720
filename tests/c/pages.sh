#!/usr/bin/env bash
# Compiles and runs the code blocks of the documents against an installed prefix.
#
#   tests/c/pages.sh PREFIX PAGE.md...
#
# Each block marked `c` or `cpp` is a program, or without a main, functions that are only compiled. A block marked
# `sh run` is run as it stands where the programs of examples_c are, with the prefix where pkg-config, CMake and the
# loader look. Other blocks are ignored.
set -euo pipefail

root=$(cd "$(dirname "$0")/../.." && pwd)
prefix=$(cd "${1:?usage: tests/c/pages.sh PREFIX PAGE.md...}" && pwd)
shift
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

. "$root/tests/c/examples.sh"

export PKG_CONFIG_PATH="$prefix/lib/pkgconfig" CMAKE_PREFIX_PATH="$prefix" LD_LIBRARY_PATH="$prefix/lib"
read -ra flags <<<"$(pkg-config --cflags --libs azulejo)"

# Writes the blocks of a page into $work/blocks, as NUMBER.LANGUAGE.
cut_blocks() { # PAGE
    rm -rf "$work/blocks" && mkdir "$work/blocks"
    awk -v folder="$work/blocks" '
        BEGIN { known["c"] = "c"; known["cpp"] = "cpp"; known["sh run"] = "sh" }
        file && $0 == "```" { close(file); file = ""; next }
        file { print >file; next }
        /^```/ && substr($0, 4) in known { file = sprintf("%s/%02d.%s", folder, ++count, known[substr($0, 4)]) }' "$1"
    [ -n "$(ls "$work/blocks")" ]
}

compile() { # FILE ARGUMENT...
    local compiler=(cc -std=c11)
    case $1 in *.cpp) compiler=(c++ -std=c++17) ;; esac
    "${compiler[@]}" -Wall -Wextra -Wpedantic -Werror "$@"
}

try() { # FILE
    case $1 in
        *.sh)
            rm -rf "$work/place" && cp -r "$root/examples_c" "$work/place"
            (cd "$work/place" && bash -euo pipefail -x "$1")
            ;;
        *)
            if grep -q '\<main(' "$1"; then
                compile "$1" -o "$work/program" "${flags[@]}" && "$work/program"
            else
                compile "$1" -c -o "$work/object" "${flags[@]}"
            fi
            ;;
    esac
}

for page; do
    cut_blocks "$page" || { echo "$page has no code" >&2; exit 1; }
    for block in "$work"/blocks/*; do
        step "$(basename "$page"), block $(basename "$block")" try "$block"
    done
done
