#!/usr/bin/env bash
# The laws in Rust and Python that need no extra, for `make test`: tests/laws.sh PYTHON COMMAND,
# where the command of cargo runs those in Rust. The Python tests run while Rust compiles. The last
# line says how many passed, failed and were skipped.
set -uo pipefail
cd "$(dirname "$0")/.."
python=$1 logs=target/laws
shift
rm -rf "$logs"
mkdir -p "$logs"
export IRBKIN_SKIPPED=$PWD/$logs/skipped
: >"$IRBKIN_SKIPPED"

tests/step.sh "Python tests" "$python" -m pytest -q -n auto --dist worksteal \
    -m "not extra and not recipes and not evidence" >"$logs/python" &
pytest=$!
failed=0
tests/step.sh -q "Compile the laws in Rust (most of it is the last crate)" "$@" --no-run || failed=1
if [ "$failed" = 0 ]; then
    tests/step.sh "Laws in Rust" "$@" --quiet --no-fail-fast >"$logs/rust" 2>&1 || failed=1
    if [ "$failed" = 1 ]; then cat "$logs/rust"; fi
fi
wait "$pytest" || { failed=1; cat "$logs/python"; }

# The sum of the numbers before a word in the lines that sum up.
count() { cat "$logs/rust" "$logs/python" 2>/dev/null | grep -E '^test result: |[0-9]+ passed.* in [0-9.]+s' |
    grep -oE "[0-9]+ $1" | awk '{ sum += $1 } END { print sum + 0 }'; }
grep -h '^SKIPPED' "$logs/python"
sort "$IRBKIN_SKIPPED"
echo "Left for .ci/run: unit tests of kinematics and laws on each instruction set (make test-sets),"
echo "documentation tests (make check), tests of extras (make test-oracles)."
echo "$(count passed) passed, $(count 'failed|[0-9]+ errors?') failed, $(count skipped) skipped"
exit "$failed"
