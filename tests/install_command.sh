#!/usr/bin/env bash
# Checks a module with the command `irbkin` as pip, uv and pipx install it from a wheel:
# tests/install_command.sh VENV WHEEL. VENV has the wheel; uv and pipx are installed into it.
set -euo pipefail
venv=$(realpath "$1")
wheel=$(realpath "$2")
cd "$(dirname "$0")/.."
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# The module of README: it has an error, so the exit code is 1.
check() {
    local code=0 printed
    printed=$("$@" check --output-format concise --robot "IRB 2600-12/1.65" examples/pick_and_place.mod) || code=$?
    if [ "$code" != 1 ] || [[ $printed != *"Found 1 error, 2 notes." ]]; then
        printf '%s: exit code %s\n%s\n' "$1" "$code" "$printed" >&2
        exit 1
    fi
}

check "$venv/bin/irbkin"

tests/retry.sh "$venv/bin/pip" install --quiet --disable-pip-version-check uv pipx
export UV_CACHE_DIR=$folder/cache UV_TOOL_DIR=$folder/uv UV_TOOL_BIN_DIR=$folder/bin
tests/retry.sh "$venv/bin/uv" tool install --quiet --python "$venv/bin/python" "$wheel"
check "$folder/bin/irbkin"

export PIPX_HOME=$folder/pipx
check "$venv/bin/pipx" run --quiet --python "$venv/bin/python" --spec "$wheel" irbkin
