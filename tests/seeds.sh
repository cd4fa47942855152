#!/usr/bin/env bash
# Runs laws or readers with one seed after another: tests/seeds.sh soak|fuzz SECONDS. The next seed is
# in target/NAME.seed, where a later run goes on; SEED= begins with another one.
set -euo pipefail
cd "$(dirname "$0")/.."
name=$1 seconds=$2
rust=(cargo test -p irbkin -p irbkin-motion -p irbkin-abb -p irbkin-tests --lib --tests --quiet --release)

# `evidence SUITE=hardsets` has its own numbers; that a seed is fixed is no law.
soak() {
    IRBKIN_POSES=10000 PROPTEST_CASES=2000 "${rust[@]}" -- \
        laws:: recall:: certificates:: cell:: go:: --skip every_run_draws
}

# INPUTS broken files of each kind for every reader.
fuzz() {
    export IRBKIN_INPUTS=${INPUTS:-20000}
    "${rust[@]}" -- rapid_fuzz:: &&
        "$VENV/bin/python" -m pytest --quiet -n 2 tests/python/test_*_fuzz.py -k broken
}

tests/step.sh "Compile the Rust tests" "${rust[@]}" --no-run
kept=target/$name.seed log=target/$name.log
first=${SEED:-$(cat "$kept" 2>/dev/null || echo 1)} end=$((SECONDS + seconds))
for ((seed = first; SECONDS < end; seed++)); do
    if ! IRBKIN_SEED=$seed PROPTEST_RNG_SEED=$seed "$name" >"$log" 2>&1; then
        cat "$log"
        echo "seed $seed fails: SEED=$seed make $name SECONDS=1 repeats it"
        exit 1
    fi
    echo $((seed + 1)) >"$kept"
done
echo "Seeds $first to $((seed - 1)): no failure"
