#!/usr/bin/env bash
# Runs a command that needs the network: tests/retry.sh COMMAND... Where it fails, it runs again
# from the start, three times in all, 10 and 30 seconds later.
set -euo pipefail
for pause in 10 30; do
    "$@" && exit
    echo "failed (exit code $?), again in $pause s: $*" >&2
    sleep "$pause"
done
exec "$@"
