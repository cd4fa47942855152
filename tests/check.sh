#!/usr/bin/env bash
# What `make check` checks: tests/check.sh rust|python. For Python, VENV has the extension and the
# packages of the group `check`.
set -euo pipefail
cd "$(dirname "$0")/.."
bin=$VENV/bin
step() { tests/step.sh "$@"; }

# Lints first: they are the quickest to fail.
rust() {
    local without_std=(--no-default-features --features libm)
    cargo fmt --all --check
    step "clippy" cargo clippy --quiet --workspace --all-targets -- -D warnings
    step "clippy without std" cargo clippy --quiet -p irbkin-abb --lib "${without_std[@]}" -- -D warnings
    step "clippy without urdf and serde" cargo clippy --quiet -p irbkin-motion --lib --no-default-features --features std -- -D warnings
    step "the tails compile" cargo check --quiet --manifest-path benches/tails/Cargo.toml --target-dir target/tails
    step "Rust documentation" env RUSTDOCFLAGS='-D warnings' cargo doc --no-deps -p irbkin -p irbkin-motion -p irbkin-abb --features irbkin/serde
    # Documentation tests, benches and examples share a build that is quick to make: they need not be
    # fast. `make test-page` has the documentation test of irbkin-page, which knows no std.
    export CARGO_PROFILE_DEV_OPT_LEVEL=0 CARGO_PROFILE_DEV_DEBUG=false CARGO_INCREMENTAL=0
    step "Rust documentation tests" cargo test --doc
    step "benches run" cargo test --bench one_pose --bench batch --bench instructions --bench microsecond -- --test
    step "examples in Rust run" bash -euc 'for example in examples/*.rs; do
        cargo run --quiet --example "$(basename "$example" .rs)" >/dev/null
    done'
}

python() {
    "$bin/ruff" check --quiet .
    "$bin/ruff" format --check --quiet .
    "$bin/python" tests/weight.py
    "$bin/python" tests/names.py
    "$bin/python" ship/sbom.py --check
    step "licenses of the wheel" "$bin/python" ship/thirdparty.py --check
    step "workflows" "$bin/zizmor" --quiet --offline --persona auditor --strict-collection .github
    step "mypy" "$bin/mypy" --no-error-summary
    step "stubs" "$bin/python" -m mypy.stubtest irbkin._core --concise --allowlist tests/python/stubtest_allow.txt
    step "benches in Python run" env QUICK=1 MOVES=1000 TRAJECTORIES=200 LINES=10 TARGETS=1000 CALLS=1 KEYS=3 OTHERS=3 \
        benches/evidence.sh calls >/dev/null
    step "peers are compared" "$bin/python" -m benches.peers --quick >/dev/null
    step "peers are compared in brief" "$bin/python" -m benches.peers --brief --quick >/dev/null
    step "examples in Python run" bash -euc 'for example in examples/*.py; do
        "$VENV/bin/python" "$example" >/dev/null
    done'
}

"$1"
