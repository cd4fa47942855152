#!/usr/bin/env bash
# Runs the tests of crates/irbkin-page, builds its WebAssembly, compares its answers with irbkin's in
# Python, and opens the page in a Chromium: tests/page/test.sh. VENV has irbkin. What is missing is
# skipped with the reason.
set -euo pipefail
cd "$(dirname "$0")/../.."
python=$VENV/bin/python
tests/step.sh "Tests of crates/irbkin-page" cargo test --quiet -p irbkin-page
code=0
crates/irbkin-page/page/wasm.sh || code=$?
if [ "$code" = 77 ]; then
    echo "SKIPPED: the page's WebAssembly was not built (the reason is above)"
    exit
fi
[ "$code" = 0 ] || exit "$code"
"$python" tests/page/expected.py target/page/expected.json
if ! command -v node >/dev/null; then
    echo "SKIPPED: the page's WebAssembly was not run: there is no node"
    exit
fi
node tests/page/wasm.mjs target/page/irbkin.wasm target/page/expected.json

tests/retry.sh "$python" -m pip install --quiet --disable-pip-version-check --group pack
"$python" crates/irbkin-page/page/pack.py
if ! command -v chromium >/dev/null && ! tests/retry.sh apt-get install -y -qq --no-install-recommends chromium; then
    echo "SKIPPED: the page was not opened: there is no chromium"
    exit
fi
if ! tests/retry.sh "$python" -m pip install --quiet --disable-pip-version-check --group page; then
    echo "SKIPPED: the page was not opened: its tools cannot be installed"
    exit
fi
"$python" -m pytest --quiet tests/page
