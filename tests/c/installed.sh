#!/usr/bin/env bash
# Installs the Debian packages of /debs in a clean root (scripts/clean-root.sh), uses them as other projects do, and
# removes them.
#
#   scripts/clean-root.sh RELEASE DEBS tests/c/installed.sh
set -euo pipefail

root=$(cd "$(dirname "$0")/../.." && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

. "$root/tests/c/examples.sh"
. "$root/tests/c/version.sh"

is_clean() { fails command -v cargo && fails ldconfig_knows && fails ls /usr/include/embree*; }

ldconfig_knows() { ldconfig -p | grep -q "libazulejo.so.$abi"; }

apt() { apt-get -qq -o Dpkg::Use-Pty=0 -o Acquire::Retries=3 "$@"; }

install_debs() { apt update && apt install --no-install-recommends "$@" && ldconfig_knows; }

remove_debs() {
    apt purge "libazulejo$abi" && fails ldconfig_knows && [ -z "$(dpkg-query -W 'libazulejo*' 2>/dev/null)" ] &&
        [ -z "$(find / -xdev -name '*azulejo*' ! -path "$work*" ! -path "/azulejo*" ! -name azulejo-base)" ]
}

step "installed: the root is clean" is_clean
step "installed: the library alone" install_debs "/debs/libazulejo$abi"_*.deb
step "installed: both packages" install_debs "/debs/libazulejo$abi"_*.deb /debs/libazulejo-dev_*.deb
step "installed: Embree's headers, for the renderers" apt install --no-install-recommends libembree-dev
make_mesh
step "installed: examples, shared" examples "$work/shared" ""
step "installed: they run" run_examples "$work/shared"
step "installed: scatter" run_scatter "$work/shared"
step "installed: tufts" run_tufts "$work/shared"
step "installed: camera" run_camera "$work/shared"
step "installed: plants" run_plants "$work/shared"
step "installed: lod" run_lod "$work/shared"
step "installed: examples, static" few_examples "$work/static" "" -DAZULEJO_EXAMPLES_STATIC=ON
step "installed: they do not need libazulejo.so" is_static "$work/static/plane"
step "installed: they run" run_examples "$work/static"
step "installed: pkg-config" pkg_config ""
step "installed: pkg-config --static" pkg_config "" --static
step "installed: it does not need libazulejo.so" is_static "$work/plane"
step "installed: removed without a trace" remove_debs
