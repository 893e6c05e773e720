#!/usr/bin/env bash
# Installs one of the things that are published in an environment of its own, samples the Stanford dragon with it, and compares the
# samples with packaging/installed/sum.txt: they have the same bytes in every language.
#
#   packaging/installed.sh KIND DRAGON.ply FOLDER
#
# FOLDER has the packages: KIND is wheel, sdist (Python), npm, crates (the command line), source (with its crates) or debs, which
# are installed in the system. Nothing of the project is used but packaging/installed. .github/workflows/release.yml runs it in
# containers that have nothing of azulejo: of Python, Node, Rust, Debian.
set -euo pipefail

[ $# = 3 ] || { sed -n '/^#   packaging/s/^# *//p' "$0" >&2; exit 2; }
kind=$1
dragon=$(realpath "$2")
folder=$(realpath "$3")
programs=$(cd "$(dirname "$0")/installed" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
radius=0.002
seed=4

die() {
    echo "installed.sh: $*" >&2
    exit 1
}

# PATTERN: the one file of the folder with such a name.
file() {
    local found
    mapfile -t found < <(find "$folder" -name "$1")
    [ ${#found[@]} = 1 ] || die "$folder has ${#found[@]} files named $1"
    echo "${found[0]}"
}

# PROGRAM...: what it writes are the samples.
sample() {
    local found expected
    "$@" "$dragon" $radius $seed "$work/samples"
    found=$(sha256sum <"$work/samples")
    expected=$(cat "$programs/sum.txt")
    [ "${found%% *}" = "$expected" ] || die "$kind: samples have the sum ${found%% *}, not $expected"
    echo "$kind: $(($(stat -c %s "$work/samples") / 12)) samples of the dragon, as everywhere"
}

# PACKAGE: a wheel, or a source distribution that pip compiles.
python_package() {
    python3 -m venv "$work/clean"
    "$work/clean/bin/pip" install --quiet --disable-pip-version-check "$1"
    sample "$work/clean/bin/python" "$programs/dragon.py"
}

npm_package() {
    mkdir "$work/clean"
    cp "$programs/dragon.mjs" "$work/clean"
    npm install --silent --ignore-scripts --no-audit --no-fund --prefix "$work/clean" "$(file 'azulejo-*.tgz')"
    sample node "$work/clean/dragon.mjs"
}

# The positions are the first columns of a table, whose decimals are those of the floats.
command_line() {
    "$work/clean/bin/azulejo" surface "$1" --radius "$2" --seed "$3" --output "$work/samples.csv"
    perl -F, -ane 'print pack "f<3", @F if $. > 1' "$work/samples.csv" >"$4"
}

# The registry has no crate of this version yet: they come from each other.
crates() {
    local crate patches=() name
    for crate in azulejo azulejo-embree-sys azulejo-cli; do
        tar -xzf "$(file "$crate-[0-9]*.crate")" -C "$work"
        name=$(basename "$work/$crate"-[0-9]*)
        [ $crate = azulejo-cli ] || patches+=(--config "patch.crates-io.$crate.path = \"$work/$name\"")
    done
    CARGO_TARGET_DIR=$work/cargo cargo install --quiet --no-default-features --root "$work/clean" "${patches[@]}" --path "$work/$name"
    sample command_line
}

# PREFIX: a program finds the library there, or in the system.
c_library() {
    cmake -S "$programs" -B "$work/use" -D CMAKE_PREFIX_PATH="$1" >/dev/null
    cmake --build "$work/use" >/dev/null
    sample "$work/use/shared"
    sample "$work/use/static"
}

source_with_crates() {
    tar -xf "$(file 'azulejo-*.tar.gz')" -C "$work"
    cmake -S "$work"/azulejo-[0-9]* -B "$work/build" -D AZULEJO_EMBREE=OFF -D AZULEJO_CARGO_FLAGS=--locked \
        -D CMAKE_INSTALL_PREFIX="$work/prefix" >/dev/null
    cmake --build "$work/build" >/dev/null
    cmake --install "$work/build" >/dev/null
    c_library "$work/prefix"
}

debs() {
    apt-get update -qq
    # Without those of debugging information, which the library does not need.
    apt-get install -qq --no-install-recommends -o Acquire::Retries=3 "$(file 'libazulejo[0-9]*[0-9]_[0-9]*.deb')" \
        "$(file 'libazulejo-dev_*.deb')" >/dev/null
    c_library ""
}

case $kind in
    wheel) python_package "$(file "azulejo_sampling-*manylinux*_$(uname -m).whl")" ;;
    sdist) python_package "$(file 'azulejo_sampling-*.tar.gz')" ;;
    npm) npm_package ;;
    crates) crates ;;
    source) source_with_crates ;;
    debs) debs ;;
    *) die "unknown kind $kind" ;;
esac
