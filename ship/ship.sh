#!/usr/bin/env bash
# Builds the files of a release into dist, checks them and prints a table: ship/ship.sh TARGET...
# Exit code 77 if a wheel was skipped, since the compiler for other platforms cannot be had.
set -euo pipefail
rm -rf dist
mkdir -p target/ship
cp README.md target/ship/README.md
trap 'cp target/ship/README.md README.md' EXIT
python ship/readme.py
rm -rf target/ship/plain
ship/wheel.sh target/ship/plain x86_64-unknown-linux-gnu
code=0
ship/documented.sh target/ship/plain/*.whl \
    ship/each.sh "maturin sdist --out dist" "${@/#/ship/wheel.sh dist }" || code=$?
[ $code -eq 0 ] || [ $code -eq 77 ] || exit $code
ship/check.sh
python ship/table.py
[ -z "$(git status --porcelain -- . ':!README.md')" ] || echo "Built with changes that are not committed."
exit $code
