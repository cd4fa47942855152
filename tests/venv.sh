#!/usr/bin/env bash
# Makes the environment VENV, or installs a dependency group of pyproject.toml into it:
# tests/venv.sh [GROUP]
set -euo pipefail

# A download that breaks off is no reason to fail.
install() {
    tests/retry.sh "$VENV/bin/pip" install --quiet --disable-pip-version-check "$@"
}

if [ $# -gt 0 ]; then
    install --group "$1"
    exit
fi
"$PYTHON" -m venv "$VENV"
install --upgrade 'pip>=25.1'
install 'maturin>=1.9,<2' 'numpy>=1.23' 'rich>=13' 'rich-argparse>=1.5' 'shtab>=1.12'
