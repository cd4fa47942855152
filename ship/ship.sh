#!/usr/bin/env bash
# Builds sdist and wheels of TARGETS into dist, checks them and prints a table: ship/environment.sh
# ship/ship.sh. Where the compiler for other platforms cannot be had, a wheel is skipped with the
# reason, and the exit code is 77.
set -euo pipefail
read -ra targets <<<"${TARGETS:-x86_64-unknown-linux-gnu aarch64-unknown-linux-gnu x86_64-unknown-linux-musl x86_64-pc-windows-gnu}"
rm -rf dist
mkdir -p target/ship
cp README.md target/ship/README.md
trap 'cp target/ship/README.md README.md' EXIT
python ship/readme.py
rm -rf target/ship/plain
ship/build.sh target/ship/plain x86_64-unknown-linux-gnu
code=0
ship/documented.sh target/ship/plain/*.whl \
    ship/each.sh "maturin sdist --out dist" "${targets[@]/#/ship/build.sh dist }" || code=$?
[ $code -eq 0 ] || [ $code -eq 77 ] || exit $code
ship/check.sh
python ship/table.py
[ -z "$(git status --porcelain -- . ':!README.md')" ] || echo "Built with changes that are not committed."
exit $code
