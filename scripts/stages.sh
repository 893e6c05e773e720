# Sourced by scripts/test.sh: runs stages, a lane of them in the background, and lists what each has cost. The script
# sets work, a scratch folder, before.

# NAME COMMAND...: runs the command in a process of its own, so that its `times` counts this stage alone.
stage() {
    local name=$1 began=$SECONDS
    shift
    lane_is_well
    printf '\n== %s (after %d s, %s free)\n' "$name" "$began" "$(df -h --output=avail . | tail -n 1 | tr -d ' ')"
    (
        trap 'times >"$work/times.$BASHPID"; add_row "$name" $((SECONDS - began)) <"$work/times.$BASHPID"' EXIT
        "$@"
    ) 2>&1 | tee -a "$work/said"
}

# NAME WALL <TIMES: the second line of `times` is the time of the children, in user mode and in the kernel.
add_row() {
    awk -F '[ms ]+' -v name="$1" -v wall="$2" \
        'NR == 2 { printf "%6d %6d  %s\n", wall, 60 * ($1 + $3) + $2 + $4, name }' >>"$work/rows"
}

# COMMAND: a function of stages, run in the background at low priority, in the time that the stages in the foreground
# leave. What it prints is shown when it has ended. It is killed, with its children, when this script ends.
behind() {
    set -m
    (
        renice -n 5 -p $BASHPID >/dev/null
        "$1"
        touch "$work/lane_done"
    ) >"$work/lane" 2>&1 &
    lane=$!
    set +m
    trap 'kill -- -$lane 2>/dev/null || true; rm -rf "$work"' EXIT
}

lane_is_well() {
    [ -z "${lane:-}" ] || kill -0 "$lane" 2>/dev/null || [ -e "$work/lane_done" ] || lane_ended
}

# Waits for the background; fails if a stage there has failed.
lane_ended() {
    wait "$lane" || true
    cat "$work/lane"
    [ -e "$work/lane_done" ]
}

# WHAT: for the last line. A stage that lacks a tool prints a line of the same form.
leave_out() { echo "SKIPPED: $*" | tee -a "$work/said"; }

# What each stage has cost, the most expensive last, and what was left out; target/checked keeps the verdict.
summary() {
    local but tree=clean
    printf '\n  wall    CPU  stage (seconds)\n'
    sort -n -k 2 "$work/rows"
    awk -v wall="$SECONDS" '{ cpu += $2 } END { printf "%6d %6d  all\n", wall, cpu }' "$work/rows"
    but=$(sed -n 's/^SKIPPED: //p' "$work/said" | sort -u | paste -s -d ';' | sed 's/;/; /g')
    [ -z "$(git status --porcelain 2>/dev/null)" ] || tree=changed
    {
        echo "commit: $(git rev-parse HEAD 2>/dev/null || echo unknown), tree: $tree"
        echo "passed in $SECONDS s, stages:"
        cut -c 17- "$work/rows"
        [ -z "$but" ] || echo "left out: $but"
    } >target/checked
    printf '\n== All checks passed%s\n' "${but:+, all but: $but}"
}
