#!/usr/bin/env bash
# Tests when an installed azulejo loads Embree, and what it does to TBB in a program that uses both.
#
#   tests/c/lazy.sh PREFIX
#
# A program that only fills loads neither; one that iterates loads Embree, or is told that it is not there; TBB's bounds of
# threads stay the program's. Nothing is tested of a library that was built without Embree.
set -euo pipefail

root=$(cd "$(dirname "$0")/../.." && pwd)
prefix=$(cd "${1:?usage: tests/c/lazy.sh PREFIX}" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

. "$root/tests/c/examples.sh"

config=$(find "$prefix" -name azulejo-config.cmake)
embree=$(sed -n 's/^set(azulejo_EMBREE \(embree[34]\))$/\1/p' "$config")
if [ -z "$embree" ]; then
    echo "lazy.sh: the library in $prefix was built without Embree"
    exit 0
fi
libraries=$(dirname "$(find "$prefix" -name libazulejo.so)")
file=lib$embree.so.${embree#embree}
flags=(-I "$prefix/include" -L "$libraries" -Wl,-rpath,"$libraries" -lazulejo)
warnings=(-Wall -Wextra -Wpedantic -Werror)

compile() {
    cc -std=gnu11 "${warnings[@]}" "$root/tests/c/lazy/fill.c" -o "$work/fill" "${flags[@]}" &&
        cc -std=gnu11 "${warnings[@]}" "$root/tests/c/lazy/fill.c" -o "$work/fill-static" "-I$prefix/include" \
            "$libraries/libazulejo.a" -lpthread -ldl -lm
}

# PROGRAM ARGUMENT...: its output is in $work/said, and what the dynamic linker looked for in $work/loaded.
watch() {
    rm -f "$work"/loaded*
    LD_DEBUG=libs LD_DEBUG_OUTPUT=$work/loaded "$@" >"$work/said" && cat "$work/said" && cat "$work"/loaded.* >"$work/loaded"
}

loads_neither() { watch "$1" && grep -q 'libc\.so' "$work/loaded" && fails grep -E 'lib(embree|tbb)[0-9a-z]*\.so' "$work/loaded"; }

loads_embree() { watch "$1" iterate && grep -qF "$file" "$work/loaded" && fails grep '^status' "$work/said"; }

# A file that is no library hides the one of the system.
is_told() {
    mkdir -p "$work/hidden" && : >"$work/hidden/$file"
    LD_LIBRARY_PATH=$work/hidden "$work/fill" &&
        LD_LIBRARY_PATH=$work/hidden "$work/fill" iterate >"$work/said" && cat "$work/said" &&
        grep -q "^status -7: Embree: $file .* cannot be loaded: .*$file" "$work/said"
}

keeps_tbb() {
    c++ -std=c++17 "${warnings[@]}" "$root/tests/c/lazy/tbb.cpp" -o "$work/tbb" "${flags[@]}" -ltbb -lpthread && "$work/tbb"
}

# host.c as a plug-in that nobody else sees: the library that azulejo opens is the plug-in's own.
serves_plug_ins() {
    local search=()
    [ -z "${EMBREE_DIR:-}" ] || search=(-isystem "$EMBREE_DIR/include" -L "$EMBREE_DIR/lib" "-Wl,-rpath,$EMBREE_DIR/lib")
    cat >"$work/open.c" <<'END'
#include <dlfcn.h>

int main(int argc, char **argv) {
    void *plug_in = dlopen(argv[argc - 1], RTLD_NOW | RTLD_LOCAL);
    int (*run)(void) = plug_in != 0 ? (int (*)(void))dlsym(plug_in, "main") : 0;
    return run != 0 ? run() : 1;
}
END
    cc "$work/open.c" -o "$work/open" -ldl &&
        cc -std=gnu11 -shared -fPIC "-DEMBREE_MAJOR=${embree#embree}" "${search[@]}" "$root/tests/c/host.c" \
            -o "$work/host.so" "${flags[@]}" "-l$embree" -lm && "$work/open" "$work/host.so" && watch "$work/open" "$work/host.so" &&
        [ "$(grep -c "calling init: .*/$file" "$work/loaded")" = 1 ]
}

step "lazy: programs" compile
step "lazy: a fill loads neither Embree nor TBB" loads_neither "$work/fill"
step "lazy: nor does it in a static program" loads_neither "$work/fill-static"
step "lazy: an iteration loads Embree" loads_embree "$work/fill"
step "lazy: and in a static program" loads_embree "$work/fill-static"
step "lazy: a missing Embree is named" is_told
step "lazy: a plug-in's scenes are of that library" serves_plug_ins
step "lazy: TBB's bounds stay the program's" keeps_tbb
