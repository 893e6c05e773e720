#!/usr/bin/env bash
# Prints the newest wheel for this machine that bindings/python/test.sh has left; nothing if there is none.
find "$(dirname "$0")/../target/python/wheels" -name "*$(uname -m).whl" -printf '%T@ %p\n' 2>/dev/null | sort -n | sed -n '$s/[^ ]* //p'
