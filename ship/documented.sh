#!/usr/bin/env bash
# Runs a command while the type stub has the docstrings of the extension in a wheel of this tree:
# ship/documented.sh WHEEL COMMAND...
set -euo pipefail
wheel=$1
shift
folder=$(mktemp -d)
cp -p python/irbkin/_core.pyi "$folder"
trap 'cp -p "$folder/_core.pyi" python/irbkin/; rm -rf "$folder"' EXIT
python -m zipfile -e "$wheel" "$folder/wheel"
PYTHONPATH=$folder/wheel python tests/python/stub_docs.py
"$@"
