#!/usr/bin/env bash
# Runs a command under a name: tests/step.sh NAME COMMAND... Prints the name and, while the command
# takes long, every ten seconds what it is at: the compilers that run, or the name alone.
set -euo pipefail
name=$1
shift
echo "== $name" >&2

# What the compilers below this process work on, as `crate (kind)`.
compiled() {
    ps -o args= -g "$1" 2>/dev/null | sed -nE 's/.*rustc --crate-name ([^ ]+) .*/\1/p' | sort -u | paste -sd' ' || true
}

report() {
    local seconds=0 what
    while sleep 10 </dev/null >/dev/null 2>&1; do
        seconds=$((seconds + 10))
        what=$(compiled "$1")
        echo "   $name, $seconds s${what:+, compiling $what}" >&2
    done
}

report "$(ps -o pgid= $$ | tr -d ' ')" &
reporter=$!
trap 'kill "$reporter" 2>/dev/null; wait "$reporter" 2>/dev/null || true' EXIT
"$@"
