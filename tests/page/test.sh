#!/usr/bin/env bash
# Builds the page's WebAssembly and compares its answers with those of irbkin in Python:
# tests/page/test.sh PYTHON. Skipped with the reason where there is no compiler or no Node.
set -euo pipefail
cd "$(dirname "$0")/../.."
code=0
page/wasm.sh || code=$?
if [ "$code" = 77 ]; then
    echo "SKIPPED: the page's WebAssembly was not built (the reason is above)"
    exit
fi
[ "$code" = 0 ] || exit "$code"
"$1" tests/page/expected.py target/page/expected.json
if ! command -v node >/dev/null; then
    echo "SKIPPED: the page's WebAssembly was not run: there is no node"
    exit
fi
node tests/page/wasm.mjs target/page/irbkin.wasm target/page/expected.json
