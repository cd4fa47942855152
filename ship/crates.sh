#!/usr/bin/env bash
# What is asked of the crates before a release: ship/crates.sh thirdparty|deny|semver|msrv|mutants
# [SECONDS]
set -euo pipefail
cd "$(dirname "$0")/.."

# Compile a tool in Rust, unless it is there: tool NAME VERSION
tool() {
    export PATH=$PWD/target/tools/bin:$PATH
    tests/step.sh "Compile $1 (a minute or more)" \
        cargo install --quiet --locked --debug --root target/tools "$1@$2"
}

thirdparty() {
    "$PYTHON" ship/thirdparty.py
    "$PYTHON" ship/sbom.py
}

# CHECKS="advisories" asks the database of advisories, which needs a network.
deny() {
    if ! tool cargo-deny 0.20.2; then
        echo "SKIPPED: licenses and sources of crates: cargo-deny cannot be compiled (the reason is above)"
        return
    fi
    if [ -n "${CHECKS:-}" ]; then
        # shellcheck disable=SC2086 # A list of words.
        cargo-deny --workspace check $CHECKS
    else
        cargo-deny --offline --workspace check licenses bans sources
    fi
}

semver() {
    local tag
    if ! tag=$(git describe --tags --abbrev=0 --match 'v[0-9]*' 2>/dev/null); then
        echo "There is no tag v* yet: no interface to compare with"
        return
    fi
    tool cargo-semver-checks 0.51.0
    cargo semver-checks --package irbkin --package irbkin-motion --package irbkin-abb \
        --baseline-rev "$tag"
}

msrv() {
    local oldest
    oldest=$(sed -nE 's/^rust-version = "(.*)"/\1/p' Cargo.toml)
    if ! rustup toolchain list | grep -q "^$oldest"; then
        echo "Rust $oldest is missing: rustup toolchain install $oldest --profile minimal"
        return 1
    fi
    tests/step.sh "Compile with Rust $oldest" rustup run "$oldest" cargo check --quiet --locked --workspace
    tests/step.sh "Compile with Rust $oldest, without std" rustup run "$oldest" \
        cargo check --quiet --locked -p irbkin-abb --lib --no-default-features --features libm
}

# Changes FILES in one place after another: mutants [SECONDS]. In a copy of the sources, which is built
# first.
mutants() {
    local seconds=${1:-1200} code=0
    tool cargo-mutants 27.1.0
    timeout --signal=INT "$seconds" \
        cargo mutants --shuffle --output target \
        --file "${FILES:-src/kinematics/structure/**}" \
        --test-package irbkin,irbkin-motion,irbkin-tests --cargo-arg=--lib --cargo-arg=--tests -- \
        --include-ignored laws:: hard_sets:: reach_and_paths:: certificates:: follow:: structure:: solve:: ||
        code=$?
    case $code in 0 | 2 | 3 | 124) ;; *) return 1 ;; esac
    echo "Seen: $(wc -l <target/mutants.out/caught.txt). Not seen:"
    cat target/mutants.out/missed.txt
}

"$@"
