#!/usr/bin/env bash
# Says which toolchain is missing or too old, and how to get it: tests/toolchains.sh. PYTHON makes
# the environment.
set -euo pipefail

fail() {
    echo "$1"
    exit 1
}

command -v cargo >/dev/null ||
    fail "cargo is missing: install a Rust toolchain (1.89 or newer), https://rustup.rs"
command -v "$PYTHON" >/dev/null ||
    fail "$PYTHON is missing: install Python 3.10 or newer, or set PYTHON="
"$PYTHON" -c 'import sys; sys.exit(sys.version_info < (3, 10))' ||
    fail "$PYTHON is older than 3.10: set PYTHON="
"$PYTHON" -c 'import ensurepip, venv' ||
    fail "$PYTHON has no venv: install it (Debian: python3-venv)"
