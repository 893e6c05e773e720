# Sourced by scripts/test.sh: runs stages, one lane of them behind the others, and says what each has cost. It sets work,
# a scratch folder, before.

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

# NAME WALL <TIMES: the second line of `times` is what the children took, in user mode and in the kernel.
add_row() {
    awk -F '[ms ]+' -v name="$1" -v wall="$2" \
        'NR == 2 { printf "%6d %6d  %s\n", wall, 60 * ($1 + $3) + $2 + $4, name }' >>"$work/rows"
}

# COMMAND: a function of stages, which runs behind the stages that follow and takes the time that they leave; what it
# prints is printed when it has ended. Its group of processes ends with this one.
behind() {
    set -m
    (
        renice -n 10 -p $BASHPID >/dev/null
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

# Waits for it, and fails if it has.
lane_ended() {
    wait "$lane" || true
    cat "$work/lane"
    [ -e "$work/lane_done" ]
}

# REASON: for the last line; stages say so too, in a line of this form.
leave_out() { echo "SKIPPED: $*" | tee -a "$work/said"; }

# What each stage has cost, dearest last, and what was left out by a flag or for lack of a tool.
summary() {
    local but
    printf '\n  wall    CPU  stage (seconds)\n'
    sort -n -k 2 "$work/rows"
    awk -v wall="$SECONDS" '{ cpu += $2 } END { printf "%6d %6d  all\n", wall, cpu }' "$work/rows"
    but=$(sed -n 's/^SKIPPED: //p' "$work/said" | sort -u | paste -s -d ';' | sed 's/;/; /g')
    printf '\n== All checks passed%s\n' "${but:+, all but: $but}"
}
