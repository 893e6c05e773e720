#!/usr/bin/env bash
# Tests an installed azulejo as a guest in programs that it knows nothing of: what its static library exports and needs,
# that it keeps its Rust to itself, and that the shared library can be loaded and closed by a running program.
#
#   tests/c/guest.sh PREFIX
set -euo pipefail

root=$(cd "$(dirname "$0")/../.." && pwd)
prefix=$(cd "${1:?usage: tests/c/guest.sh PREFIX}" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

. "$root/tests/c/examples.sh"

# The line that pkg-config says, with all of the library instead of what a program asks for.
flags=$(PKG_CONFIG_PATH=$prefix/lib/pkgconfig pkg-config --static --cflags --libs azulejo)
read -ra whole <<<"${flags/-lazulejo/-Wl,--whole-archive -l:libazulejo.a -Wl,--no-whole-archive}"

exports() {
    nm --defined-only --extern-only --format=posix "$prefix/lib/libazulejo.a" | sed '/:$/d' | cut -d ' ' -f 1 |
        LC_ALL=C sort >"$work/exports.txt"
    diff "$root/tests/c/symbols.txt" "$work/exports.txt"
}

leaves_nothing_open() { cc -shared -o "$work/libhost.so" -Wl,--no-undefined "${whole[@]}"; }

# Both libraries in one program: nothing collides, and both have a std that works.
beside_another_rust_library() {
    cat >"$work/other.rs" <<'END'
#[unsafe(no_mangle)]
pub extern "C" fn other_answer() -> u32 {
    let caught = std::panic::catch_unwind(|| panic!("as it should"));
    std::thread::spawn(move || if caught.is_err() { 42 } else { 0 }).join().unwrap_or(0)
}
END
    cat >"$work/both.c" <<'END'
#include <azulejo.h>

uint32_t other_answer(void);

int main(void) {
    azulejo_context *context;
    azulejo_points *points;
    azulejo_kdrt_options options;
    azulejo_kdrt_options_init(&options, sizeof options);
    options.radius = 0.05;
    return azulejo_context_create(2, &context) || azulejo_kdrt_sample(context, &options, &points, NULL) ||
           azulejo_points_count(points) < 200 || other_answer() != 42;
}
END
    rustc --edition 2024 --crate-type staticlib -O -o "$work/libother.a" "$work/other.rs" &&
        cc "$work/both.c" -o "$work/both" "$work/libother.a" "${whole[@]}" && "$work/both"
}

# A plug-in is loaded, used by a thread and closed while the threads of its context end.
loaded_and_closed() {
    cat >"$work/load.c" <<'END'
#include <dlfcn.h>
#include <pthread.h>
#include <stdint.h>

static void *use(void *library) {
    int32_t (*create)(uint32_t, void **) = (int32_t (*)(uint32_t, void **))dlsym(library, "azulejo_context_create");
    void (*release)(void *) = (void (*)(void *))dlsym(library, "azulejo_context_free");
    void *context = NULL;
    if (create(4, &context) == 0) release(context);
    return context;
}

int main(int argc, char **argv) {
    int round;
    for (round = 0; round < 200; round++) {
        pthread_t thread;
        void *library = dlopen(argv[argc - 1], RTLD_NOW | RTLD_LOCAL), *used = NULL;
        if (library == NULL || pthread_create(&thread, NULL, use, library) || pthread_join(thread, &used)) return 1;
        if (used == NULL || dlclose(library) != 0) return 1;
    }
    return 0;
}
END
    cc "$work/load.c" -o "$work/load" -ldl -lpthread && "$work/load" "$prefix/lib/libazulejo.so"
}

# Two plug-ins bring a copy each: both work at once, and what one makes is the same as what the other makes.
two_copies() {
    cat >"$work/copies.c" <<'END'
#include <azulejo.h>
#include <dlfcn.h>
#include <pthread.h>
#include <string.h>

typedef struct {
    const char *path;
    void *library;
    azulejo_points *points;
    const float *xy;
    size_t count;
} copy;

#define FIND(copy, name) (*(__typeof__(&name) *)memcpy(&(__typeof__(&name)){0}, &(void *){dlsym((copy)->library, #name)}, 8))

static void *use(void *user) {
    copy *c = user;
    azulejo_kdrt_options options;
    azulejo_context *context;
    int round;
    for (round = 0; round < 20; round++) {
        if (c->points != NULL) FIND(c, azulejo_points_free)(c->points);
        if (FIND(c, azulejo_kdrt_options_init)(&options, sizeof options)) return NULL;
        options.radius = 0.02;
        if (FIND(c, azulejo_context_create)(2, &context)) return NULL;
        if (FIND(c, azulejo_kdrt_sample)(context, &options, &c->points, NULL)) return NULL;
        FIND(c, azulejo_context_free)(context);
    }
    c->xy = FIND(c, azulejo_points_positions)(c->points);
    c->count = FIND(c, azulejo_points_count)(c->points);
    return c;
}

int main(int argc, char **argv) {
    copy copies[2];
    pthread_t threads[2];
    int i;
    if (argc != 3) return 1;
    memset(copies, 0, sizeof copies);
    for (i = 0; i < 2; i++) {
        copies[i].library = dlopen(argv[1 + i], RTLD_NOW | RTLD_LOCAL);
        if (copies[i].library == NULL || pthread_create(&threads[i], NULL, use, &copies[i])) return 2;
    }
    for (i = 0; i < 2; i++) {
        void *done;
        if (pthread_join(threads[i], &done) || done == NULL) return 3;
    }
    /* Two libraries indeed. */
    if (dlsym(copies[0].library, "azulejo_version") == dlsym(copies[1].library, "azulejo_version")) return 4;
    if (copies[0].count == 0 || copies[0].count != copies[1].count) return 5;
    return memcmp(copies[0].xy, copies[1].xy, 8 * copies[0].count) != 0;
}
END
    cp "$prefix/lib/libazulejo.so" "$work/another.so"
    cc -I "$prefix/include" "$work/copies.c" -o "$work/copies" -ldl -lpthread &&
        "$work/copies" "$prefix/lib/libazulejo.so" "$work/another.so"
}

step "static: exports the C ABI, nothing of Rust" exports
step "static: -Wl,--no-undefined" leaves_nothing_open
step "static: beside another Rust library" beside_another_rust_library
step "shared: loaded and closed at run time" loaded_and_closed
step "shared: two copies in one process" two_copies
