#!/usr/bin/env bash
# Packs the Blender extension with the wheels of azulejo inside: target/blender/azulejo_scatter-VERSION.zip.
#
#   integrations/blender/build.sh             with a wheel for this machine, built here
#   integrations/blender/build.sh WHEEL...    with these, one for each platform that the extension is for
#
# Blender's own check of extensions, which the package bpy has too, is made by test.sh; here by `blender` if there is one.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../.." && pwd)
work=$root/target/blender
mkdir -p "$work"

wheels=()
for wheel in "$@"; do wheels+=("$(realpath "$wheel")"); done
if [ ${#wheels[@]} = 0 ]; then
    [ -e "$work/tools/bin/python" ] || python3 -m venv "$work/tools"
    "$work/tools/bin/pip" install --quiet --disable-pip-version-check --requirement "$root/bindings/python/tools.txt"
    rm -rf "$work/wheels"
    (cd "$root/bindings/python" &&
        PATH=$work/tools/bin:$PATH maturin build --release --locked --quiet --target-dir "$root/target/python/cargo" --out "$work/wheels")
    wheels=("$work"/wheels/*.whl)
fi

rm -rf "$work/source"
python3 "$here/pack.py" "$here/azulejo_scatter" "$root" "$work/source" "${wheels[@]}"
if command -v blender >/dev/null; then
    blender --command extension validate "$work"/azulejo_scatter-*.zip
else
    echo "There is no blender to check it; test.sh does, by the program that blender runs."
fi
