#!/usr/bin/env bash
# Runs a command with one seed after another, for so many seconds: tests/seeds.sh NAME SECONDS COMMAND..
# The next seed is in target/NAME.seed, where a later run goes on; SEED= begins with another one.
set -euo pipefail
name=$1 seconds=$2
shift 2
kept=target/$name.seed log=target/$name.log
first=${SEED:-$(cat "$kept" 2>/dev/null || echo 1)} end=$((SECONDS + seconds))
for ((seed = first; SECONDS < end; seed++)); do
    if ! IRBKIN_SEED=$seed PROPTEST_RNG_SEED=$seed "$@" >"$log" 2>&1; then
        cat "$log"
        echo "seed $seed fails: SEED=$seed make $name SECONDS=1 repeats it"
        exit 1
    fi
    echo $((seed + 1)) >"$kept"
done
echo "Seeds $first to $((seed - 1)): no failure"
