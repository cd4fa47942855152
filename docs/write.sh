#!/usr/bin/env bash
# Writes generated tables and transcripts, draws the pictures, builds cargo doc and the site:
# docs/write.sh. VENV has irbkin and the packages of the groups `check` and `site`.
set -euo pipefail
cd "$(dirname "$0")/.."
python=$VENV/bin/python
export IRBKIN_WRITE=1
cargo test -p irbkin -p irbkin-motion -p irbkin-abb -p irbkin-tests --lib --tests --quiet -- catalog_page::
"$python" -m pytest --quiet tests/python/test_documents.py -k "transcripts or notebook"
for script in eight_solutions motion plans singularities peers free_motion stream; do
    "$python" docs/pictures/$script.py
done
RUSTDOCFLAGS="-D warnings" cargo doc --no-deps -p irbkin -p irbkin-motion -p irbkin-abb --features irbkin/serde
"$python" docs/site/build.py
