#!/usr/bin/env bash
# Fails where every solution of a pose takes more than a microsecond, or a call 3 % more instructions
# than recorded: benches/speed.sh
set -euo pipefail
cd "$(dirname "$0")/.."
# The last link of each optimizes all crates on one core: both at the same time, nothing is measured.
tests/step.sh "Compile what is measured" cargo bench --quiet --no-run --bench microsecond --bench instructions
tests/step.sh "every solution of a pose is below a microsecond" cargo bench --quiet --bench microsecond
tests/step.sh "instructions of single calls" "$PYTHON" benches/instructions.py --check
