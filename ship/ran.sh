#!/usr/bin/env bash
# Records what ran on a file, by its hash, for ship/table.py: ship/ran.sh FILE WHAT.
set -euo pipefail
mkdir -p target/ship
echo "$(sha256sum "$1" | cut -d' ' -f1) $2" >>target/ship/ran.txt
