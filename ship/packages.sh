#!/usr/bin/env bash
# Builds the crates and the sdist, unpacks kinematics and the sdist into an empty folder, and runs
# their examples there.
# Downloads what pip and cargo need: ship/environment.sh ship/packages.sh
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

echo "The crates"
cargo package -p irbkin -p irbkin-motion -p irbkin-abb --quiet --allow-dirty --no-verify
tar xzf target/package/irbkin-[0-9]*.crate -C "$folder"
if find "$folder" -name '*.py' | grep .; then
    echo "The crate has Python files" >&2
    exit 1
fi
(
    cd "$folder"/irbkin-*
    export CARGO_TARGET_DIR="$folder/target"
    cargo check --quiet --examples
    for example in 01_solve_a_pose 04_your_own_arm 05_many_poses; do
        cargo run --quiet --example "$example" >/dev/null
    done
)

echo "The sdist"
maturin sdist --out "$folder/dist"
"$PYTHON" -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check "$folder"/dist/irbkin-*.tar.gz
mkdir "$folder/sdist"
tar xzf "$folder"/dist/irbkin-*.tar.gz -C "$folder/sdist"
(
    cd "$folder"/sdist/irbkin-*
    for example in examples/*.py; do
        "$folder/venv/bin/python" "$example" >/dev/null
    done
)
