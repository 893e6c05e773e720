# Sourced by the scripts of this folder, in the root of the project.

# FOLDER PACKAGE...: an environment of Python in the folder, with these packages.
environment() {
    [ -x "$1/bin/python" ] || python3 -m venv "$1"
    "$1/bin/pip" install --quiet --disable-pip-version-check "${@:2}"
}

# FOLDER PACKAGE...: the same with the wheel of azulejo that bindings/python/test.sh has left.
environment_with_azulejo() {
    local wheel
    wheel=$(integrations/wheel.sh)
    [ -n "$wheel" ] || { echo "${0##*/}: there is no wheel: run bindings/python/test.sh" >&2; exit 1; }
    environment "$@"
    "$1/bin/pip" install --quiet --disable-pip-version-check --no-deps --force-reinstall "$wheel"
}
