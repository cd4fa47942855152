#!/usr/bin/env bash
# Runs command lines one after another: ship/each.sh "COMMAND LINE"... One that exits with 77 was
# skipped: the rest runs, then this exits with 77 too. Any other failure ends it.
set -euo pipefail
skipped=()
for line in "$@"; do
    code=0
    bash -c "$line" || code=$?
    case $code in
        0) ;;
        77) skipped+=("$line") ;;
        *) exit "$code" ;;
    esac
done
[ "${#skipped[@]}" -eq 0 ] && exit
printf 'SKIPPED: %s\n' "${skipped[@]}" >&2
exit 77
