# Sourced by tests/c/run.sh and tests/c/sanitized.sh: runs steps that do not depend on each other at the same time. The
# script sets work, a scratch folder, before.

# COMMAND...: in the background, as soon as fewer than one per core are running.
beside() {
    while [ "$(jobs -pr | wc -l)" -ge "${CARGO_BUILD_JOBS:-$(nproc)}" ]; do
        wait -n || true
    done
    apart "$@" &
}

# COMMAND...: with a scratch folder of its own. What it prints is shown when it has ended.
apart() {
    local scratch
    scratch=$(mktemp -d "$work/step.XXXXXX")
    (work=$scratch && "$@") >"$scratch/said" 2>&1 || touch "$work/failed"
    flock "$work" cat "$scratch/said"
    rm -rf "$scratch"
}

# Waits for the steps in the background; fails if one step has failed so far.
all_done() {
    wait
    [ ! -e "$work/failed" ]
}
