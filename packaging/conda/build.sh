#!/usr/bin/env bash
# Run by conda in the sources, with PREFIX set to where the package is made.
set -euo pipefail

cmake -S . -B "${BUILD_DIR:-build}" -D CMAKE_INSTALL_PREFIX="$PREFIX" -D CMAKE_INSTALL_LIBDIR=lib -D AZULEJO_EMBREE=OFF \
    -D AZULEJO_CARGO_FLAGS=--locked -D AZULEJO_CARGO_PROFILE="${AZULEJO_CARGO_PROFILE:-release}"
cmake --build "${BUILD_DIR:-build}"
cmake --install "${BUILD_DIR:-build}"
