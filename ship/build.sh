#!/usr/bin/env bash
# Builds the wheel of a target into a folder: ship/build.sh FOLDER TARGET. zig links for each
# target, so that a wheel asks for no newer C library than its tag says. Exit code 77 where the
# compiler for other platforms cannot be had, with the reason.
set -euo pipefail
folder=$1 target=$2
options=(--release --locked --quiet --compression-level 9 --target "$target" --out "$folder")
case $target in
    # The installed compiler serves.
    x86_64-unknown-linux-gnu) ;;
    # musl is in the system, not in the wheel.
    *-musl) export RUSTFLAGS="${RUSTFLAGS:-} -C target-feature=-crt-static" ;;&
    *)
        run=ship/cross.sh
        options+=(-Zbuild-std=std,panic_unwind)
        ;;
esac
case $target in
    *-linux-gnu) options+=(--zig --compatibility manylinux_2_17) ;;
    *-linux-musl) options+=(--zig) ;;
    *-windows-gnu)
        # With --zig, maturin 1.16 exports `PyInit_irbkin._core`, which does not exist. Called as
        # dlltool, it is zig's.
        tools=$PWD/target/ship/windows
        mkdir -p "$tools"
        ln -sf "$(command -v maturin)" "$tools/x86_64-w64-mingw32-dlltool"
        printf '#!/bin/sh\nexec maturin zig cc -- -target x86_64-windows-gnu "$@"\n' >"$tools/zigcc"
        chmod +x "$tools/zigcc"
        export PATH=$tools:$PATH CARGO_TARGET_X86_64_PC_WINDOWS_GNU_LINKER=$tools/zigcc
        ;;
esac
export CARGO_TARGET_DIR=${CARGO_TARGET_DIR:-target/ship}
exec tests/step.sh "Build the wheel of $target" ${run:-} maturin build "${options[@]}"
