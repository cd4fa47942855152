#!/usr/bin/env bash
# Builds irbkin-page for WebAssembly into target/page/irbkin.wasm. Exit code 77 where the compiler
# cannot be had, with the reason.
set -euo pipefail
cd "$(dirname "$0")/../../.."
target=${CARGO_TARGET_DIR:-target}

# A panic is a trap without a message: messages and the names of source files are left out. Without
# vectors of two numbers, which browsers have since 2023, the lanes take many times as long to compile.
flags="-Zunstable-options -Cpanic=immediate-abort -Zlocation-detail=none -Ctarget-feature=+simd128"
CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_LINKER=$PWD/target/compiler/wasm-ld RUSTFLAGS=$flags \
    ship/cross.sh tests/step.sh "Build irbkin for WebAssembly" \
    cargo rustc --quiet --locked -p irbkin-page --lib --crate-type cdylib,rlib --profile wasm --target wasm32-unknown-unknown \
    --target-dir "$target" -Zbuild-std=std,panic_abort -Zbuild-std-features=optimize_for_size "$@" -- -Cstrip=symbols
mkdir -p target/page
cp "$target/wasm32-unknown-unknown/wasm/irbkin_page.wasm" target/page/irbkin.wasm

raw=$(stat -c %s target/page/irbkin.wasm)
packed=$(gzip -9 -c target/page/irbkin.wasm | wc -c)
echo "target/page/irbkin.wasm: $raw bytes, $packed with gzip -9"
