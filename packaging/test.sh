#!/usr/bin/env bash
# Checks what can be checked of the recipes without vcpkg and conda: the crates are packaged, the port is run with an
# imitation of vcpkg's helpers, conan builds and tests its package, and conda's build step is run by hand. All take the
# library that the tests have compiled (cargo's profile dev, without Embree), or compile it.
#
#   packaging/test.sh
set -euo pipefail
cd "$(dirname "$0")"

root=$(cd .. && pwd)
work=$root/target/packaging
conan=$work/tools/bin/conan
export CONAN_HOME=$work/conan-home AZULEJO_CARGO_PROFILE=dev

# Cargo finds what the tests have compiled.
share_cargo() { mkdir -p "$1" && ln -sfn "$root/target" "$1/cargo"; }

crates() {
    (cd "$root" && cargo package --quiet --workspace --exclude azulejo-studies --no-verify --locked --allow-dirty \
        --target-dir "$work/crates")
    ls "$work"/crates/package/*.crate
}

port() {
    rm -rf "$work/vcpkg"
    share_cargo "$work/vcpkg-build"
    cmake -D CURRENT_PORT_DIR="$PWD/vcpkg" -D CURRENT_PACKAGES_DIR="$work/vcpkg" -D BUILD="$work/vcpkg-build" \
        -P vcpkg/imitation.cmake
    "$work/tools/bin/python" -m json.tool vcpkg/vcpkg.json >/dev/null
    use "$work/vcpkg"
}

# PREFIX: a program finds the package there.
use() {
    cmake -S conan/test_package -B "$work/use" --fresh -D CMAKE_PREFIX_PATH="$1" >/dev/null
    cmake --build "$work/use" >/dev/null
    "$work/use/shared" && "$work/use/static"
}

conan_package() {
    [ -e "$CONAN_HOME/profiles/default" ] || "$conan" profile detect >/dev/null
    share_cargo "$work/conan"
    "$conan" build conan --settings build_type=Debug
    "$conan" export-pkg conan --settings build_type=Debug --test-folder test_package
}

conda_package() {
    rm -rf "$work/conda"
    share_cargo "$work/conda-build"
    (cd "$root" && PREFIX=$work/conda BUILD_DIR=$work/conda-build packaging/conda/build.sh >/dev/null)
    use "$work/conda"
    "$work/tools/bin/python" conda/lint.py
}

[ -e "$work/tools/bin/python" ] || python3 -m venv "$work/tools"
"$work/tools/bin/pip" install --quiet --disable-pip-version-check --requirement tools.txt
crates
port
conan_package >"$work/conan.log" 2>&1 || { tail -n 30 "$work/conan.log" >&2; exit 1; }
conda_package
