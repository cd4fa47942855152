#!/usr/bin/env bash
# The laws in Rust and Python that need no extra, for `make test`, `make quick` and `make test-sets`:
# tests/laws.sh all|quick-rust|quick-python|sets. VENV has the extension and pytest.
set -euo pipefail
cd "$(dirname "$0")/.."
laws=(cargo test -p irbkin-abb -p irbkin-tests --lib --tests)
python=("$VENV/bin/python" -m pytest -q -n auto --dist worksteal
    -m "not extra and not recipes and not evidence")

# The Python tests run while Rust compiles. The last line says how many passed, failed and were
# skipped.
all() {
    local logs=target/laws failed=0 pytest
    rm -rf "$logs"
    mkdir -p "$logs"
    export IRBKIN_SKIPPED=$PWD/$logs/skipped
    : >"$IRBKIN_SKIPPED"

    tests/step.sh "Python tests" "${python[@]}" >"$logs/python" &
    pytest=$!
    tests/step.sh -q "Compile the laws in Rust (most of it is the last crate)" "${laws[@]}" --no-run || failed=1
    if [ "$failed" = 0 ]; then
        tests/step.sh "Laws in Rust" "${laws[@]}" --quiet --no-fail-fast >"$logs/rust" 2>&1 || failed=1
        if [ "$failed" = 1 ]; then cat "$logs/rust"; fi
    fi
    wait "$pytest" || { failed=1; cat "$logs/python"; }

    grep -h '^SKIPPED' "$logs/python" || true
    sort "$IRBKIN_SKIPPED"
    echo "Left for .ci/run: unit tests of kinematics and laws on each instruction set (make test-sets),"
    echo "documentation tests (make check), tests of extras (make test-oracles)."
    echo "$(count passed) passed, $(count 'failed|[0-9]+ errors?') failed, $(count skipped) skipped"
    return "$failed"
}

# The sum of the numbers before a word in the lines of `all` that sum up.
count() {
    cat target/laws/{rust,python} 2>/dev/null | grep -E '^test result: |[0-9]+ passed.* in [0-9.]+s' |
        grep -oE "[0-9]+ $1" | awk '{ sum += $1 } END { print sum + 0 }'
}

quick-rust() {
    tests/step.sh "Laws in Rust" env IRBKIN_DIVISOR=10 "${laws[@]}" --quiet -- laws:: rapid allocation
}

quick-python() {
    tests/step.sh "Python tests" "${python[@]}" --failed-first
}

# Unit tests of kinematics, and the laws on each instruction set; they share the build of the laws.
sets() {
    local units=(cargo test -p irbkin -p irbkin-motion -p irbkin-abb -p irbkin-tests --lib)
    local tests=("${units[@]}" --tests)
    tests/step.sh -q "Compile the Rust tests" "${tests[@]}" --no-run
    tests/step.sh "Unit tests of kinematics" "${units[@]}"
    tests/step.sh "Rust tests that force an instruction set" "${tests[@]}" -- --ignored
    tests/step.sh "Laws on the baseline" env IRBKIN_INSTRUCTION_SET=baseline "${tests[@]}" -- laws:: hard_sets::
}

"$1"
