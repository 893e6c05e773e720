#!/usr/bin/env bash
# Makes the Debian packages of this machine's release and tests what they hold and depend on.
#
#   tests/c/debs.sh [--dev] DIR      DIR is that of package.sh --keep, whose cargo has built the library, with --dev if that
#                                    had it; makes DIR/debs
#
# That they can be installed, used and removed is tested by installed.sh, in a clean root.
set -euo pipefail

root=$(cd "$(dirname "$0")/../.." && pwd)
profile=release
if [ "${1:-}" = --dev ]; then
    profile=dev
    shift
fi
base=$(cd "${1:?usage: tests/c/debs.sh [--dev] DIR}" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

. "$root/tests/c/examples.sh"
. "$root/tests/c/version.sh"

make_packages() {
    rm -rf "$base/debs"
    mkdir -p "$base/debs-build"
    ln -sfn ../build/cargo "$base/debs-build/cargo"
    cmake -S "$root" -B "$base/debs-build" -DCMAKE_INSTALL_PREFIX=/usr -DAZULEJO_CARGO_PROFILE=$profile \
        -DAZULEJO_CARGO_FLAGS="${AZULEJO_CARGO_FLAGS:---locked}" && cmake --build "$base/debs-build" &&
        cpack -G DEB --config "$base/debs-build/CPackConfig.cmake" -B "$base/debs" && rm -r "$base/debs/_CPack_Packages" &&
        runtime=$(ls "$base"/debs/libazulejo"$abi"_*.deb) && development=$(ls "$base"/debs/libazulejo-dev_*.deb) &&
        debug=$(ls "$base"/debs/libazulejo"$abi"-dbgsym_*.deb) && [ "$(ls "$base/debs" | wc -l)" = 3 ]
}

depend() { # the library on the Embree that it loads; programs and debugging information on that very library
    local package
    package=$(dpkg-deb --field "$runtime" Version)
    dpkg-deb --field "$runtime" Depends
    dpkg-deb --field "$runtime" Depends | grep -qE '(^|, )libembree(3-3|4-4) ' &&
        dpkg-deb --field "$runtime" Depends | grep -qE '(^|, )libc6 ' &&
        [ "$(dpkg-deb --field "$development" Depends)" = "libazulejo$abi (= $package)" ] &&
        [ "$(dpkg-deb --field "$debug" Depends)" = "libazulejo$abi (= $package)" ]
}

hold() { # each file is in the package that it belongs to
    local libraries
    libraries=usr/lib/$(dpkg-architecture -qDEB_HOST_MULTIARCH)
    dpkg-deb --extract "$runtime" "$work/runtime" && dpkg-deb --extract "$development" "$work/development" &&
        dpkg-deb --extract "$debug" "$work/debug" &&
        diff - <(cd "$work/debug" && find . ! -type d | LC_ALL=C sort) <<END &&
./usr/lib/debug/$libraries/libazulejo.so.$version.debug
./usr/share/doc/libazulejo$abi-dbgsym/changelog.Debian.gz
./usr/share/doc/libazulejo$abi-dbgsym/copyright
END
        diff - <(cd "$work/runtime" && find . ! -type d | LC_ALL=C sort) <<END &&
./$libraries/libazulejo.so.$abi
./$libraries/libazulejo.so.$version
./usr/share/doc/libazulejo$abi/changelog.Debian.gz
./usr/share/doc/libazulejo$abi/copyright
END
        diff - <(cd "$work/development" && find . ! -type d | LC_ALL=C sort) <<END
$(cd "$root" && find ./include -name "*.h*" | LC_ALL=C sort | sed "s|^./|./usr/|")
./$libraries/cmake/azulejo/azulejo-config-version.cmake
./$libraries/cmake/azulejo/azulejo-config.cmake
./$libraries/cmake/azulejo/azulejo-targets.cmake
./$libraries/libazulejo.a
./$libraries/libazulejo.so
./$libraries/pkgconfig/azulejo.pc
./usr/share/doc/libazulejo-dev/changelog.Debian.gz
./usr/share/doc/libazulejo-dev/copyright
END
}

# Each crate inside is named, and the texts of licences other than Apache's are there.
credit() {
    local copyright=$work/runtime/usr/share/doc/libazulejo$abi/copyright
    cmp "$copyright" "$work/development/usr/share/doc/libazulejo-dev/copyright" &&
        head -n 1 "$copyright" | grep -q '^azulejo is free software' && grep -q '^  MIT License' "$copyright" &&
        grep -q '^  rayon [0-9.]* (MIT OR Apache-2.0)$' "$copyright" &&
        grep -A 2 '^--- rayon-[0-9.]*' "$copyright" | grep -q '^Copyright (c) .*Rust Project'
}

is_stripped() { fails grep -q debug_info <(readelf --section-headers --wide "$1"); }

step "debs: built" make_packages
step "debs: their dependences" depend
step "debs: their files" hold
step "debs: their licences" credit
step "debs: the shared library is stripped" is_stripped "$(find "$work/runtime" -name 'libazulejo.so.*.*')"
step "debs: the static library is stripped" is_stripped "$(find "$work/development" -name libazulejo.a)"
