# Sourced by tests/c/package.sh and tests/c/installed.sh: how examples_c is built against an installed azulejo, and what
# its programs must print. They set root, the project's folder, and work, a scratch folder, before.

step() { # NAME COMMAND...
    local name=$1
    shift
    if "$@" >"$work/log" 2>&1; then
        printf '%-44s ok\n' "$name"
    else
        printf '%-44s FAILED\n' "$name"
        tail -n 40 "$work/log" | sed 's/^/    /'
        exit 1
    fi
}

fails() { ! "$@"; }

make_mesh() {
    printf 'v 0 0 0\nv 2 0 0\nv 2 1 0\nv 0 1 0\nv 1 0.5 1\nf 4 3 2 1\nf 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n' >"$work/roof.obj"
}

# BUILD PREFIX CMAKE-ARGUMENT...: outside the tree, from a copy that knows nothing of it; PREFIX is empty for the system's
examples() {
    configure_examples "$@" && cmake --build "$1" -j "${CARGO_BUILD_JOBS:-$(nproc)}"
}

# The same, but only the programs of run_examples.
few_examples() {
    configure_examples "$@" && cmake --build "$1" -j "${CARGO_BUILD_JOBS:-$(nproc)}" --target plane surface relax
}

configure_examples() {
    rm -rf "$work/examples" && cp -r "$root/examples_c" "$work/examples"
    cmake -S "$work/examples" -B "$1" -DCMAKE_PREFIX_PATH="$2" "${@:3}"
}

run_examples() { # BUILD: each prints lines of finite numbers
    local build=$1
    "$build/plane" 0.05 >"$work/plane.txt" && check_numbers "$work/plane.txt" 2 200 &&
        "$build/surface" "$work/roof.obj" >"$work/surface.txt" && check_numbers "$work/surface.txt" 6 9000 &&
        "$build/relax" >"$work/relax.txt" && check_numbers "$work/relax.txt" 2 1024 &&
        fails "$build/surface" "$work/missing.obj"
}

check_numbers() { # FILE COLUMNS AT-LEAST
    awk -v columns="$2" -v least="$3" '
        NF != columns { exit bad = 1 }
        { for (i = 1; i <= NF; i++) if ($i !~ /^-?[0-9.]+(e-?[0-9]+)?$/) exit bad = 1 }
        END { exit bad || NR < least }' "$1"
}

run_scatter() { # BUILD
    "$1/scatter" "$work/roof.obj" --samples 5000 --out "$work/out" --threads 2 >"$work/table.txt" &&
        cat "$work/table.txt" && [ "$(wc -l <"$work/table.txt")" = 5 ] &&
        grep -Eq '^projected .* [1-9][0-9]* rays, [1-9][0-9]*/s, rasteriser$' "$work/table.txt" &&
        has_vertices surface.ply 36 && has_vertices plane.ply 8 && has_vertices relaxed.ply 8 &&
        [ "$(ls "$work/out" | wc -l)" = 3 ] && fails "$1/scatter" && fails "$1/scatter" "$work/missing.obj"
}

run_stipple() { # BUILD: a disk that fades from black to white
    awk 'BEGIN { print "P2 60 40\n# a disk\n255"; for (y = 0; y < 40; y++) for (x = 0; x < 60; x++) {
        d = ((x - 30) ^ 2 + (y - 20) ^ 2) / 225; print d < 1 ? int(255 * d) : 255 } }' >"$work/disk.pgm"
    local dots
    dots=$("$1/stipple" "$work/disk.pgm" "$work/disk.svg" 5000 | cut -d ' ' -f 1)
    [ "$dots" -gt 4500 ] && [ "$dots" -lt 6000 ] && [ "$(grep -c '^M' "$work/disk.svg")" = "$dots" ] &&
        fails "$1/stipple" && fails "$1/stipple" "$work/roof.obj" "$work/roof.svg"
}

run_dither() { # BUILD: a gradient in two levels and in five, with the light of the image
    "$1/dither" - "$work/halftone.pgm" >"$work/dither.txt" && "$1/dither" - "$work/five.pgm" 5 >>"$work/dither.txt" &&
        cat "$work/dither.txt" && [ "$(stat -c %s "$work/halftone.pgm")" = $((15 + 512 * 128)) ] &&
        [ "$(tail -c +16 "$work/halftone.pgm" | od -An -v -tu1 -w1 | sort -u | wc -l)" = 2 ] &&
        [ "$(tail -c +16 "$work/five.pgm" | od -An -v -tu1 -w1 | sort -u | wc -l)" = 5 ] &&
        awk '{ sub(",", "", $2); d = $2 - $6; exit !(d < 0.001 && d > -0.001) }' "$work/dither.txt" &&
        "$1/dither" "$work/halftone.pgm" "$work/again.pgm" && cmp "$work/halftone.pgm" "$work/again.pgm" &&
        fails "$1/dither" && fails "$1/dither" "$work/roof.obj" "$work/roof.pgm" && fails "$1/dither" - "$work/a.pgm" 1
}

run_tufts() { # BUILD: a picture of as many bytes as its pixels take, with fur on a light ground
    "$1/tufts" "$work/roof.obj" "$work/roof.ppm" 500 64 &&
        [ "$(stat -c %s "$work/roof.ppm")" = $((13 + 3 * 64 * 64)) ] &&
        [ "$(tail -c +14 "$work/roof.ppm" | od -An -v -tu1 -w3 | sort -u | wc -l)" -gt 200 ] &&
        fails "$1/tufts" && fails "$1/tufts" "$work/missing.obj" "$work/missing.ppm" && [ ! -e "$work/missing.ppm" ]
}

run_forest() { # BUILD: a picture of as many bytes as its pixels take, of three classes of plants
    "$1/forest" "$work/plants.ppm" 60 64 >"$work/plants.txt" && cat "$work/plants.txt" &&
        [ "$(stat -c %s "$work/plants.ppm")" = $((13 + 3 * 64 * 64)) ] &&
        [ "$(tail -c +14 "$work/plants.ppm" | od -An -v -tu1 -w3 | sort -u | wc -l)" -gt 1000 ] &&
        awk '{ exit !($1 > 20 && $3 > $1 && $5 > $3) }' "$work/plants.txt" && fails "$1/forest" && fails "$1/forest" a 0
}

run_lights() { # BUILD: errors of both kinds of lights, a sentence that they decide, and a picture
    "$1/lights" "$work/room.ppm" 100 64 >"$work/lights.txt" && cat "$work/lights.txt" &&
        [ "$(stat -c %s "$work/room.ppm")" = $((13 + 3 * 64 * 64)) ] &&
        [ "$(tail -c +14 "$work/room.ppm" | od -An -v -tu1 -w3 | sort -u | wc -l)" -gt 500 ] &&
        awk '/^blue noise:/ { blue = $4 } /^random:/ { random = $3 } /better/ { said = $0 }
            END { exit !(blue > 0 && random > 0 && blue < random && said ~ /^Blue-noise lights are better/) }' \
            "$work/lights.txt" && fails "$1/lights" && fails "$1/lights" "$work/room.ppm" 0
}

run_lod() { # BUILD: a picture with trees before land and sky, some of them left out
    "$1/lod" "$work/forest.ppm" 5000 160 >"$work/lod.txt" && cat "$work/lod.txt" &&
        [ "$(stat -c %s "$work/forest.ppm")" = $((14 + 3 * 160 * 90)) ] &&
        [ "$(tail -c +15 "$work/forest.ppm" | od -An -v -tu1 -w3 | sort -u | wc -l)" -gt 500 ] &&
        awk '{ exit !($1 > 500 && $1 < $3 && $3 == 5000) }' "$work/lod.txt" && fails "$1/lod" && fails "$1/lod" a 0
}

run_camera() { # BUILD: frames in three heights, one of them compared with the window of the plane
    "$1/camera" --check 40 >"$work/camera.txt" && cat "$work/camera.txt" &&
        grep -q '^10000000000 samples' "$work/camera.txt" &&
        tail -n 3 "$work/camera.txt" >"$work/heights.txt" && check_numbers "$work/heights.txt" 7 3 &&
        [ "$(awk '{ sum += $3 } END { print sum }' "$work/heights.txt")" = 40 ] && fails "$1/camera" 0
}

run_plants() { # BUILD: shrubs and grass, none too close to what stood before
    "$1/plants" 3 >"$work/plants.txt" && cat "$work/plants.txt" &&
        awk 'NR == 1 && $2 > 100 { n++ } NR == 2 && $2 > 10000 { n++ } END { exit n != 2 }' "$work/plants.txt" &&
        grep -q '^0 too close$' "$work/plants.txt" && fails "$1/plants" none
}

run_paint() { # BUILD: strokes on a roof, after which the set is what the host has noted, and maximal
    "$1/paint" "$work/roof.obj" 5000 20 >"$work/paint.txt" && cat "$work/paint.txt" &&
        grep -q '^20 strokes' "$work/paint.txt" && fails "$1/paint" && fails "$1/paint" "$work/missing.obj"
}

run_ranks() { # BUILD: four processes, or three, make the plane that one makes, without communication
    export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
    mpirun --oversubscribe -n 4 "$1/ranks" --check 0.002 "$work/plane.xy" >"$work/ranks.txt" &&
        mpirun --oversubscribe -n 3 "$1/ranks" --check 0.005 && cat "$work/ranks.txt" &&
        [ "$(stat -c %s "$work/plane.xy")" = $((8 * $(cut -d ' ' -f 1 "$work/ranks.txt"))) ] &&
        fails mpirun --oversubscribe -n 4 "$1/ranks" -1
}

has_vertices() { # FILE BYTES-PER-VERTEX: the file is as long as its header says
    local file=$work/out/$1 count header
    count=$(grep -a -m 1 '^element vertex ' "$file" | cut -d ' ' -f 3)
    header=$(grep -a -b -m 1 '^end_header$' "$file" | cut -d : -f 1)
    [ "$count" -gt 0 ] && [ "$(stat -c %s "$file")" = $((header + 11 + count * $2)) ]
}

is_static() { fails grep -qF '[libazulejo.so' <(readelf --dynamic "$1"); }

# PREFIX FLAG...: plane.c with the flags of pkg-config; PREFIX is empty for the system's.
pkg_config() {
    local flags modules=
    [ -z "$1" ] || modules=$(dirname "$(find "$1" -name azulejo.pc)")
    flags=$(PKG_CONFIG_PATH=$modules pkg-config "${@:2}" --cflags --libs azulejo)
    if [ "${2:-}" = --static ]; then
        flags=${flags/-lazulejo/-l:libazulejo.a}
    fi
    # shellcheck disable=SC2086
    cc "$root/examples_c/plane.c" -o "$work/plane" $flags ${modules:+-Wl,-rpath,"$(dirname "$modules")"} &&
        "$work/plane" 0.1 >"$work/plane.txt" && check_numbers "$work/plane.txt" 2 50
}
