#!/usr/bin/env bash
# Makes an environment of irbkin and its peers: benches/peers/install.sh VENV. The peers are installed
# again after a change of requirements.txt.
set -euo pipefail
cd "$(dirname "$0")/../.."
venv=$1
pip() { "$venv/bin/pip" install --quiet --disable-pip-version-check "$@"; }
requirements=benches/peers/requirements.txt

if [ "$requirements" -nt "$venv/.made" ]; then
    echo "Installing the peers into $venv"
    "$PYTHON" -m venv --clear "$venv"
    pip --upgrade 'pip>=25.1'
    pip 'maturin>=1.9,<2' 'numpy>=1.23'
    # One at a time: a peer without a wheel for this Python does not exclude the others.
    while read -r peer; do
        pip "$peer" </dev/null || echo "$peer cannot be installed: left out"
    done <"$requirements"
    touch "$venv/.made"
fi
echo "Building irbkin's wheel for $venv (about a minute)"
rm -rf "$venv/wheel"
VENV=$venv ship/environment.sh maturin build --release --quiet --out "$venv/wheel"
pip --force-reinstall --no-deps "$venv"/wheel/irbkin-*.whl
touch "$venv/.irbkin"
