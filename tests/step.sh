#!/usr/bin/env bash
# Runs a command under a name: tests/step.sh [-q] NAME COMMAND... Prints the name and, while the
# command takes long, the seconds every ten of them (STEP_SECONDS). With -q what the command prints
# is shown only if it fails; of what cargo prints, how many crates it has compiled.
set -euo pipefail
log=
if [ "$1" = -q ]; then
    log=$(mktemp)
    shift
fi
name=$1 every=${STEP_SECONDS:-10}
shift
echo "== $name" >&2

report() {
    local seconds=0 crates
    while sleep "$every" </dev/null >/dev/null 2>&1; do
        seconds=$((seconds + every))
        crates=$([ -z "$log" ] || tail -c 400 "$log" | tr '\r' '\n' |
            sed -nE 's|.*Building \[.*\] +([0-9]+)/([0-9]+): .*|, \1 of \2 crates|p' | tail -n 1)
        echo "   $name, $seconds s$crates" >&2
    done
}

report &
reporter=$!
trap 'kill "$reporter" 2>/dev/null; wait "$reporter" 2>/dev/null || true; rm -f "$log"' EXIT
if [ -z "$log" ]; then
    "$@"
else
    CARGO_TERM_PROGRESS_WHEN=always CARGO_TERM_PROGRESS_WIDTH=80 "$@" >"$log" 2>&1 || {
        status=$?
        tr '\r' '\n' <"$log" | sed '/ Building \[/d' >&2
        exit "$status"
    }
fi
