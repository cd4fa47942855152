#!/usr/bin/env bash
# Builds the wheel into dist, checks its size and paths, and tries it: the first example, and the
# command `irbkin` as pip, uv and pipx install it: ship/environment.sh ship/wheel.sh
set -euo pipefail
rm -rf dist/venv dist/irbkin-*.whl target/wheel
maturin build --release --quiet --out target/wheel
ship/documented.sh target/wheel/irbkin-*.whl \
    maturin build --release --quiet --compression-level 9 --out dist
wheel=$(realpath dist/irbkin-*.whl)
python tests/check_wheel.py "$wheel"

venv=$PWD/dist/venv
install() { tests/retry.sh "$venv/bin/pip" install --quiet --disable-pip-version-check "$@"; }
"$PYTHON" -m venv "$venv"
install "$wheel"
(cd dist && "$venv/bin/python" ../examples/01_solve_a_pose.py >/dev/null)
"$venv/bin/irbkin" ik "IRB 2600-12/1.65" --xyz 850 320 640 >/dev/null

# The module of README: it has an error, so the exit code is 1.
check() {
    local code=0 printed
    printed=$("$@" check --output-format concise --robot "IRB 2600-12/1.65" examples/pick_and_place.mod) || code=$?
    if [ "$code" != 1 ] || [[ $printed != *"Found 1 error, 3 notes." ]]; then
        printf '%s: exit code %s\n%s\n' "$1" "$code" "$printed" >&2
        exit 1
    fi
}

echo "== the command by pip, uv and pipx" >&2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
check "$venv/bin/irbkin"

install uv pipx
export UV_CACHE_DIR=$folder/cache UV_TOOL_DIR=$folder/uv UV_TOOL_BIN_DIR=$folder/bin
tests/retry.sh "$venv/bin/uv" tool install --quiet --python "$venv/bin/python" "$wheel"
check "$folder/bin/irbkin"

export PIPX_HOME=$folder/pipx
check "$venv/bin/pipx" run --quiet --python "$venv/bin/python" --spec "$wheel" irbkin
